#pragma once
#include <cstddef>

#include "reference/fluid/depth_map.hpp"
#include "reference/fluid/refracted_scene.hpp"
#include "reference/readings/constant_divisor.hpp"
#include "reference/system/pixel_boxes.hpp"

namespace lockstep::fluid {

/// How far light is bent that comes from high enough, of the image's side.
inline constexpr float most_bend = 0.03325F;

/// t t (3 - 2 t) of the share t that x has of a to b.
template <class R, class Real> Real step(R& r, float a, float b, const Real& x) {
    const Real t =
        r.note(site::share, r.min(Real(1.0F), r.max(Real(0.0F), divided_by(r, site::share, x - Real(a), b - a))));
    return r.setting(site::step_is_smooth, true) ? (t * t) * (Real(3.0F) - Real(2.0F) * t) : t;
}
template <class Vec3, class Real> Vec3 mixed(const Vec3& a, const Vec3& b, const Real& share) {
    return a * (Real(1.0F) - share) + b * share;
}

/// What the surface at a pixel sends to the eye.
template <class R> struct Shading {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;
    R& r;
    const Host& host;
    const SystemView& state;

    template <class Place, class Item>
    [[nodiscard]] Vec3 at(const Place& pixel, const Item& item, const Real& z) const {
        const Vec3 e = point_at(r, host, pixel.x, pixel.y, z);
        const Vec3 stored = item_vec3(r, site::normal_in, state, field::normal, item);
        const Vec3 n = r.setting(site::normal_is_of_view, true) ? stored : in_world(stored);
        const Vec3 to_eye = r.note(site::to_eye, -r.normalize(site::to_eye, e));
        const auto g4 = r.transform(site::world, r.uniform(site::inverse_view, host.inverse_view()), e);
        const Vec3 world = r.note(site::world, Vec3{g4.x, g4.y, g4.z});
        const Vec3 light = r.uniform(site::light, glm::vec3(host.view()[1]));
        const Vec3 colour = r.uniform(site::colour, glm::vec3(fluid_colour[0], fluid_colour[1], fluid_colour[2]));
        const Real alpha = r.uniform(site::alpha, fluid_colour[3]), one(1.0F);

        const Vec3 refracted = r.note(site::refracted, seen_through(pixel, n, world) * transmission(item, colour));
        const Vec3 diffuse =
            r.note(site::diffuse, lambert(light, n, world, colour) * r.note(site::scattered, one - alpha));
        const Real cosine = r.note(site::cosine, r.max(Real(0.0F), r.dot(site::cosine, n, to_eye)));
        const Real shine = specular(light, n, to_eye);
        const Vec3 surface = r.note(site::surface, mixed(refracted, sky(to_eye, n), fresnel(cosine)));
        return r.note(site::surface_light, diffuse + (surface + Vec3{shine, shine, shine}) * alpha);
    }

    [[nodiscard]] Vec3 in_world(const Vec3& of_view) const {
        const glm::mat4& m = host.inverse_view();
        const auto along = [&](int row) {
            return (Real(m[0][row]) * of_view.x + Real(m[1][row]) * of_view.y) + Real(m[2][row]) * of_view.z;
        };
        return {along(0), along(1), along(2)};
    }
    [[nodiscard]] Real specular(const Vec3& light, const Vec3& n, const Vec3& to_eye) const {
        const Vec3 h =
            r.note(site::halfway,
                   r.normalize(site::halfway, r.setting(site::halfway_by_sum, true) ? to_eye + light : to_eye - light));
        const Real shine = r.note(site::shine, r.max(Real(0.0F), r.dot(site::shine, n, h)));
        return r.note(site::specular, power_of(r, host, shine, 500));
    }
    /// The scene behind, as far aside as the normal leans.
    template <class Place> [[nodiscard]] Vec3 seen_through(const Place& pixel, const Vec3& n, const Vec3& world) const {
        const Real bend =
            r.note(site::bend_of, Real(most_bend) * (r.setting(site::bend_rises, true) ? step(r, 0.1F, 0.4F, world.y)
                                                                                       : step(r, 0.4F, 0.1F, world.y)));
        const Settings& s = host.settings();
        const auto place = [&](At at, At centre_at, const auto& i, const Real& offset, At size_at, int size) {
            const Real centre = r.note(centre_at, r.real(i) + Real(0.5F));
            return r.note(at, centre + offset * r.uniform(size_at, static_cast<float>(size)));
        };
        const Real x = r.note(site::offset, (bend * Real(0.75F)) * n.x), y = r.note(site::offset, bend * n.y);
        return r.note(site::seen, RefractedScene<R>(r, host, state)
                                      .at({place(site::fetch_x, site::pixel_x, pixel.x, x, site::width, s.width),
                                           place(site::fetch_y, site::pixel_y, pixel.y, y, site::height, s.height)}));
    }
    /// Beer and Lambert's.
    template <class Item> [[nodiscard]] Vec3 transmission(const Item& item, const Vec3& colour) const {
        const Real thickness =
            host.switches().thickness_sum == ThicknessSum::fixed
                ? r.note(site::thickness_in, whole_real(r, state, field::thickness, item) * Real(1.0F / 65536.0F))
                : r.note(site::thickness_in, item_real(r, site::thickness_in, state, field::thickness, item));
        const Real dark = r.note(
            site::dark, r.max(r.uniform(site::floor_of_thickness, host.settings().shading.thickness_floor), thickness));
        const Real one(1.0F);
        const Vec3 absorbed =
            r.note(site::absorbed, Vec3{(one - colour.x) * dark, (one - colour.y) * dark, (one - colour.z) * dark});
        const auto through = [&](const Real& x) { return exponential_of(r, host, r.note(site::exponent, -x)); };
        return r.note(site::transmission, Vec3{through(absorbed.x), through(absorbed.y), through(absorbed.z)});
    }
    /// Half of it from all around, in a spot under the zenith.
    [[nodiscard]] Vec3 lambert(const Vec3& light, const Vec3& n, const Vec3& world, const Vec3& colour) const {
        const Real zero(0.0F), one(1.0F), half(0.5F);
        const Vec3 down = r.note(site::down, r.normalize(site::down, world - Vec3{zero, Real(1000.0F), zero}));
        const Real spot = r.note(site::spot, r.max(step(r, 0.95F, 1.0F, r.abs(down.y)), Real(0.05F)));
        const Real facing = r.note(site::lambert, r.dot(site::lambert, light, n));
        const Real share = r.note(site::wrapped, (facing * spot) * half + r.note(site::half_light, half));
        const Vec3 dark = r.note(site::tint, Vec3{Real(0.29F), Real(0.379F), Real(0.59F)});
        return colour * mixed(dark, Vec3{one, one, one}, share);
    }
    /// Schlick's.
    [[nodiscard]] Real fresnel(const Real& cosine) const {
        const Real one(1.0F), r0 = r.uniform(site::r0, host.settings().shading.fresnel_r0);
        const Real raised = r.note(site::raised, power_of(r, host, r.note(site::grazing, one - cosine),
                                                          host.settings().shading.fresnel_power));
        return r.note(site::fresnel, r0 + (one - r0) * raised);
    }
    [[nodiscard]] Vec3 sky(const Vec3& to_eye, const Vec3& n) const {
        const bool published = r.setting(site::mirrors_to_eye, host.switches().mirror == Mirror::as_published);
        const Vec3 incident = r.note(site::incident, published ? to_eye : -to_eye);
        const Real twice = r.note(site::along_normal, Real(2.0F) * r.dot(site::along_normal, n, incident));
        const Vec3 m = r.note(site::mirrored, incident - n * twice);
        const glm::mat4 to_world = r.uniform(site::inverse_view, host.inverse_view());
        const Vec3 row = r.uniform(site::up_row, glm::vec3(to_world[0][1], to_world[1][1], to_world[2][1]));
        const Real height = r.note(site::mirror_y, (row.x * m.x + row.y * m.y) + row.z * m.z);
        const Real share = r.note(site::sky_share, step(r, 0.15F, 0.25F, height));
        const Real bias = r.uniform(site::sky_bias, host.settings().shading.sky_bias);
        const Vec3 low{Real(0.1F), Real(0.1F), Real(0.2F)}, high{Real(0.12F), Real(0.24F), Real(0.96F)};
        return r.note(site::sky, Vec3{bias, bias, bias} + mixed(low, high, share));
    }
};

} // namespace lockstep::fluid
