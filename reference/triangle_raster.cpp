#include "reference/triangle_raster.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace lockstep {
namespace {

constexpr unsigned plane_count = 6;

/// Not negative inside.
float plane_distance(glm::vec4 v, unsigned plane, const ClipDepth& depth) {
    if (plane == 4 && depth.from_zero())
        return v.z;
    const float coordinate = plane < 2 ? v.x : plane < 4 ? v.y : v.z;
    const bool lower = plane == 1 || plane == 3 || plane == 4;
    return lower ? coordinate + v.w : -coordinate + v.w;
}

/// One bit a plane the corner lies beyond; NaN lies beyond all.
unsigned outside_planes(glm::vec4 v, const ClipDepth& depth) {
    unsigned planes = 0;
    for (unsigned plane = 0; plane < plane_count; ++plane)
        planes |= !(plane_distance(v, plane, depth) >= 0.0F) ? 1U << plane : 0U;
    return planes;
}

glm::vec4 interpolate(glm::vec4 from, glm::vec4 to, float t) {
    return {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y), from.z + t * (to.z - from.z),
            from.w + t * (to.w - from.w)};
}

glm::vec4 cut(glm::vec4 inside, float in_distance, glm::vec4 outside, float out_distance) {
    return -out_distance < in_distance ? interpolate(outside, inside, out_distance / (out_distance - in_distance))
                                       : interpolate(inside, outside, in_distance / (in_distance - out_distance));
}

/// Sutherland and Hodgman 1974, one plane.
ClipPolygon clip_to_plane(const ClipPolygon& polygon, unsigned plane, const ClipDepth& depth) {
    ClipPolygon kept;
    for (std::size_t i = 0; i < polygon.size; ++i) {
        const glm::vec4 a = polygon.corners[i];
        const glm::vec4 b = polygon.corners[(i + 1) % polygon.size];
        const float a_distance = plane_distance(a, plane, depth);
        const float b_distance = plane_distance(b, plane, depth);
        if (!std::isfinite(a_distance) || !std::isfinite(b_distance))
            return {};
        const bool a_inside = a_distance >= 0.0F;
        const bool b_inside = b_distance >= 0.0F;
        if (a_inside)
            kept.corners[kept.size++] = a;
        if (a_inside && !b_inside)
            kept.corners[kept.size++] = cut(a, a_distance, b, b_distance);
        if (b_inside && !a_inside)
            kept.corners[kept.size++] = cut(b, b_distance, a, a_distance);
    }
    return kept;
}

ClipPolygon clip_to_planes(const std::array<glm::vec4, 3>& triangle, unsigned planes, const ClipDepth& depth) {
    ClipPolygon polygon{{triangle[0], triangle[1], triangle[2]}, 3};
    for (unsigned plane = 0; plane < plane_count && polygon.size >= 3; ++plane)
        if ((planes & 1U << plane) != 0)
            polygon = clip_to_plane(polygon, plane, depth);
    return polygon.size >= 3 ? polygon : ClipPolygon{};
}

struct Viewport {
    int width, height;
    const RasterRules& rules;

    /// Nothing where the perspective divide overflows.
    [[nodiscard]] std::optional<glm::ivec2> snap(glm::vec4 clip) const {
        constexpr float limit = 0x1p20F;
        const WindowPosition window = window_position(clip, width, height, rules.vertex_viewport);
        if (!(std::abs(window.x) < limit) || !(std::abs(window.y) < limit))
            return {};
        return glm::ivec2(snap_vertex(window.x, rules), snap_vertex(window.y, rules));
    }
};

struct AssembledVertex {
    glm::ivec2 snapped{0};
    unsigned outside = 0; ///< planes it lies beyond
    bool finite = true;
};

void append(std::vector<RasterTriangle>& triangles, glm::ivec2 a, glm::ivec2 b, glm::ivec2 c, std::uint32_t primitive) {
    if (const auto triangle = raster_triangle(a, b, c, primitive))
        triangles.push_back(*triangle);
}

