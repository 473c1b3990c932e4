#pragma once
#include <span>
#include <string>
#include <vector>

#include "gpu/shader_source.hpp"
#include "gpu/shader_warnings.hpp"

namespace lockstep {

/// The first error of a shader compiler's log as one line, `FILE:LINE: message`, in terms of the source's files.
/// Reads Mesa's `0:12(3): error: ...`, NVIDIA's `0(12) : error C1234: ...` and the `ERROR: 0:12: ...` of others; of a
/// log in no such form, the first line that speaks of an error, after the stage's file name.
std::string first_compile_error(const std::string& log, const ShaderSource& source);

/// The warnings of a compiler's log, in the same terms; what a driver says besides is none.
std::vector<ShaderWarning> compile_warnings(const std::string& log, const ShaderSource& source);

/// Those of a linker's log. NVIDIA's has a paragraph "Vertex info" for each stage, with the lines of its text.
std::vector<ShaderWarning> link_warnings(const std::string& log, std::span<const ShaderSource> stages);

/// The first line of a linker's log that speaks of an error; else its first line.
std::string first_link_error(const std::string& log);

} // namespace lockstep
