#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "crosscheck/judge/cause_findings.hpp"
#include "crosscheck/judge/item_verdict.hpp"
#include "crosscheck/judge/joint_cause.hpp"
#include "crosscheck/judge/system.hpp"

namespace lockstep {

/// How many items beside the pass's own, which agree, contradict mistakes that explain all there: a matrix that more
/// than this pass reads would show elsewhere, too.
using SeenElsewhere = std::function<std::uint64_t(std::span<const NamedMistake* const>)>;

/// Looks for the named mistakes of a pass, alone or up to three together, that explain its divergent items. On a driver
/// whose division or roots were measured to err, the values need only come near the GPU's.
class NamedCauses {
  public:
    /// `named`: of one pass; outlive this.
    explicit NamedCauses(std::vector<const NamedMistake*> named);

    void add(const JudgedPass& pass, const std::vector<ItemVerdict>& verdicts, const SeenElsewhere& elsewhere);

    [[nodiscard]] CauseFindings findings() const { return causes_.findings(); }

  private:
    std::vector<const NamedMistake*> named_;
    JointCauses causes_;
};

} // namespace lockstep
