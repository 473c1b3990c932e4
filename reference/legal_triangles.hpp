#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "reference/interval.hpp"
#include "reference/known_operations.hpp"
#include "reference/model/profile.hpp"
#include "reference/model/window_accuracy.hpp"
#include "reference/pixel_set.hpp"
#include "reference/triangle_interpolation.hpp"
#include "reference/triangle_raster.hpp"
#include "reference/window.hpp"

namespace lockstep {

/// How far a grid that is not known may move a point or a corner: a step of the coarsest that GL allows, or half a
/// pixel on a driver that was measured to be on none of these.
inline double grid_step(const KnownRaster& known) { return known.gl_grid ? 1.0 / 16.0 : 0.5; }

inline Interval accurate(Interval v, double relative) {
    return v.any ? v : interval::outward(v.low - relative * std::abs(v.low), v.high + relative * std::abs(v.high));
}

/// Perspective divide and viewport transform where their rounding is not known.
inline Interval window_coordinate(Interval clip, Interval w, double scale, double offset,
                                  const WindowAccuracy& accuracy) {
    const Interval ndc = accurate(interval::divide(clip, w), accuracy.ndc);
    const Interval scaled = accurate(interval::multiply(ndc, {scale, scale}), accuracy.scaled);
    return accurate(interval::add(scaled, {offset, offset}), accuracy.sum);
}

inline const WindowAccuracy& window_accuracy(bool measured) {
    return measured ? glsl_window_accuracy : gl_window_accuracy;
}

/// z and w interpolate like positions; their quotient is halved and moved, 2.5 ULP and two roundings.
inline double depth_bound(const std::array<glm::vec4, 3>& c, const ClipDepth& depth = {}) {
    const double z = interpolation_bound(c[0].z, c[1].z, c[2].z);
    const double w = interpolation_bound(c[0].w, c[1].w, c[2].w);
    const double least_w = std::min({std::abs(c[0].w), std::abs(c[1].w), std::abs(c[2].w)});
    return least_w > 0.0 ? std::abs(depth.scale()) * (z + w) / least_w + 3.0 * 0x1p-23 : 1.0;
}

/// The triangles of one image, assembled for whoever asks of its pixels, in whatever knowledge of the rasteriser.
struct AssembledTriangles {
    std::vector<glm::vec4> clip; ///< corners
    std::span<const std::uint32_t> indices;
    int width, height;
    RasterRules rules;
    ClipDepth depth;
    RasterRules finer_rules; ///< what the grid of `rules` makes a line of may be a triangle on the driver's
    std::vector<RasterTriangle> drawn, finer;

    AssembledTriangles(std::vector<glm::vec4> corners, std::span<const std::uint32_t> of, int image_width,
                       int image_height, const RasterRules& by, const ClipDepth& clip_depth = {})
        : clip(std::move(corners)), indices(of), width(image_width), height(image_height), rules(by), depth(clip_depth),
          finer_rules(by) {
        finer_rules.subpixel_bits = 12;
        drawn = assemble_triangles(clip, indices, width, height, rules, depth);
        finer = assemble_triangles(clip, indices, width, height, finer_rules, depth);
    }
};

/// A triangle at a pixel that it may cover.
struct LegalCover {
    const RasterTriangle& triangle; ///< on the grid of `rules`
    const RasterRules& rules;
    int x, y;
    bool covered; ///< by the reference
    bool sure;    ///< whatever the rounding
};

/// Which of the wanted pixels triangles may cover: what is known of the rasteriser is the reference's; otherwise each
/// corner may lie where GL lets it, and a centre on a side may belong to either of two triangles.
class LegalTriangles {
  public:
    /// `all_known`: nothing is open.
    LegalTriangles(const AssembledTriangles& triangles, const KnownRaster& known, bool all_known)
        : all_(triangles), known_(known), all_known_(all_known), coarse_(tolerance_on(triangles.rules)),
          fine_(tolerance_on(triangles.finer_rules)) {}

    /// Calls visit(cover) in drawing order for the wanted pixels.
    template <class Visit> void for_each(const PixelSet& wanted, const Visit& visit) const {
        const auto& drawn = all_.drawn;
        const auto primitives = static_cast<std::uint32_t>(all_.indices.size() / 3);
        std::vector<bool> judged(primitives, false);
        auto next = drawn.begin();
        for (std::uint32_t primitive = 0; primitive < primitives; ++primitive) {
            const auto first = next;
            while (next != drawn.end() && next->primitive == primitive)
                ++next;
            if (first != next && std::none_of(first, next, [&](const RasterTriangle& triangle) {
                    return may_reach(triangle, wanted);
                })) {
                judged[primitive] = true;
                continue;
            }
            const auto variants = possible_triangles(primitive);
            judged[primitive] = first != next || !variants.empty();
            if (!variants.empty())
                visit_variants(first == next ? nullptr : &*first, variants, wanted, visit);
            else
                std::for_each(first, next, [&](const RasterTriangle& triangle) {
                    visit_triangle(triangle, all_.rules, coarse_, wanted, visit);
                });
        }
        if (coarse_.side == 0.0)
            return;
        for (const RasterTriangle& triangle : all_.finer)
            if (!judged[triangle.primitive])
                visit_triangle(triangle, all_.finer_rules, fine_, wanted, visit);
    }

  private:
    /// How far a side may lie from where the reference puts it.
    struct Tolerance {
        double side; ///< steps of a grid
        int pixels;  ///< whole ones that these come to
    };

