#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "reference/draw_in_bands.hpp"
#include "reference/pixel_box.hpp"
#include "reference/portable.hpp"
#include "reference/triangle_interpolation.hpp"
#include "reference/triangle_raster.hpp"

namespace lockstep {

/// Draws the triangles `indices` makes of `clip`, in order, into an image of width x height: `shader(i)` gives the
/// fragment shader of triangle i, which is called with x, y, its TriangleInterpolation<A>::Weights and the window depth
/// of every pixel covered. What is covered, the driver's rasteriser decides (triangle_raster.hpp), or, where A is
/// Portable, the fragment shader itself.
template <class A, class Shader>
void draw_triangles(A fp, std::span<const glm::vec4> clip, std::span<const std::uint32_t> indices, int width,
                    int height, const Profile& profile, const Shader& shader, const ClipDepth& depth = {}) {
    const auto corners = [&](std::size_t i) {
        return std::array{clip[indices[3 * i]], clip[indices[3 * i + 1]], clip[indices[3 * i + 2]]};
    };
    if constexpr (std::is_same_v<A, Portable>) {
        std::vector<PixelRect> boxes(indices.size() / 3);
        for (std::size_t i = 0; i < boxes.size(); ++i)
            boxes[i] = triangle_box(fp, corners(i), width, height);
        const auto rows = [&](std::size_t i) { return std::pair{boxes[i].y0, boxes[i].y1 - 1}; };
        const auto draw = [&](std::size_t i, const PixelRect& area) {
            const TriangleInterpolation interpolation(fp, corners(i), width, height, depth);
            const auto shade = shader(i);
            for (int y = std::max(boxes[i].y0, area.y0); y < std::min(boxes[i].y1, area.y1); ++y)
                for (int x = boxes[i].x0; x < boxes[i].x1; ++x)
                    if (const auto fragment = interpolation.fragment(x, y))
                        shade(x, y, fragment->weights, fragment->depth);
        };
        draw_in_bands(boxes.size(), width, height, profile, rows, draw);
    } else {
        const auto triangles = assemble_triangles(clip, indices, width, height, profile.raster, depth);
        const auto rows = [&](std::size_t i) { return rows_touched(triangles[i], profile.raster); };
        const auto draw = [&](std::size_t i, const PixelRect& area) {
            const std::size_t triangle = triangles[i].primitive;
            const TriangleInterpolation interpolation(fp, corners(triangle), width, height, depth);
            const auto shade = shader(triangle);
            for_each_pixel(triangles[i], profile.raster, area, [&](int x, int y) {
                const auto weights = interpolation.weights(x, y);
                shade(x, y, weights, interpolation.depth(weights));
            });
        };
        draw_in_bands(triangles.size(), width, height, profile, rows, draw);
    }
}

} // namespace lockstep
