#pragma once
#include "reference/half.hpp"
#include "reference/lights/sampling.hpp"
#include "reference/lights/surface.hpp"
#include "reference/system/item_reads.hpp"
#include "reference/system/item_words.hpp"

namespace lockstep::lights {

/// What a point of normal n and albedo a sends to the eye. Twin of shaders/lights/lighting.glsl.
template <class R>
typename R::Vec3 radiance(R& r, const Host& host, const SystemView& state, const Surface<R>& surface) {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;
    const Switches& on = host.switches();
    const Vec3 u = r.note(site::grid_place, (surface.position - r.uniform(site::low, host.grid().origin)) *
                                                r.uniform(site::inv_voxel, host.inv_voxel()));
    const Sample<R> s = SamplingTwin<R>(r, host, state).mean_at(u);
    r.note(site::sampled_count, s[3]);
    const Real weight = r.note(site::sampled_weight, s[7]);
    const Vec3 d = r.note(site::sampled_direction, Vec3{s[4], s[5], s[6]});
    const Vec3 colour_at = r.note(site::sampled_colour, Vec3{s[0], s[1], s[2]});
    const Real m = r.note(site::length2, (d.x * d.x + d.y * d.y) + d.z * d.z);
    Real diffuse{};
    const bool has_answer = on.zero_direction != ZeroDirection::undefined;
    if (r.setting(site::no_direction, has_answer) && r.decide(site::no_direction, m == Real(0.0F))) {
        diffuse = on.zero_direction == ZeroDirection::isotropic ? 0.25F : 0.0F;
    } else {
        const Real length = r.note(site::direction_length, r.sqrt(site::direction_length, m));
        const Vec3 l = r.note(site::to_lights, d * r.divide(site::to_lights, Real(1.0F), length));
        const Vec3& n = surface.normal;
        const Real cosine = r.note(site::cosine, (n.x * l.x + n.y * l.y) + n.z * l.z);
        if (r.setting(site::faces_light, true))
            diffuse = r.max(Real(0.0F), cosine);
        else
            diffuse = cosine;
        diffuse = r.note(site::lambert, diffuse);
        if (on.shading == Shading::directionality) {
            const Real share = r.divide(site::directionality, length, weight);
            const Real k =
                r.note(site::directionality, r.setting(site::is_one, true) ? r.min(Real(1.0F), share) : share);
            diffuse = k * diffuse + (Real(1.0F) - k) * r.uniform(site::even_share, 0.25F);
        }
    }
    diffuse = r.note(site::diffuse, diffuse);
    const Vec3 ambient = r.uniform(site::ambient, host.settings().ambient);
    return r.note(site::radiance, surface.albedo * (ambient + colour_at * diffuse));
}

template <class R> typename R::Vec4 lit_pixel(R& r, const typename R::Vec3& v) {
    return r.note(site::lit, typename R::Vec4{v.x, v.y, v.z, typename R::Real(1.0F)});
}
template <class R> typename R::Vec4 background_pixel(R& r, const Host& host) {
    return lit_pixel(r, r.uniform(site::background, host.settings().background));
}
template <class R> ItemWords<R> words_of(const typename R::Vec4& v) {
    ItemWords<R> words;
    for (const auto& part : {v.x, v.y, v.z, v.w})
        words.add(part);
    return words;
}

/// The images that drawing the obstacles makes.
enum class Drawn { lit, depth, position, normal, albedo };

/// Twin of shaders/lights/forward_light_pass.*, and of gbuffer_pass.*.
struct DrawnTwin {
    HostPtr host;
    Drawn image;
    std::shared_ptr<const LatestTriangles> triangles; ///< one for all images
    std::shared_ptr<const TriangleView> view = {};
    std::shared_ptr<const SeenTriangles> seen = {}; ///< for readings of many lanes
    std::shared_ptr<const WrongObstacleBoxes> wrong_boxes = {};
    WrongDrawing drawing = WrongDrawing::none;
    glm::mat4 to_clip{1.0F};

    [[nodiscard]] DrawnTwin at(const PassInput& in) const {
        return {host,
                image,
                triangles,
                triangles->of(in.before),
                {},
                std::make_shared<const WrongObstacleBoxes>(),
                WrongDrawing::none,
                host->view_projection()};
    }
    [[nodiscard]] DrawnTwin handed(std::span<const Mistake> made) const {
        DrawnTwin mistaken = *this;
        mistaken.drawing = wrong_drawing(made);
        if (mistaken.drawing != WrongDrawing::none)
            mistaken.to_clip = handed_matrix(*host, mistaken.drawing);
        return mistaken;
    }
    void look(const PassInput& in) const { static_cast<void>(view->seen(in.before)); }
    bool fast(const FastRun& run) const; // image_lanes.cpp

