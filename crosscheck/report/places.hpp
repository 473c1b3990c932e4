#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include "crosscheck/judge/verdict_summary.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// A particle or a texel of a scene by what a user wrote: "17"; "31,282", column and row from the bottom left. Throw
/// Error with what the scene has.
std::size_t particle_named(std::string_view text, const Scene& scene);
std::size_t texel_named(std::string_view text, const Scene& scene);

/// "--frame 3 --texel 4,5", as `lockstep explain` takes it. `width`: of an image, texels.
std::string place_arguments(const Place& place, const Schema& schema, int width);

} // namespace lockstep
