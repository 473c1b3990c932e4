#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "crosscheck/judge/cause.hpp"
#include "crosscheck/judge/diagnosis.hpp"
#include "crosscheck/judge/verdict.hpp"

namespace lockstep {

/// Where a verdict belongs.
struct Place {
    int frame = 0;
    bool texel = false; ///< else a particle
    std::size_t index = 0;
};

/// Ties of one kind.
struct TieCount {
    std::uint64_t count = 0;
    double smallest = 0.0; ///< margins, in the kind's unit
    double largest = 0.0;
    Place closest; ///< the one of the smallest margin
};

struct FirstDivergence {
    Place place;
    ItemVerdict verdict;
    WrongStep wrong;
};

/// The verdicts of a run.
struct VerdictSummary {
    std::array<std::uint64_t, class_names.size()> particles{}; ///< by DifferenceClass
    std::array<std::uint64_t, class_names.size()> texels{};
    std::map<std::size_t, std::uint64_t> set_sizes; ///< how many items had that many legal outcomes
    std::map<TieKind, TieCount> ties;
    std::map<Undefined, std::uint64_t> undefined;
    Leans leans;
    bool judges_leans = false; ///< see can_judge_leans
    std::uint64_t ties_beyond_rounding = 0;
    std::optional<FirstDivergence> first_beyond_rounding;
    std::optional<FirstDivergence> first; ///< the first divergent item, else the first undefined one
    CauseFindings particle_cause, texel_cause;

    void add(int frame, const FrameVerdicts& verdicts);
    /// The name of the shift that ties alone convict; empty: none.
    [[nodiscard]] std::string convicted_shift() const;
    /// Where they convict one, ties beyond rounding are divergent.
    void convict_shift();

    [[nodiscard]] std::uint64_t total(DifferenceClass kind) const {
        const auto k = static_cast<std::size_t>(kind);
        return particles[k] + texels[k];
    }
    [[nodiscard]] std::size_t median_set_size() const;
};

/// Whether a shift of what is drawn is no tie, though each texel by itself may be one: the driver's grid was measured,
/// and nothing says that its window coordinates are less accurate than GLSL's.
bool can_judge_leans(const KnownOperations& known, const Profile& profile);

/// The first item of a class in a frame: a particle if there is one, whose texel may only follow it.
std::optional<FirstDivergence> first_of(DifferenceClass kind, int frame, const JudgedFrame& judged,
                                        const FrameVerdicts& verdicts);

/// The first texel that by itself is a tie, and that a shift explains better than rounding.
std::optional<FirstDivergence> first_tie_beyond_rounding(int frame, const JudgedFrame& judged,
                                                         const FrameVerdicts& verdicts);

} // namespace lockstep
