#pragma once
#include <vector>

#include "gpu/shader_source.hpp"

namespace lockstep {

/// Of each of the stage's files, by its number, whether the preprocessor takes any of its lines, as far as conditions
/// are of integers and of macros without parameters. Of a condition that asks for more, by GL's own macros or by
/// LOCKSTEP_TRACE, both branches count as taken. A file without lines of its own is taken.
std::vector<bool> taken_files(const ShaderSource& stage);

} // namespace lockstep
