#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/model/ulp.hpp"

namespace lockstep {

/// The same bits, or both NaN, in every component.
inline bool same_bits(glm::vec3 a, glm::vec3 b) {
    return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}
inline bool same_bits(glm::vec4 a, glm::vec4 b) { return same_bits(glm::vec3(a), glm::vec3(b)) && same_bits(a.w, b.w); }

} // namespace lockstep
