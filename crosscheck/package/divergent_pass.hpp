#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "crosscheck/judge/check.hpp"
#include "crosscheck/judge/system_run.hpp"

namespace lockstep {

/// The pass in which a check is first DIVERGENT, run again to its frame when it is first looked at. Refers to what it
/// is made of.
class DivergentPass {
  public:
    DivergentPass(const System& system, SystemSide& side, const KnownOperations& known, const CheckReport& report);

    [[nodiscard]] std::optional<std::size_t> pass() const { return pass_; } ///< nothing: the check is not DIVERGENT
    [[nodiscard]] SystemSide& side() const { return side_; }
    /// Throws Error where the run cannot be made again.
    [[nodiscard]] JudgedPass judged();
    /// Items that diverge, and such that both sides changed alike; few of each, from all over.
    struct Items {
        std::vector<std::size_t> wrong, right;
    };
    [[nodiscard]] const Items& items();

  private:
    const System& system_;
    SystemSide& side_;
    KnownOperations known_;
    std::optional<std::size_t> pass_;
    int frame_ = 0;
    std::optional<SystemRun> run_;
    std::optional<Items> items_;
};

} // namespace lockstep
