#pragma once
#include <cstddef>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/judge/legal.hpp"
#include "gpu/collision/simulation.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep::test {

/// `count` particles in a cube that a plane and a ball stand in, falling and milling about, dense enough to collide
/// from frame 1 on; obstacles and images small enough for many runs.
Scene crowded_scene(std::size_t count = 1200, int width = 97, int height = 64);

/// Both sides of a scene over some frames, in the current context; llvmpipe_profile's arithmetic.
CheckReport check_twins(const Scene& scene, int frames = 4, const std::filesystem::path& shaders = {},
                        CheckMode mode = CheckMode::resync, Legal legal = Legal::measured);

} // namespace lockstep::test
