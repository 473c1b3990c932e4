#pragma once
#include <cstring>

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
                if (const auto share = share_of(r, in, i, pixel, item)) {
                    const Vec3 c = colour(r, in, i, *share);
                    sum = sum + c;
                    if (!host->follows_driver())
                        terms.push_back(c);
                }
        if (terms.size() > 1)
            sum = in_any_order(r, terms);
        const Real alpha = r.read(site::lit_before, before.w);
        return words_of<R>(r.note(site::lit, typename R::Vec4{sum.x, sum.y, sum.z, alpha}));
    }

    // Light by light, a row of tiles at a time.
    [[nodiscard]] std::size_t parts() const { return boxes.rows(); }
    template <class R> void part(R& r, const PassInput& in, std::size_t row, const WritableView& after) const {
        using Real = typename R::Real;
        using Vec3 = typename R::Vec3;
        struct Texel {
            bool is_lit;
            Vec3 sum;
        };
        const auto before = [&](std::size_t item) {
            return r.read(site::lit_before, glm::vec3(in.before.vec4(field::pixel, item)));
        };
        boxes.template draw<Texel>(
            row, Texel{false, {}},
            [&](std::uint32_t i) {
                auto disc = disc_of(r, in, i);
                if (disc)
                    place(r, *disc);
                return disc;
            },
            [&](Texel& texel, const Disc<R>& disc, const Pixel& pixel, std::size_t item) {
                if (!is_nearer(r, in, disc, item))
                    return;
                const auto share = share_on(r, disc, pixel);
                if (!share)
                    return;
                if (!texel.is_lit) {
                    const Vec3 first = before(item), zero{};
                    texel = {true, host->follows_driver() ? first : zero + first};
                }
                texel.sum = texel.sum + colour(r, in, disc.light, *share);
            },
            [&](const Texel& texel, std::size_t item) {
                const Vec3 sum = texel.is_lit ? texel.sum : before(item);
                const Real alpha = r.read(site::lit_before, in.before.real(field::pixel, item, 3));
                std::byte* to = after.columns[0] + item * 4 * sizeof(float);
                for (const Real& x : {sum.x, sum.y, sum.z, alpha}) {
                    const std::uint32_t word = item_twin::word_of(x);
                    std::memcpy(to, &word, sizeof word);
                    to += sizeof word;
                }
            });
    }

  private:
    /// A light before the camera.
    template <class R> struct Disc {
        std::uint32_t light;
        typename R::Vec4 clip;
        typename R::Real depth, x, y, radius;
    };
    template <class R>
    typename R::Vec3 colour(R& r, const PassInput& in, std::uint32_t light, const typename R::Real& share) const {
        return r.note(site::glow_colour, r.read(site::colour_before, in.before.vec3(field::light_colour, light)) *
                                             share * r.uniform(site::glow_gain, host->settings().glow_gain));
    }
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
    template <class R> std::optional<Disc<R>> disc_of(R& r, const PassInput& in, std::uint32_t light) const {
        using Real = typename R::Real;
        const Real zero(0.0F), one(1.0F), half(0.5F);
        Disc<R> disc{light, {}, {}, {}, {}, {}};
        disc.clip = r.note(site::clip, r.transform(site::clip, r.uniform(site::projection, host->view_projection()),
                                                   r.read(site::before, in.before.vec3(field::light_position, light))));
        if (!r.decide(site::before_camera, disc.clip.w > zero))
            return {};
        disc.depth = r.note(site::glow_depth, r.divide(site::glow_depth, disc.clip.z, disc.clip.w) * half + half);
        if (!r.decide(site::glow_in_planes, disc.depth >= zero && disc.depth <= one))
            return {};
        return disc;
    }
    template <class R> void place(R& r, Disc<R>& disc) const {
        using Real = typename R::Real;
        const Settings& s = host->settings();
        const Real one(1.0F), half(0.5F);
        const typename R::Vec4& clip = disc.clip;
        disc.x = r.note(site::glow_x, (r.divide(site::glow_x, clip.x, clip.w) + one) * half * r.real(s.width));
        disc.y = r.note(site::glow_y, (r.divide(site::glow_y, clip.y, clip.w) + one) * half * r.real(s.height));
        disc.radius = r.note(site::glow_radius,
                             r.divide(site::glow_radius, r.uniform(site::disc_scale, host->disc_scale()), clip.w));
    }
    template <class R> bool is_nearer(R& r, const PassInput& in, const Disc<R>& disc, std::size_t item) const {
        return r.decide(site::glow_nearer,
                        disc.depth < r.read(site::stored_depth, in.before.real(field::texel_depth, item)));
    }
    template <class R> std::optional<typename R::Real> share_on(R& r, const Disc<R>& disc, const Pixel& pixel) const {
        using Real = typename R::Real;
        const Real one(1.0F), half(0.5F);
        const Real dx = r.note(
            site::disc_x, r.divide(site::disc_x, r.note(site::centre_x, r.real(pixel.x) + half) - disc.x, disc.radius));
        const Real dy = r.note(
            site::disc_y, r.divide(site::disc_y, r.note(site::centre_y, r.real(pixel.y) + half) - disc.y, disc.radius));
        const Real d2 = r.note(site::disc, dx * dx + dy * dy);
        if (!r.decide(site::on_disc, d2 < one))
            return {};
        return r.note(site::glow_share, one - d2);
    }
    template <class R> std::optional<typename R::Real> share_of(R& r, const PassInput& in, std::uint32_t light,
                                                                const Pixel& pixel, std::size_t item) const {
        auto disc = disc_of(r, in, light);
        if (!disc || !is_nearer(r, in, *disc, item))
            return {};
        place(r, *disc);
        return share_on(r, *disc, pixel);
    }
};

} // namespace lockstep::lights
