#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "crosscheck/judge/cause_findings.hpp"

namespace lockstep {

/// A mistake that may be made together with others.
struct JointMistake {
    std::string name, meaning;
    /// Says what is seen, and so cannot be wrong where it explains everything; other causes of it are guesses.
    bool describes = false;
};

/// Mistakes being tried together, and what they explain.
struct TriedCause {
    std::vector<std::size_t> mistakes;             ///< by their places among all, ascending
    std::uint64_t explained = 0, contradicted = 0; ///< as Cause has them
    std::uint64_t contradicted_before = 0;         ///< in frames before the one at hand
};

/// A frame's evidence, as the search asks of it.
struct JointEvidence {
    /// Adds to causes what they explain of these divergent items, and what agrees and contradicts them.
    std::function<void(std::vector<TriedCause>&, const std::vector<std::size_t>& divergent)> count;
    std::function<std::vector<TriedCause>()> pairs; ///< those worth trying of a first frame, counted
    std::function<std::vector<TriedCause>(std::vector<TriedCause>)> best; ///< the best few of many, counted
};

/// Looks for the mistakes of a list that explain divergence: each alone, then in pairs, then three together, on the
/// first frames with divergence; what explains all there is held against the frames that follow. Where a frame diverges
/// in a new way, what explained all before it is tried with one or two more.
class JointCauses {
  public:
    static constexpr int trial_frames = 4;
    static constexpr std::size_t trial_items = 4096; ///< a frame

    explicit JointCauses(std::vector<JointMistake> mistakes);

    /// `divergent`: the frame's items. `singles`: the mistakes that are worth trying on it.
    void hold_against(const std::vector<std::size_t>& divergent, const std::vector<std::size_t>& singles,
                      const JointEvidence& evidence);
    /// Items that agree and that the mistake by itself contradicts, whatever it explains.
    void contradict_alone(std::size_t mistake, std::uint64_t items) { alone_[mistake] += items; }

    /// Where others explain what diverges with it, a mistake of that name is not told.
    void leave_out(std::string name) { left_out_ = std::move(name); }

    [[nodiscard]] CauseFindings findings() const;

    [[nodiscard]] const std::vector<TriedCause>& tried() const { return tried_; }
    [[nodiscard]] int frames() const { return frames_; } ///< with divergence
    /// Each two of those that are tried alone.
    [[nodiscard]] std::vector<TriedCause> pairs() const;
    /// The best few of some.
    [[nodiscard]] std::vector<TriedCause> best_of(std::vector<TriedCause> causes, std::size_t count) const;

  private:
    [[nodiscard]] bool describes(const TriedCause& cause) const;
    [[nodiscard]] bool before(const TriedCause& a, const TriedCause& b) const;
    [[nodiscard]] std::vector<TriedCause> whole_ones() const;
    [[nodiscard]] bool is_base(const std::vector<TriedCause>& held, std::uint64_t divergent_before) const;
    [[nodiscard]] std::vector<TriedCause> with_one_more(const std::vector<TriedCause>& causes,
                                                        const std::vector<std::size_t>& singles) const;
    void drop_hopeless();
    [[nodiscard]] Cause as_cause(const TriedCause& tried) const;

    std::vector<JointMistake> mistakes_;
    int frames_ = 0;
    int extensions_ = 0; ///< frames in which more at once were tried
    std::uint64_t divergent_ = 0;
    std::vector<TriedCause> tried_;
    std::vector<std::uint64_t> alone_;
    std::string left_out_;
};

} // namespace lockstep
