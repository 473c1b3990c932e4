#pragma once
#include <span>

#include "crosscheck/judge/cause_findings.hpp"
#include "crosscheck/judge/item_verdict.hpp"
#include "reference/model/state_view.hpp"

namespace lockstep {

/// What a pass that was run again over a pattern (gpu/canary.hpp) left of it in what diverges.
struct Unwritten {
    bool none = true; ///< it wrote all of these items
    CauseFindings
        cause; ///< of items of which it wrote nothing, or not the same fields; empty: they are of several kinds
};

/// `again`: the pass's buffer or image after that run.
Unwritten unwritten_in(const View& again, std::span<const ItemVerdict> verdicts);

} // namespace lockstep
