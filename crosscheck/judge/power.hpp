#pragma once
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "crosscheck/judge/power_summary.hpp"
#include "crosscheck/judge/system.hpp"

namespace lockstep {

/// Makes each named mistake in the twin of a pass, on items of the frames as they were. A mistake would have shown
/// where what it makes of an item lies in no legal outcome. Each frame a few items are tried, first of those that
/// decided otherwise than most, and of a mistake that has not shown yet: the fewer of these, the more items.
class PowerMeter {
  public:
    static constexpr std::size_t tried_a_frame = 48; ///< items, while no mistake has shown
    static constexpr std::size_t tried_at_most = 512;

    explicit PowerMeter(const std::vector<NamedMistake>& named) : named_(named), tried_(named.size()) {}

    /// A frame's pass, as the reference made it. `telling`: items that are worth a try more than others. `most`: so
    /// many items are tried; 0: as the class says. What parts of a run show comes to what the whole shows where it is
    /// given.
    void add(const JudgedPass& pass, const std::vector<std::size_t>& telling, std::size_t most = 0);

    /// Whether all mistakes of the passes that were seen have shown: more frames tell nothing more of these.
    [[nodiscard]] bool has_seen_all() const;

    /// Of the mistakes of passes that were seen, to be concluded.
    [[nodiscard]] PowerSummary summary() const;

  private:
    /// What became of a mistake.
    struct Tried {
        bool passed = false; ///< its pass was run
        bool reached = false, changes = false;
        int first_frame = -1;
    };

    const std::vector<NamedMistake>& named_;
    std::vector<Tried> tried_;
};

/// How an item's words, made with a mistake, stand to what the item may legally become.
enum class MistakenItem : std::uint8_t { same, legal, divergent };
MistakenItem judge_mistaken(const JudgedPass& pass, std::size_t item, std::span<const std::uint32_t> words);

/// At most `most` items, three in four of them of `telling`, the others from everywhere, others in every frame.
std::vector<std::size_t> items_to_try(const JudgedPass& pass, const std::vector<std::size_t>& telling,
                                      std::size_t most);

} // namespace lockstep
