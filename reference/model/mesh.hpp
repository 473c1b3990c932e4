#pragma once
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace lockstep {

/// Triangles in world space, three indices each, in drawing order.
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    [[nodiscard]] std::size_t triangle_count() const { return indices.size() / 3; }
};

} // namespace lockstep
