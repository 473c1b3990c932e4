#pragma once
#include <string>

#include "gpu/shader_source.hpp"

namespace lockstep {

/// The first error of a shader compiler's log as one line, `FILE:LINE: message`, in terms of the source's files.
/// Reads Mesa's `0:12(3): error: ...`, NVIDIA's `0(12) : error C1234: ...` and the `ERROR: 0:12: ...` of others; of a
/// log in no such form, the first line that speaks of an error, after the stage's file name.
std::string first_compile_error(const std::string& log, const ShaderSource& source);

/// The first line of a linker's log that speaks of an error; else its first line.
std::string first_link_error(const std::string& log);

} // namespace lockstep
