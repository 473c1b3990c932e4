#pragma once
#include <cstdint>
#include <vector>

#include "crosscheck/judge/cause_findings.hpp"
#include "crosscheck/judge/item_verdict.hpp"
#include "crosscheck/judge/system.hpp"

namespace lockstep {

/// Whether two states of the pass's buffer are the same but for the order of what it appends.
bool same_but_for_order(const ItemPass& pass, const PassInput& in, const View& a, const View& b);

/// The verdicts on the items that differ, where the pass appends in any order: a tie where an item stands at another
/// place, divergent where there is one too many of it.
std::vector<ItemVerdict> judge_appended(const JudgedPass& pass);

/// Why what was appended is wrong, over the frames of a run: items that are lost, that are there twice, or that nobody
/// appends.
class AppendCause {
  public:
    void add(const JudgedPass& pass);
    [[nodiscard]] bool empty() const { return divergent_ == 0; }
    [[nodiscard]] CauseFindings findings() const;

  private:
    std::uint64_t divergent_ = 0, lost_ = 0, doubled_ = 0, foreign_ = 0;
};

} // namespace lockstep
