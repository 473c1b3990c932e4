#pragma once
#include <vector>

#include "gpu/shader_source.hpp"

namespace lockstep {

/// Of each of the stage's files, by its number, whether the preprocessor takes it, with LOCKSTEP_TRACE or without, as
/// glslang says. All count as taken where a condition may ask for what only the driver knows (names of GL_, __LINE__),
/// or where glslang refuses the text. A file without lines of its own is taken.
std::vector<bool> taken_files(const ShaderSource& stage);

} // namespace lockstep
