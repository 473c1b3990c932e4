#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "reference/fluid/sprite.hpp"
#include "reference/system/item_twin.hpp"
#include "reference/system/item_words.hpp"

namespace lockstep::fluid {

/// No thickness. Twin of shaders/fluid/thickness_clear_pass.comp.
struct ThicknessClearTwin {
    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        ItemWords<R> words;
        words.add(r.setting(site::is_cleared, true) ? std::uint32_t{0} : in.before.word(field::thickness, item));
        return words;
    }
};

struct ThicknessTwin;
void draw_row(const ThicknessTwin& twin, const Portable& arithmetic, const PassInput& in, std::size_t row,
              const WritableView& after);
void draw_row(const ThicknessTwin& twin, const PlainArithmetic& arithmetic, const PassInput& in, std::size_t row,
              const WritableView& after);

/// The spheres of each pixel, added up. Twin of shaders/fluid/thickness_pass.*.
struct ThicknessTwin {
    HostPtr host;
    BoxesByTile boxes = {};
    std::shared_ptr<DrawnBalls> balls = {};
    std::shared_ptr<BoxesAround> around = {};

    [[nodiscard]] ThicknessTwin at(const PassInput& in) const {
        return {host, sprite_boxes(*host, in.before, spheres()),
                std::make_shared<DrawnBalls>(in.before[particle_buffer].count()), std::make_shared<BoxesAround>()};
    }

    [[nodiscard]] HandedSpheres<ThicknessTwin> handed(std::span<const Mistake> made) const { return {*this, made}; }

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        return at_pixel(r, in, item, Tried::in_their_boxes);
    }
    template <class R> ItemWords<R> at_pixel(R& r, const PassInput& in, std::size_t item, Tried tried) const {
        using Real = typename R::Real;
        const Pixel pixel = Pixel::of(host->settings().width, item);
        const SpriteTwin<R> sprite(r, *host, in.before, spheres());
        std::vector<Real> terms;
        const std::size_t count = in.before[particle_buffer].count();
        for_each_tried(*this, in.before, pixel, tried, [&](std::uint32_t i) {
            if (i + 1 == count && !r.setting(site::takes_last_sphere, true))
                return;
            if (const auto ball = sprite.ball(i))
                addend(r, sprite, *ball, meeting(r, *host, in, sprite, *ball, item), [&](bool covered, const Real& t) {
                    if (covered)
                        terms.push_back(t);
                });
        });
        ItemWords<R> words;
        if (!terms.empty() && !r.setting(site::adds_all, true))
            terms.resize(1);
        if (is_fixed())
            words.add(units_of(in.before.word(field::thickness, item), terms));
        else
            words.add(r.note(site::thickness, r.any_order_sum(site::thickness, terms)));
        return words;
    }

    // Sphere by sphere, a row of tiles at a time (sphere_lanes.cpp).
    [[nodiscard]] std::size_t parts() const { return boxes.rows(); }
    template <class A>
    void part(const Values<A>& r, const PassInput& in, std::size_t row, const WritableView& after) const {
        draw_row(*this, arithmetic_of(r), in, row, after);
    }

    [[nodiscard]] Spheres spheres() const { return {Sphere::flat, host->thickness_radius()}; }
    [[nodiscard]] bool is_fixed() const { return host->switches().thickness_sum == ThicknessSum::fixed; }

    /// Calls `made(covered, t)` where the sphere may cover the pixel: metres, or units of 2^-16 of a fixed sum.
    template <class R, class Meets, class Made>
    void addend(R& r, const SpriteTwin<R>& sprite, const Ball<R>& ball, const Meets& meets, const Made& made) const {
        using Real = typename R::Real;
        const Real squared = meets.squared();
        // Lanes go on: a branch that is hard to foretell takes longer than what it leaves out.
        const auto off = sprite.is_off(squared);
        if (!HasLanes<R> && everywhere(off))
            return;
        auto covered = !off;
        if (host->switches().scene_depth == SceneDepth::test) {
            const auto nearer =
                decided(r, site::nearer_than_scene, before_scene(r, *host, meets.scene, meets.window()));
            if (!HasLanes<R> && nowhere(nearer))
                return;
            covered = covered && nearer;
        }
        const Real drawn = r.uniform(site::gain, host->thickness_gain()) * sprite.height(squared);
        const Real t = r.note(site::addend, sprite.addend_if_drawn(ball, drawn));
        if (host->switches().thickness_sum == ThicknessSum::blend) {
            made(covered, t);
            return;
        }
        const Real q =
            r.note(site::quantum, r.floor(r.uniform(site::units, 65536.0F) * t + r.uniform(site::half_unit, 0.5F)));
        made(covered, is_fixed() ? q : q * Real(1.0F / 65536.0F));
    }

  private:
    /// Whole numbers are added whatever the order.
    template <class Real> static LegalWord units_of(std::uint32_t before, const std::vector<Real>& terms) {
        LegalWord sum = LegalWord::exactly(before);
        for (const Real& term : terms) {
            const Interval set = item_twin::set_of(term);
            if (set.any)
                return {sum.word, Interval::anything()};
            sum.word += static_cast<std::uint32_t>(set.as_float());
            sum.set.low += set.low;
            sum.set.high += set.high;
        }
        return sum;
    }
};

} // namespace lockstep::fluid
