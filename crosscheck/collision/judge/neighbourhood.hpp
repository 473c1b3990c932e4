#pragma once
#include <optional>

#include <glm/vec2.hpp>

#include "crosscheck/collision/judge/step_table.hpp"

namespace lockstep {

/// The texels a particle's step looks at, on both sides; (-1, -1) where there is none.
struct SearchedTexels {
    glm::ivec2 low, high;      ///< corners of what both sides look at, texels
    glm::ivec2 base, gpu_base; ///< base texels
    glm::ivec2 pick, gpu_pick; ///< the nearest neighbours
};

/// `reach`: texel_collide_range. Nothing where neither side has a base texel; round one side's alone where they are
/// far apart.
std::optional<SearchedTexels> neighbourhood(const StepTable& table, int reach);

} // namespace lockstep
