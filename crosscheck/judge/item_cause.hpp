#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "crosscheck/judge/cause_findings.hpp"
#include "crosscheck/judge/hypothesis.hpp"
#include "crosscheck/judge/item_likeness.hpp"
#include "crosscheck/judge/item_verdict.hpp"
#include "crosscheck/judge/named_cause.hpp"
#include "crosscheck/judge/system.hpp"

namespace lockstep {

/// Looks for the mistake in a pass's twin that explains what diverged: the exact ones with names, alone or together
/// (NamedCauses); the others with names, alone or with one more; and single ones of the host's (an old state, nothing
/// written) and every change that the sites of the divergent items allow. Of these, on the first frames with
/// divergence; what explains all there, and most_shown beside it, is held against the frames that follow.
class ItemCauseFinder {
  public:
    static constexpr int trial_frames = 4;
    static constexpr std::size_t trial_items = 512;       ///< a frame
    static constexpr std::size_t first_items = 128;       ///< of them; the rest is only for what explains all of these
    static constexpr std::size_t right_items_held = 4096; ///< a frame: hits are few among them
    static constexpr std::size_t later_items = 64;        ///< a frame that follows
    static constexpr std::size_t most_shown = 3;
    static constexpr std::uint64_t enough_evidence = 8; ///< divergent items, where many hypotheses would fit a few

    /// Of the pass of this name. `named` outlives this.
    ItemCauseFinder(const std::vector<NamedMistake>& named, std::string_view pass);

    void add(const JudgedPass& pass, const std::vector<ItemVerdict>& verdicts, const SeenElsewhere& elsewhere = {});

    /// One mistake with a name comes first, and beside it others with a name that explain as much; then any other
    /// single one; then several at once.
    [[nodiscard]] CauseFindings findings() const;

  private:
    /// The items of a frame that hypotheses are held against.
    struct Trial {
        const ItemLikeness& likeness;
        std::span<const std::size_t> divergent, right;
        std::span<const char> described; ///< by item: whether a mistake that only describes has its words
    };
    static bool hold(Hypothesis& hypothesis, const Trial& trial, std::int64_t at_least);
    static bool needs_both(const Hypothesis& pair, const Trial& trial);
    void try_all(const Trial& trial);
    void try_pairs(const Trial& trial, const std::vector<Hypothesis>& held, std::uint64_t divergent_before);
    [[nodiscard]] std::vector<Hypothesis> whole_ones() const;
    /// `held`: exact ones that explained all before.
    void try_single(const JudgedPass& pass, const std::vector<ItemVerdict>& verdicts, std::vector<Hypothesis> held);
    [[nodiscard]] CauseFindings of_single(bool beside_description) const;

    std::vector<const NamedMistake*> named_; ///< those that NamedCauses does not try
    std::vector<const NamedMistake*> exact_; ///< those that it does
    std::vector<Hypothesis> describing_;     ///< those that say what is seen
    NamedCauses joint_;
    int frames_ = 0;
    std::uint64_t divergent_ = 0;
    std::vector<Hypothesis> tried_;
};

} // namespace lockstep
