#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "crosscheck/judge/step_row.hpp"
#include "crosscheck/judge/system_run.hpp"
#include "crosscheck/report/report.hpp"
#include "crosscheck/report/value_text.hpp"
#include "gpu/side_description.hpp"

namespace lockstep {

/// One item's step in a pass, value by value down its twin: the reference strict, with the driver's profile, and what
/// the GPU told; each judged by the GPU's own values above it. Then the verdict and every legal outcome.
std::string explain_item(SystemRun& run, std::size_t item, NumberFormat format = NumberFormat::decimal);
std::string explain_item(const JudgedPass& pass, std::size_t item, std::span<const ToldValue> told,
                         NumberFormat format);

/// The verdict on it, the first of its rows that is wrong, and every legal outcome.
std::string item_verdict_text(const JudgedPass& pass, std::size_t item, const std::vector<StepRow>& rows);

/// What an outcome's fields may be, and the ties on the way to it.
std::string outcome_text(const ItemOutcome& outcome, const Resource& about);

/// The heading of a report on a system's run. `repeat`: the command that repeats it.
RunDescription describe_run(const System& system, const SideDescription& side, const CheckOptions& options,
                            const std::string& repeat);

} // namespace lockstep
