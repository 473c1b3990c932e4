#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "crosscheck/judge/system_check.hpp"

namespace lockstep {

/// What a second run of one frame of a pass gave, from the same state. Of a pass whose sums atomics or blending make in
/// an order that nothing fixes, it may be another thing and each be right.
struct TwoRuns {
    std::string pass;
    int frame = 0;
    std::string item; ///< as the schema names one
    std::uint64_t differing = 0, items = 0;
};

/// Has `watch` put down the two runs of each unordered pass. `system` and `seen` outlive the check.
void watch_two_runs(CheckWatch& watch, const System& system, std::vector<TwoRuns>& seen);

/// "run to run, light_volume_scatter: frame 0 12 of 4,096 words, ...": a line a pass.
std::vector<std::string> run_to_run_notes(const std::vector<TwoRuns>& seen);

void to_json(nlohmann::json& json, const TwoRuns& runs);

} // namespace lockstep
