#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string_view>
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
    /// given. Returns whether a mistake got further than before: its place was reached, it changed something, it
    /// showed.
    bool add(const JudgedPass& pass, const std::vector<std::size_t>& telling, std::size_t most = 0);

    /// A pass that no frame of the run came to, whose mistakes could not show.
    void note_idle(std::string_view pass);

    /// Whether all mistakes of the passes that were seen have shown: more frames tell nothing more of these.
    [[nodiscard]] bool has_seen_all() const;

    /// Of the mistakes of passes that were seen or are idle, to be concluded.
    [[nodiscard]] PowerSummary summary() const;

  private:
    /// What became of a mistake.
    struct Tried {
        bool passed = false; ///< its pass was run
        bool is_idle = false;
        bool reached = false, changes = false;
        int first_frame = -1;
    };

    const std::vector<NamedMistake>& named_;
    std::vector<Tried> tried_;
};

/// Which runs of a pass are tried: each while they bring something new, else ever fewer, to one in eight.
class PowerPace {
  public:
    /// Whether the next run is to be tried.
    [[nodiscard]] bool is_due() { return ++run_ >= next_; }

    void tried(bool brought_something) {
        constexpr std::size_t tries_at_a_gap = 4, widest = 8;
        if (brought_something)
            gap_ = 1, in_vain_ = 0;
        else if (++in_vain_ % tries_at_a_gap == 0)
            gap_ = std::min(2 * gap_, widest);
        next_ = run_ + gap_;
    }

  private:
    std::size_t run_ = 0, next_ = 0, gap_ = 1, in_vain_ = 0;
};

/// How an item's words, made with a mistake, stand to what the item may legally become.
enum class MistakenItem : std::uint8_t { same, legal, divergent };
MistakenItem judge_mistaken(const JudgedPass& pass, std::size_t item, std::span<const std::uint32_t> words);

/// At most `most` items, three in four of them of `telling`, the others from everywhere, others in every frame.
std::vector<std::size_t> items_to_try(const JudgedPass& pass, const std::vector<std::size_t>& telling,
                                      std::size_t most);

} // namespace lockstep
