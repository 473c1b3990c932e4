#pragma once
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "reference/lights/glow_boxes.hpp"
#include "reference/lights/lighting_twin.hpp"
#include "reference/plain_arithmetic.hpp"
#include "reference/system/tile_rows.hpp"

namespace lockstep::lights {

struct GlowTwin;
void draw_row(const GlowTwin& twin, const Portable& arithmetic, const PassInput& in, std::size_t row,
              const WritableView& after);
void draw_row(const GlowTwin& twin, const PlainArithmetic& arithmetic, const PassInput& in, std::size_t row,
              const WritableView& after);

/// Discs around the lights, added to the lit image by blending where nothing nearer is: in the order of drawing where
/// the driver is followed, else in any. Twin of shaders/lights/glow_pass.*.
struct GlowTwin {
    HostPtr host;
    std::shared_ptr<const GlowBoxes> boxes = {};
    GlowDrawing drawing = {};
    std::size_t rows = 0; ///< of tiles
    glm::mat4 to_clip{1.0F};

    [[nodiscard]] GlowTwin at(const PassInput& in) const {
        auto made = std::make_shared<const GlowBoxes>();
        const std::size_t all = made->of({}, *host, in.before).rows();
        return {host, std::move(made), {}, all, host->view_projection()};
    }
    [[nodiscard]] GlowTwin handed(std::span<const Mistake> made) const {
        GlowTwin mistaken = *this;
        mistaken.drawing = glow_drawing(made);
        if (mistaken.drawing.matrix != WrongDrawing::none)
            mistaken.to_clip = handed_matrix(*host, mistaken.drawing.matrix);
        return mistaken;
    }

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        using Real = typename R::Real;
        using Vec3 = typename R::Vec3;
        const Pixel pixel = Pixel::of(host->settings().width, item);
        const glm::vec4 before = in.before.vec4(field::pixel, item);
        Vec3 sum = r.read(site::lit_before, glm::vec3(before));
        Real alpha = r.read(site::lit_before, before.w);
        const bool is_added = r.setting(site::blends, true), keeps_alpha = r.setting(site::keeps_alpha, true);
        const BoxesByTile& tried = boxes->of(drawing, *host, in.before);
        std::vector<Vec3> terms; // in any order
        if (!host->follows_driver())
            terms.push_back(sum);
        for (const std::uint32_t i : tried.near(pixel))
            if (pixel.is_in(tried.box(i)))
                if (const auto disc = disc_of(r, in, i))
                    offer(r, in, *disc, pixel, item, [&](bool covered, const Vec3& c) {
                        if (!covered)
                            return;
                        sum = is_added ? sum + c : c;
                        if (!is_added || !keeps_alpha)
                            alpha = is_added ? alpha + Real(1.0F) : Real(0.0F);
                        if (!host->follows_driver())
                            terms.push_back(c);
                    });
        if (terms.size() > 1)
            sum = in_any_order(r, terms);
        return words_of<R>(r.note(site::lit, typename R::Vec4{sum.x, sum.y, sum.z, alpha}));
    }

    // Light by light, a row of tiles at a time (glow_lanes.cpp).
    [[nodiscard]] std::size_t parts() const { return rows; }
    template <class A>
    void part(const Values<A>& r, const PassInput& in, std::size_t row, const WritableView& after) const {
        draw_row(*this, arithmetic_of(r), in, row, after);
    }

    /// A light before the camera.
    template <class R> struct Disc {
        std::uint32_t light;
        typename R::Vec4 clip;
        typename R::Real depth, x, y, radius;
    };
    template <class R> std::optional<Disc<R>> disc_of(R& r, const PassInput& in, std::uint32_t light) const {
        using Real = typename R::Real;
        const Real zero(0.0F), one(1.0F), half(0.5F);
        Disc<R> disc{light, {}, {}, {}, {}, {}};
        disc.clip = r.note(site::clip, r.transform(site::clip, r.uniform(site::projection, to_clip),
                                                   r.read(site::before, in.before.vec3(field::light_position, light))));
        if (!r.decide(site::before_camera, disc.clip.w > zero))
            return {};
        disc.depth = r.note(site::glow_depth, r.divide(site::glow_depth, disc.clip.z, disc.clip.w) * half + half);
        if (!r.decide(site::glow_in_planes, disc.depth >= zero && disc.depth <= one))
            return {};
        place(r, disc);
        return disc;
    }
    /// Calls `made(covered, colour)` where the disc may cover the pixel.
    template <class R, class Place, class Item, class Made> void offer(R& r, const PassInput& in, const Disc<R>& disc,
                                                                       const Place& pixel, const Item& item,
                                                                       const Made& made) const {
        using Real = typename R::Real;
        const Real one(1.0F), half(0.5F);
        const auto nearer = decided(r, site::glow_nearer,
                                    disc.depth < item_real(r, site::stored_depth, in.before, field::texel_depth, item));
        if (nowhere(nearer))
            return;
        const Real dx = r.note(
            site::disc_x, r.divide(site::disc_x, r.note(site::centre_x, r.real(pixel.x) + half) - disc.x, disc.radius));
        const Real dy = r.note(
            site::disc_y, r.divide(site::disc_y, r.note(site::centre_y, r.real(pixel.y) + half) - disc.y, disc.radius));
        const Real d2 = r.note(site::disc, dx * dx + dy * dy);
        const auto on_disc = decided(r, site::on_disc, d2 < one);
        if (nowhere(on_disc))
            return;
        const Real share = r.note(site::glow_share, one - d2);
        made(nearer && on_disc,
             r.note(site::glow_colour, r.read(site::colour_before, in.before.vec3(field::light_colour, disc.light)) *
                                           share * r.uniform(site::glow_gain, host->settings().glow_gain)));
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
};

} // namespace lockstep::lights
