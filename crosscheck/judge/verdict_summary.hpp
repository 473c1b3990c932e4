#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "crosscheck/judge/cause_findings.hpp"
#include "crosscheck/judge/compare.hpp"
#include "crosscheck/judge/item_verdict.hpp"
#include "crosscheck/judge/legal_widths.hpp"
#include "crosscheck/judge/place.hpp"

namespace lockstep {

/// Ties of one kind.
struct TieCount {
    std::uint64_t count = 0;
    double smallest = 0.0; ///< margins, in the kind's unit
    double largest = 0.0;
    Place closest; ///< the one of the smallest margin
};

/// The first step of a pass at which no legal run reaches what the GPU has, as far as what was captured tells.
/// A texel that was chosen for what it offered: a distance, a depth.
struct ChosenTexel {
    int x = 0, y = 0;
    float offer = 0.0F;
};

/// What was chosen among texels, and what the GPU must have chosen; nothing where none was.
struct ChoiceOfTexels {
    std::optional<ChosenTexel> right, taken;
};

struct WrongStep {
    std::string step;      ///< "search", "nearest", "speed", ...
    std::string operation; ///< what is right there, with its operands: "texel (70, 294) at 0.25 is right"
    std::string gpu;       ///< what the GPU must have done instead, where that is known: "took ..."; else empty
    std::string where;     ///< the line of the twin, "collision_twin.hpp:128"; may be empty
    std::optional<ChoiceOfTexels> choice; ///< that both texts are about, if they are about one
    std::string margin;                   ///< how far the GPU is from what is legal
    Difference difference;                ///< the field that shows it
};

struct FirstDivergence {
    Place place;
    ItemVerdict verdict;
    WrongStep wrong;
    std::size_t pass = 0; ///< of a system's, in their order
};

/// The verdicts of a run.
struct VerdictSummary {
    using Counts = std::array<std::uint64_t, class_names.size()>; ///< by DifferenceClass
    std::vector<Counts> classes;                                  ///< of each buffer and image, in the schema's order
    std::map<std::size_t, std::uint64_t> set_sizes;               ///< how many items had that many legal outcomes
    std::vector<LegalWidths> widths;                              ///< likewise, of items that are legal
    std::map<TieKind, TieCount> ties;
    std::map<Undefined, std::uint64_t> undefined;
    Leans leans;
    bool judges_leans = false; ///< see can_judge_leans
    std::uint64_t ties_beyond_rounding = 0;
    std::optional<FirstDivergence> first_beyond_rounding;
    std::optional<FirstDivergence> first; ///< the first divergent item, else the first undefined one
    std::vector<int> divergent_frames;    ///< those with a divergent item
    std::vector<CauseFindings> causes;    ///< likewise

    VerdictSummary() = default;
    explicit VerdictSummary(const Schema& schema);

    /// The name of the shift that ties alone convict; empty: none.
    [[nodiscard]] std::string convicted_shift() const;
    /// Where they convict one, ties beyond rounding are divergent.
    void convict_shift();

    /// The verdicts on a frame's items of one buffer or image.
    void add(int frame, std::uint8_t resource, std::span<const ItemVerdict> verdicts);

    /// Takes up the verdicts on the frames that follow these; no shift is convicted yet. Of causes those of the one
    /// side that has divergent frames; where both have, none.
    void join(const VerdictSummary& next);

    [[nodiscard]] std::uint64_t total(DifferenceClass kind) const;
    [[nodiscard]] std::size_t median_set_size() const;
};

/// Whether a shift explains the verdict better than rounding does, though it is a tie by itself.
bool is_tie_beyond_rounding(const ItemVerdict& verdict);

} // namespace lockstep
