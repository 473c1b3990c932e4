#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/model/mesh.hpp"

namespace lockstep {

/// The corners of obstacles in clip space, one each of its positions.
template <class A> std::vector<glm::vec4> projected_corners(A fp, const Mesh& obstacles, const glm::mat4& proj_view) {
    std::vector<glm::vec4> clip(obstacles.positions.size());
    std::transform(obstacles.positions.begin(), obstacles.positions.end(), clip.begin(),
                   [&](glm::vec3 position) { return fp.transform(proj_view, position); });
    return clip;
}

/// What a triangle's corners store: their positions, as the arithmetic reads them.
template <class A> std::array<glm::vec3, 3> stored_corners(A fp, const Mesh& obstacles, std::size_t triangle) {
    const std::uint32_t* index = &obstacles.indices[triangle * 3];
    const auto corner = [&](std::size_t i) { return fp.flush(obstacles.positions[index[i]]); };
    return {corner(0), corner(1), corner(2)};
}

} // namespace lockstep
