#pragma once
#include <string>
#include <vector>

#include "crosscheck/report/report.hpp"
#include "gpu/shader_warnings.hpp"

namespace lockstep {

/// Notes of a run: a line for each of the first warnings of the driver's compilers, and how many more there are.
std::vector<std::string> warning_notes(const std::vector<ShaderWarning>& warnings);

/// A verdict that holds says so in its words where a shader may read a variable that was never set: GLSL leaves its
/// value open, and this driver's happens to agree.
void note_unset_variables(CheckReport& report, const std::vector<ShaderWarning>& warnings);

} // namespace lockstep
