#pragma once
#include <cstddef>
#include <string_view>

#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// A particle, a texel or a pixel of the rendered frame of a scene by what a user wrote: "17"; "31,282", column and row
/// from the bottom left. Throw Error with what the scene has.
std::size_t particle_named(std::string_view text, const Scene& scene);
std::size_t texel_named(std::string_view text, const Scene& scene);
std::size_t pixel_named(std::string_view text, const Scene& scene);

} // namespace lockstep