    template <class R, class Item> ItemWords<R> operator()(R& r, const PassInput& in, const Item& item) const {
        using Real = typename R::Real;
        const SurfaceTwin<R> drawn(r, *host, in.before, to_clip, boxes(in.before), seen.get());
        const auto hit = drawn.at(pixel_at(host->settings().width, item));
        ItemWords<R> words;
        switch (image) {
        case Drawn::lit:
            return words_of<R>(hit ? lit_pixel(r, radiance(r, *host, in.before, drawn.surface(*hit)))
                                   : background_pixel(r, *host));
        case Drawn::depth:
            words.add(hit ? r.note(site::depth, hit->depth) : Real(1.0F));
            return words;
        case Drawn::albedo:
            if (hit)
                add_codes(r, words, drawn.albedo(*hit));
            else
                for (int c = 0; c < 4; ++c)
                    words.add(std::uint32_t{0});
            return words;
        case Drawn::position:
            return stored_words(r, site::stored_position, hit.has_value(), [&] {
                const typename R::Vec3 p = drawn.position(*hit);
                return r.setting(site::from_origin, true) ? p : p - r.uniform(site::eye, host->settings().camera.eye);
            });
        case Drawn::normal:
            return stored_words(r, site::stored_normal, hit.has_value(), [&] {
                return r.setting(site::own_value, true) ? drawn.normal(*hit) : drawn.position(*hit);
            });
        }
        return words;
    }

  private:
    [[nodiscard]] const BoxesByTile& boxes(const SystemView& state) const {
        return drawing == WrongDrawing::none
                   ? view->boxes()
                   : wrong_boxes->of(index_of(drawing), [&] { return obstacle_boxes(*host, state, drawing); });
    }
    template <class R, class Part> ItemWords<R> stored_words(R& r, At at, bool is_there, const Part& part) const {
        typename R::Vec4 v{};
        if (is_there) {
            const typename R::Vec3 of = part();
            v = {stored(r, of.x), stored(r, of.y), stored(r, of.z), r.note(site::valid, typename R::Real(1.0F))};
        }
        return words_of<R>(r.note(at, v));
    }
    template <class R, class Real> Real stored(R& r, const Real& x) const {
        return host->switches().gbuffer_format == Format::rgba16f ? r.monotone(x, half_round) : x;
    }
    template <class R> static void add_codes(R& r, ItemWords<R>& words, const typename R::Vec3& albedo) {
        for (const auto& share : {albedo.x, albedo.y, albedo.z}) {
            const int k = static_cast<int>(r.to_int(site::albedo, share * typename R::Real(256.0F)));
            words.add(static_cast<std::uint32_t>(k));
        }
        words.add(std::uint32_t{255});
    }
};

/// Twin of shaders/lights/deferred_light_pass.comp.
struct DeferredTwin {
    HostPtr host;

    bool fast(const FastRun& run) const; // image_lanes.cpp

    template <class R, class Item> ItemWords<R> operator()(R& r, const PassInput& in, const Item& item) const {
        using Real = typename R::Real;
        const Item from = read_at(r, item);
        const Real valid = item_real(r, site::valid, in.before, field::texel_position, from, 3);
        if (!r.decide(site::is_valid, valid != Real(0.0F)))
            return words_of<R>(background_pixel(r, *host));
        Surface<R> surface;
        surface.position = item_vec3(r, site::surface_point, in.before, field::texel_position, from);
        surface.normal = item_vec3(r, site::surface_normal, in.before, field::texel_normal, from);
        if constexpr (HasLanes<R>) {
            const auto share = [&](int c) {
                return whole_real(r, in.before, field::texel_albedo, from, c) * Real(1.0F / 256.0F);
            };
            surface.albedo = {share(0), share(1), share(2)};
        } else {
            const auto code = [&](int c) { return static_cast<float>(in.before.word(field::texel_albedo, from, c)); };
            surface.albedo = r.read(site::albedo, glm::vec3(code(0), code(1), code(2)) / 256.0F);
        }
        return words_of<R>(lit_pixel(r, radiance(r, *host, in.before, surface)));
    }

  private:
    template <class R, class Item> [[nodiscard]] Item read_at(R& r, const Item& item) const {
        if constexpr (!HasLanes<R>)
            if (const Settings& s = host->settings(); !r.setting(site::same_row, true)) {
                const Pixel pixel = Pixel::of(s.width, item);
                return item_of(pixel.x, s.height - 1 - pixel.y, s.width);
            }
        return item;
    }
};

} // namespace lockstep::lights
