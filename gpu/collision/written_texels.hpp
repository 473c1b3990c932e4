#pragma once
#include <filesystem>

#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// What the fragment stages of a scene write into the CDT before a driver converts it to the CDT's format: frame 0,
/// drawn into an image of floats, obstacles or particles alone. Every position is moved a little, so that none is a
/// code of the format already. `scene` has search = cdt and no remedies; particles have step = transform_feedback.
/// Throws Error for what is wrong with the shaders.
CollisionImage written_obstacles(const Scene& scene, const std::filesystem::path& shaders);
CollisionImage written_particles(const Scene& scene, const std::filesystem::path& shaders);

} // namespace lockstep