void append_fan(std::vector<RasterTriangle>& triangles, const ClipPolygon& polygon, const Viewport& viewport,
                std::uint32_t primitive) {
    std::array<glm::ivec2, std::tuple_size_v<decltype(polygon.corners)>> snapped{};
    for (std::size_t i = 0; i < polygon.size; ++i) {
        const auto corner = viewport.snap(polygon.corners[i]);
        if (!corner)
            return;
        snapped[i] = *corner;
    }
    for (std::size_t i = 2; i < polygon.size; ++i)
        append(triangles, snapped[i - 1], snapped[i], snapped[0], primitive);
}

} // namespace

std::optional<RasterTriangle> raster_triangle(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c, std::uint32_t primitive) {
    const std::int64_t area =
        (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) - (std::int64_t{c.x} - a.x) * (std::int64_t{b.y} - a.y);
    if (area == 0)
        return {};
    if (area < 0)
        std::swap(b, c);
    return RasterTriangle{{a, b, c}, primitive};
}

ClipPolygon clip_triangle(const std::array<glm::vec4, 3>& triangle, const ClipDepth& depth) {
    const std::array outside{outside_planes(triangle[0], depth), outside_planes(triangle[1], depth),
                             outside_planes(triangle[2], depth)};
    if ((outside[0] & outside[1] & outside[2]) != 0)
        return {};
    return clip_to_planes(triangle, outside[0] | outside[1] | outside[2], depth);
}

std::vector<RasterTriangle> assemble_triangles(std::span<const glm::vec4> clip, std::span<const std::uint32_t> indices,
                                               int width, int height, const RasterRules& rules,
                                               const ClipDepth& depth) {
    const Viewport viewport{width, height, rules};
    std::vector<AssembledVertex> vertices(clip.size());
    for (std::size_t i = 0; i < clip.size(); ++i) {
        vertices[i].outside = outside_planes(clip[i], depth);
        if (vertices[i].outside != 0)
            continue;
        const auto snapped = viewport.snap(clip[i]);
        vertices[i].finite = snapped.has_value();
        vertices[i].snapped = snapped.value_or(glm::ivec2(0));
    }
    std::vector<RasterTriangle> triangles;
    triangles.reserve(indices.size() / 3);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const AssembledVertex& a = vertices[indices[i]];
        const AssembledVertex& b = vertices[indices[i + 1]];
        const AssembledVertex& c = vertices[indices[i + 2]];
        const auto primitive = static_cast<std::uint32_t>(i / 3);
        const unsigned outside = a.outside | b.outside | c.outside;
        if (outside == 0 && a.finite && b.finite && c.finite)
            append(triangles, a.snapped, b.snapped, c.snapped, primitive);
        else if (outside != 0 && (a.outside & b.outside & c.outside) == 0)
            append_fan(triangles,
                       clip_to_planes({clip[indices[i]], clip[indices[i + 1]], clip[indices[i + 2]]}, outside, depth),
                       viewport, primitive);
    }
    return triangles;
}

std::pair<int, int> rows_touched(const RasterTriangle& triangle, const RasterRules& rules) {
    const auto [low, high] = std::minmax({triangle.corners[0].y, triangle.corners[1].y, triangle.corners[2].y});
    return {low >> rules.subpixel_bits, high >> rules.subpixel_bits};
}

NearestSide nearest_side(const RasterTriangle& triangle, int x, int y, const RasterRules& rules) {
    const glm::dvec2 centre(std::int64_t{x} << rules.subpixel_bits, std::int64_t{y} << rules.subpixel_bits);
    NearestSide nearest{HUGE_VAL, glm::dvec2(0.0)};
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 a(triangle.corners[i]);
        const glm::dvec2 side = glm::dvec2(triangle.corners[(i + 1) % 3]) - a;
        const double length_squared = glm::dot(side, side);
        const double along = length_squared > 0.0 ? glm::dot(centre - a, side) / length_squared : 0.0;
        const double distance = glm::length(centre - a - std::clamp(along, 0.0, 1.0) * side);
        if (!(distance < nearest.distance))
            continue;
        const bool beside_it = 0.0 < along && along < 1.0;
        nearest = {distance, beside_it ? glm::dvec2(side.y, -side.x) / std::sqrt(length_squared) : glm::dvec2(0.0)};
    }
    return nearest;
}

} // namespace lockstep
