#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "crosscheck/judge/item_verdict.hpp"
#include "crosscheck/judge/legal.hpp"
#include "crosscheck/judge/system.hpp"

namespace lockstep {

/// Whether what diverges by what was measured of a driver is legal by a wider rule: a right shader that computes the
/// same in another way, rounding otherwise, is.
class ItemHint {
  public:
    /// The most items that are tried of a run of a pass: of the first runs that diverge, and of later ones. A mistake
    /// may show in few of the items that diverge.
    static constexpr std::size_t tried_at_first = 1024, first_runs = 16, tried_later = 64;

    /// The divergent items of a pass that was judged by Legal::measured.
    void add(const JudgedPass& pass, const std::vector<ItemVerdict>& verdicts);

    /// The narrowest rule by which every item that was tried is legal; none.
    [[nodiscard]] std::optional<Legal> rule() const;

  private:
    std::size_t runs_ = 0;
    bool by_glsl_ = true, by_any_order_ = true;
};

} // namespace lockstep