    /// What the grid makes of a triangle inside the clip volume, each corner's window coordinates being as accurate as
    /// was measured: along each axis one place, or two. None: a corner may lie anywhere that GL lets it.
    [[nodiscard]] std::vector<RasterTriangle> possible_triangles(std::uint32_t primitive) const {
        if (all_known_ || known_.triangle_window || !known_.corner_window_accurate || !known_.triangle_grid ||
            !known_.triangle_sides)
            return {};
        std::array<std::vector<glm::ivec2>, 3> places;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec4 corner = all_.clip[all_.indices[std::size_t{primitive} * 3 + k]];
            if (!in_clip_volume(corner, all_.depth))
                return {};
            const auto along = [&](float coordinate, int size) {
                const Interval window =
                    window_coordinate(coordinate, corner.w, size * 0.5, size * 0.5, glsl_window_accuracy);
                const auto at = [&](double x) { return snap_vertex(static_cast<float>(x), all_.rules); };
                return std::pair(at(window.low), at(window.high));
            };
            const auto [x0, x1] = along(corner.x, all_.width);
            const auto [y0, y1] = along(corner.y, all_.height);
            for (int y = y0; y <= y1; ++y)
                for (int x = x0; x <= x1; ++x)
                    places[k].emplace_back(x, y);
        }
        std::vector<RasterTriangle> triangles;
        for (const glm::ivec2 a : places[0])
            for (const glm::ivec2 b : places[1])
                for (const glm::ivec2 c : places[2])
                    if (const auto triangle = raster_triangle(a, b, c, primitive))
                        triangles.push_back(*triangle);
        return triangles;
    }

    /// Calls visit(x, y) for the wanted pixels that a triangle may reach.
    template <class Visit> void for_each_wanted(const RasterTriangle& triangle, int bits, int beside,
                                                const PixelSet& wanted, const Visit& visit) const {
        const auto& c = triangle.corners;
        const int x0 = (std::min({c[0].x, c[1].x, c[2].x}) >> bits) - beside;
        const int y0 = (std::min({c[0].y, c[1].y, c[2].y}) >> bits) - beside;
        const int x1 = (std::max({c[0].x, c[1].x, c[2].x}) >> bits) + 1 + beside;
        const int y1 = (std::max({c[0].y, c[1].y, c[2].y}) >> bits) + 1 + beside;
        wanted.for_each({x0, y0, x1 + 1, y1 + 1}, visit);
    }

    /// Whether a wanted pixel lies where a triangle, or what rounding can make of it, is looked for.
    [[nodiscard]] bool may_reach(const RasterTriangle& triangle, const PixelSet& wanted) const {
        bool reached = false;
        for_each_wanted(triangle, all_.rules.subpixel_bits, std::max(1, coarse_.pixels), wanted,
                        [&](int, int) { reached = true; });
        return reached;
    }

    static bool covers(const RasterTriangle& triangle, const RasterRules& rules, int x, int y) {
        bool covered = false;
        for_each_pixel(triangle, rules, {x, y, x + 1, y + 1}, [&](int, int) { covered = true; });
        return covered;
    }

    /// `drawn`: the reference's of these; null: it makes a line of them.
    template <class Visit> void visit_variants(const RasterTriangle* drawn, const std::vector<RasterTriangle>& variants,
                                               const PixelSet& wanted, const Visit& visit) const {
        const RasterTriangle& shape = drawn != nullptr ? *drawn : variants.front();
        const RasterRules& rules = all_.rules;
        for_each_wanted(shape, rules.subpixel_bits, 1, wanted, [&](int x, int y) {
            const auto covering = std::count_if(variants.begin(), variants.end(),
                                                [&](const RasterTriangle& t) { return covers(t, rules, x, y); });
            const bool covered = drawn != nullptr && covers(*drawn, rules, x, y);
            if (covered || covering > 0)
                visit(LegalCover{shape, rules, x, y, covered,
                                 covered && static_cast<std::size_t>(covering) == variants.size()});
        });
    }

    template <class Visit> void visit_triangle(const RasterTriangle& triangle, const RasterRules& rules,
                                               const Tolerance& beside, const PixelSet& wanted,
                                               const Visit& visit) const {
        const bool exact = all_known_ || known_.triangles();
        const double tolerance = beside.side;
        for_each_wanted(triangle, rules.subpixel_bits, beside.pixels, wanted, [&](int x, int y) {
            const bool covered = covers(triangle, rules, x, y);
            const double margin = exact ? HUGE_VAL : nearest_side(triangle, x, y, rules).distance;
            if (covered || margin <= tolerance)
                visit(LegalCover{triangle, rules, x, y, covered, covered && margin > tolerance});
        });
    }

    /// Each corner by what its window coordinate may err and by a step of the grid, along both axes.
    [[nodiscard]] Tolerance tolerance_on(const RasterRules& rules) const {
        if (all_known_ || known_.triangles() || (known_.triangle_window && known_.triangle_grid))
            return {0.0, 0};
        const double size = std::max(all_.width, all_.height);
        const double window =
            known_.triangle_window ? 0.0 : window_accuracy(known_.corner_window_accurate).error(size, size * 0.5);
        const double step = known_.triangle_grid ? std::ldexp(1.0, -all_.rules.subpixel_bits) : grid_step(known_);
        const double pixels = (window + step) * std::sqrt(2.0);
        return {std::ldexp(pixels, rules.subpixel_bits), static_cast<int>(std::ceil(pixels))};
    }

    const AssembledTriangles& all_;
    KnownRaster known_;
    bool all_known_;
    Tolerance coarse_, fine_;
};

} // namespace lockstep
