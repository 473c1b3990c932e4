#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "crosscheck/judge/check.hpp"
#include "crosscheck/judge/item_verdict.hpp"
#include "crosscheck/judge/system.hpp"

namespace lockstep {

class SystemSide;

/// One pass of one frame as a check leaves it; views end with the call that hands it out.
struct CheckedPass {
    std::size_t pass = 0;
    const JudgedPass& judged;
    const Comparison& comparison;
    std::span<const ItemVerdict> verdicts; ///< on what differs; none in free mode
};

/// Looks on while a check runs. Each may be empty.
struct CheckWatch {
    std::function<void(const CheckedPass&)> on_pass;
    /// After each frame: what the reference made of it, and the GPU.
    std::function<void(int frame, const SystemState& reference, const SystemState& gpu)> on_frame;
    /// Of a pass that atomics or blending leave unordered (ItemPass::unordered): two runs of it from one state.
    std::function<void(std::size_t pass, int frame, const Comparison& two_runs)> on_two_runs = {};
};

/// Runs a system's passes on both sides from its start and compares every bit of what each pass wrote. Each pass is
/// judged alone: it starts from what the GPU's passes before it left (CheckMode::resync), or both sides run on by
/// themselves (free). Throws Error when the run would prove nothing: a GL error, output that was not written, nothing
/// compared.
CheckReport check(const System& system, SystemSide& gpu, const CheckOptions& options, const CheckWatch& watch = {});

} // namespace lockstep
