#pragma once
#include <string>

#include "crosscheck/files/run_inputs.hpp"
#include "crosscheck/judge/check.hpp"
#include "crosscheck/report/report.hpp"

namespace lockstep {

/// A run as JUnit has it: one test case, with renderer, profile, shaders, inputs and verdict as properties; of one that
/// does not pass the report as its failure. Without a time, so that the same run gives the same file.
std::string junit_text(const CheckReport& report, const RunDescription& run, bool passes,
                       const InputDigests& inputs = {});

} // namespace lockstep
