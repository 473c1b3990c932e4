#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "crosscheck/judge/cause_findings.hpp"
#include "crosscheck/judge/item_verdict.hpp"
#include "crosscheck/judge/system.hpp"

namespace lockstep {

/// Looks for the mistake in a pass's twin that explains what diverged: first those with names, then the host's (an old
/// state, nothing written), then every change that the sites of the divergent items allow. On the first frames with
/// divergence; what explains all there, and most_shown beside it, is held against the frames that follow.
class ItemCauseFinder {
  public:
    static constexpr int trial_frames = 4;
    static constexpr std::size_t trial_items = 512; ///< a frame; of those that agree as many
    static constexpr std::size_t first_items = 128; ///< of them; the rest is only for what explains all of these
    static constexpr std::size_t later_items = 64;  ///< a frame that follows
    static constexpr std::size_t most_shown = 3;

    explicit ItemCauseFinder(const std::vector<NamedMistake>& named) : named_(named) {}

    void add(const JudgedPass& pass, const std::vector<ItemVerdict>& verdicts);

    [[nodiscard]] CauseFindings findings() const;

  private:
    /// What may have gone wrong.
    struct Hypothesis {
        enum class Host : std::uint8_t { none, unwritten, earlier_state };
        Host host = Host::none;
        std::optional<Mistake> mistake = {};
        const NamedMistake* named = nullptr;
        std::string text = {}; ///< of one without a name
        std::uint64_t explained = 0, contradicted = 0;
        std::uint64_t telling = 0; ///< of those explained, which are off by more than rounding

        /// Names first, then the host's, then a wrong input, then all else.
        [[nodiscard]] int rank() const {
            if (named != nullptr || host != Host::none)
                return named != nullptr ? 0 : 1;
            return text.starts_with("u_") ? 2 : 3;
        }
        [[nodiscard]] std::int64_t balance() const {
            return static_cast<std::int64_t>(explained) - static_cast<std::int64_t>(contradicted);
        }
    };
    /// The items of a frame that hypotheses are held against.
    struct Trial {
        const JudgedPass& pass;
        std::vector<Component> parts;
        std::span<const std::size_t> divergent, agreeing;
        [[nodiscard]] bool is_off_by_rounding(std::size_t item) const;
    };
    [[nodiscard]] std::vector<Hypothesis> hypotheses(const JudgedPass& pass,
                                                     const std::vector<std::size_t>& items) const;
    static bool explains(const Hypothesis& hypothesis, const Trial& trial, std::size_t item);
    static bool hold(Hypothesis& hypothesis, const Trial& trial, std::int64_t at_least);
    void try_all(const Trial& trial);

    const std::vector<NamedMistake>& named_;
    int frames_ = 0;
    std::uint64_t divergent_ = 0;
    std::vector<Hypothesis> tried_;
};

} // namespace lockstep
