#include "crosscheck/scene/surface.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>

#include "reference/model/error.hpp"

namespace lockstep {

Surface plane_surface(double size_x, double size_z) {
    const double x = 0.5 * size_x;
    const double z = 0.5 * size_z;
    return {{{-x, 0.0, -z}, {-x, 0.0, z}, {x, 0.0, z}, {x, 0.0, -z}}, {0, 1, 2, 0, 2, 3}};
}

Surface box_surface(glm::dvec3 size) {
    Surface box;
    for (int corner = 0; corner < 8; ++corner)
        box.positions.push_back((glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2) - 0.5) * size);
    box.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                   2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    return box;
}

Surface sphere_surface(double radius, int segments) {
    Surface sphere;
    for (int octant = 0; octant < 8; ++octant) {
        const glm::dvec3 sign(octant & 1 ? -1.0 : 1.0, octant & 2 ? -1.0 : 1.0, octant & 4 ? -1.0 : 1.0);
        const bool mirrored = sign.x * sign.y * sign.z < 0.0;
        const auto vertex = [&](int x, int y) {
            const glm::dvec3 p(x, y, segments - x - y);
            sphere.positions.push_back(sign * p * (radius / std::sqrt(glm::dot(p, p))));
        };
        const auto triangle = [&](glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
            const auto first = static_cast<std::uint32_t>(sphere.positions.size());
            for (const glm::ivec2 p : {a, mirrored ? c : b, mirrored ? b : c})
                vertex(p.x, p.y);
            sphere.indices.insert(sphere.indices.end(), {first, first + 1, first + 2});
        };
        for (int y = 0; y < segments; ++y)
            for (int x = 0; x + y < segments; ++x) {
                triangle({x, y}, {x + 1, y}, {x, y + 1});
                if (x + y + 1 < segments)
                    triangle({x + 1, y}, {x + 1, y + 1}, {x, y + 1});
            }
    }
    return sphere;
}

Surface torus_surface(double radius, double tube_radius, int segments) {
    Surface torus;
    const int sides = segments / 2;
    const auto angle = [](int step, int steps) { return 2.0 * std::numbers::pi * step / steps; };
    const auto index = [&](int ring, int side) {
        return static_cast<std::uint32_t>(ring % segments * sides + side % sides);
    };
    for (int ring = 0; ring < segments; ++ring)
        for (int side = 0; side < sides; ++side) {
            const double around = angle(ring, segments);
            const double across = angle(side, sides);
            const double r = radius + tube_radius * std::cos(across);
            torus.positions.emplace_back(r * std::cos(around), tube_radius * std::sin(across), -r * std::sin(around));
            const std::uint32_t a = index(ring, side);
            const std::uint32_t b = index(ring + 1, side);
            const std::uint32_t c = index(ring + 1, side + 1);
            const std::uint32_t d = index(ring, side + 1);
            torus.indices.insert(torus.indices.end(), {a, b, c, a, c, d});
        }
    return torus;
}

void place(const Surface& surface, const Placement& placement, Mesh& mesh) {
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high(std::numeric_limits<double>::lowest());
    for (const glm::dvec3& p : surface.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 centre = 0.5 * (low + high);
    if (placement.height > 0.0 && !(high.y > low.y))
        throw Error(fmt::format("flat: all its vertices are at y = {}, so it cannot be scaled to a height of {}", low.y,
                                placement.height));
    const double scale = placement.height > 0.0 ? placement.height / (high.y - low.y) : 1.0;
    const double c = std::cos(glm::radians(placement.rotate_y));
    const double s = std::sin(glm::radians(placement.rotate_y));

    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::dvec3& p : surface.positions) {
        const glm::dvec3 v = (p - centre) * scale;
        const glm::vec3 placed(glm::dvec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x) + placement.position);
        if (!std::isfinite(placed.x) || !std::isfinite(placed.y) || !std::isfinite(placed.z))
            throw Error("reaches beyond what a float holds; smaller, or nearer to the origin, is right");
        mesh.positions.push_back(placed);
    }
    for (const std::uint32_t i : surface.indices)
        mesh.indices.push_back(first + i);
}

} // namespace lockstep
