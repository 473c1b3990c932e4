#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "crosscheck/judge/power_summary.hpp"
#include "crosscheck/judge/system.hpp"

namespace lockstep {

/// Makes each named mistake in the twin of a pass, on items of the frames as they were. A mistake would have shown
/// where what it makes of an item lies in no legal outcome. Each frame a few items are tried, first of those that
/// decided otherwise than most, and of a mistake that has shown none.
class PowerMeter {
  public:
    static constexpr std::size_t tried_a_frame = 48;

    explicit PowerMeter(const std::vector<NamedMistake>& named) : named_(named), seen_(named.size()) {}

    /// A frame's pass, as the reference made it. `telling`: items that are worth a try more than others.
    void add(const JudgedPass& pass, const std::vector<std::size_t>& telling);

    /// Whether all mistakes of the passes that were seen have shown: more frames tell nothing more of these.
    [[nodiscard]] bool has_seen_all() const;

    /// Of the mistakes of passes that were seen.
    [[nodiscard]] PowerSummary summary() const;

  private:
    const std::vector<NamedMistake>& named_;
    std::vector<bool> seen_;
    std::vector<std::string> passes_;
};

} // namespace lockstep
