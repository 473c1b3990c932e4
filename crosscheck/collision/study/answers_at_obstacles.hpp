#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "reference/collision/search_study.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/mesh.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// Distance from `point` to the triangle a, b, c, which may have no area.
double distance_to_triangle(glm::dvec3 point, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c);

/// Indices of the positions nearer than `range` to a triangle of `mesh`, ascending; none that is not finite.
std::vector<std::size_t> touching(std::span<const glm::vec3> positions, const Mesh& mesh, float range);

/// By particle of a scene's start, every one searching: whether the search finds anything, particle or obstacle.
using Hits = std::vector<bool>;
Hits hits_of_cdt(const SearchStudy& study); ///< of study_start
Hits hits_of_octree(const Scene& scene);
Hits hits_of_depth(Scene scene, const Profile& profile); ///< the switches are such that search = depth goes with them

/// The share of `particles` that hit; NaN of none.
double share_of_hits(const Hits& hits, std::span<const std::size_t> particles);

} // namespace lockstep
