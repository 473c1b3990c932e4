#pragma once
#include "reference/lights/lighting_twin.hpp"

namespace lockstep::lights {

/// Discs around the lights, added to the lit image by blending where nothing nearer is: in the order of drawing where
/// the driver is followed, else in any. Twin of shaders/lights/glow_pass.*.
struct GlowTwin {
    HostPtr host;
    BoxesByTile boxes = {};

    [[nodiscard]] GlowTwin at(const PassInput& in) const { return {host, glow_boxes(*host, in.before)}; }

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        using Real = typename R::Real;
        using Vec3 = typename R::Vec3;
        const Pixel pixel = Pixel::of(host->settings().width, item);
        const glm::vec4 before = in.before.vec4(field::pixel, item);
        Vec3 sum = r.read(site::lit_before, glm::vec3(before));
        std::vector<Vec3> terms; // in any order
        if (!host->follows_driver())
            terms.push_back(sum);
        for (const std::uint32_t i : boxes.near(pixel))
            if (pixel.is_in(boxes.box(i)))
                if (const auto share = share_at(r, in, i, pixel, item)) {
                    const Vec3 c = r.read(site::colour_before, in.before.vec3(field::light_colour, i)) * *share *
                                   r.uniform(site::glow_gain, host->settings().glow_gain);
                    sum = sum + r.note(site::glow_colour, c);
                    if (!host->follows_driver())
                        terms.push_back(c);
                }
        if (terms.size() > 1)
            sum = in_any_order(r, terms);
        const Real alpha = r.read(site::lit_before, before.w);
        return words_of<R>(r.note(site::lit, typename R::Vec4{sum.x, sum.y, sum.z, alpha}));
    }

  private:
    template <class R> static typename R::Vec3 in_any_order(R& r, const std::vector<typename R::Vec3>& terms) {
        const auto along = [&](const auto& part) {
            std::vector<typename R::Real> all;
            for (const typename R::Vec3& term : terms)
                all.push_back(part(term));
            return r.any_order_sum(site::lit, all);
        };
        return {along([](const auto& v) { return v.x; }), along([](const auto& v) { return v.y; }),
                along([](const auto& v) { return v.z; })};
    }
    template <class R> std::optional<typename R::Real> share_at(R& r, const PassInput& in, std::uint32_t light,
                                                                const Pixel& pixel, std::size_t item) const {
        using Real = typename R::Real;
        const Settings& s = host->settings();
        const Real zero(0.0F), one(1.0F), half(0.5F);
        const auto clip =
            r.note(site::clip, r.transform(site::clip, r.uniform(site::projection, host->view_projection()),
                                           r.read(site::before, in.before.vec3(field::light_position, light))));
        if (!r.decide(site::before_camera, clip.w > zero))
            return {};
        const Real depth_of = r.note(site::glow_depth, r.divide(site::glow_depth, clip.z, clip.w) * half + half);
        if (!r.decide(site::glow_in_planes, depth_of >= zero && depth_of <= one))
            return {};
        const Real stored = r.read(site::stored_depth, in.before.real(field::texel_depth, item));
        if (!r.decide(site::glow_nearer, depth_of < stored))
            return {};
        const Real x = r.note(site::glow_x, (r.divide(site::glow_x, clip.x, clip.w) + one) * half * r.real(s.width));
        const Real y = r.note(site::glow_y, (r.divide(site::glow_y, clip.y, clip.w) + one) * half * r.real(s.height));
        const Real radius = r.note(
            site::glow_radius, r.divide(site::glow_radius, r.uniform(site::disc_scale, host->disc_scale()), clip.w));
        const Real dx =
            r.note(site::disc_x, r.divide(site::disc_x, r.note(site::centre_x, r.real(pixel.x) + half) - x, radius));
        const Real dy =
            r.note(site::disc_y, r.divide(site::disc_y, r.note(site::centre_y, r.real(pixel.y) + half) - y, radius));
        const Real d2 = r.note(site::disc, dx * dx + dy * dy);
        if (!r.decide(site::on_disc, d2 < one))
            return {};
        return r.note(site::glow_share, one - d2);
    }
};

} // namespace lockstep::lights
