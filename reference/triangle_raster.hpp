#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "reference/model/profile.hpp"
#include "reference/window.hpp"

namespace lockstep {

/// The fixed-function way from clip-space triangles to covered pixels (GL 4.5, 13.5 and 14.6.1). Both faces are drawn;
/// a pixel is covered when its centre lies inside, a centre on an edge by the fill rule in RasterRules. Sub-pixel
/// positions are those of window.hpp; coverage is decided in integers, so it has no rounding of its own.

/// A convex polygon in clip space; size 0: nothing is left.
struct ClipPolygon {
    std::array<glm::vec4, 9> corners{};
    std::size_t size = 0;
};

/// The part of a triangle inside the clip volume -w <= x, y, z <= w: planes x = w, x = -w, y = w, y = -w, z = -w (0 as
/// ClipDepth has it), z = w in this order, each only if a corner of the triangle lies beyond it. A cut is interpolated
/// from whichever end of the side lies nearer to the plane, so triangles sharing a side share its cut. A triangle with
/// a distance that is not finite is dropped.
ClipPolygon clip_triangle(const std::array<glm::vec4, 3>& triangle, const ClipDepth& depth = {});

/// A triangle on the sub-pixel grid, corners counterclockwise with y up.
struct RasterTriangle {
    std::array<glm::ivec2, 3> corners{};
    std::uint32_t primitive = 0; ///< index of the triangle it was cut from
};

/// Corners in either order. Nothing: they make no area.
std::optional<RasterTriangle> raster_triangle(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c, std::uint32_t primitive);

/// Clips and snaps the triangles `indices` makes of `clip` for a viewport of width x height at the origin, and drops
/// those of no area. Clipped ones become fans. Drawing order is kept.
std::vector<RasterTriangle> assemble_triangles(std::span<const glm::vec4> clip, std::span<const std::uint32_t> indices,
                                               int width, int height, const RasterRules& rules,
                                               const ClipDepth& depth = {});

/// Calls visit(x, y) for every pixel of `area` that `triangle` covers, row by row.
template <class Visit>
void for_each_pixel(const RasterTriangle& triangle, const RasterRules& rules, const PixelRect& area, Visit&& visit) {
    const auto& c = triangle.corners;
    const int bits = rules.subpixel_bits;
    const std::int32_t below_centre = (1 << bits) - 1;
    const int x0 = std::max(area.x0, (std::min({c[0].x, c[1].x, c[2].x}) + below_centre) >> bits);
    const int y0 = std::max(area.y0, (std::min({c[0].y, c[1].y, c[2].y}) + below_centre) >> bits);
    const int x1 = std::min(area.x1, (std::max({c[0].x, c[1].x, c[2].x}) >> bits) + 1);
    const int y1 = std::min(area.y1, (std::max({c[0].y, c[1].y, c[2].y}) >> bits) + 1);
    if (x0 >= x1 || y0 >= y1)
        return;

    // A centre is inside when the edge function (b - a) x (p - a) of every side is positive; it may be zero on the
    // sides that own their points, which is where 1 is not subtracted.
    std::array<std::int64_t, 3> row{}, step_x{}, step_y{};
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::ivec2 a = c[i];
        const glm::ivec2 b = c[(i + 1) % 3];
        const std::int64_t dx = std::int64_t{b.x} - a.x;
        const std::int64_t dy = std::int64_t{b.y} - a.y;
        const bool left = dy < 0;
        const bool lower = dy == 0 && dx > 0;
        const bool owns = dy == 0 ? lower == rules.lower_edge_in : left == rules.left_edge_in;
        row[i] = dx * ((std::int64_t{y0} << bits) - a.y) - dy * ((std::int64_t{x0} << bits) - a.x) - (owns ? 0 : 1);
        step_x[i] = -dy * (std::int64_t{1} << bits);
        step_y[i] = dx * (std::int64_t{1} << bits);
    }
    for (int y = y0; y < y1; ++y) {
        std::array<std::int64_t, 3> edge = row;
        for (int x = x0; x < x1; ++x) {
            if ((edge[0] | edge[1] | edge[2]) >= 0)
                visit(x, y);
            for (std::size_t i = 0; i < 3; ++i)
                edge[i] += step_x[i];
        }
        for (std::size_t i = 0; i < 3; ++i)
            row[i] += step_y[i];
    }
}

/// The first and last row whose pixels it may cover.
std::pair<int, int> rows_touched(const RasterTriangle& triangle, const RasterRules& rules);

/// The side of a triangle that lies nearest to a pixel's centre. Another driver may decide the pixel otherwise only
/// where the distance is small: within its snapping error, 1 for 8 sub-pixel bits.
struct NearestSide {
    double distance;    ///< sub-pixel units
    glm::dvec2 outward; ///< normal of length 1; 0 where a corner is nearest
};
NearestSide nearest_side(const RasterTriangle& triangle, int x, int y, const RasterRules& rules);

} // namespace lockstep
