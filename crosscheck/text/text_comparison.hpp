#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "crosscheck/text/examination.hpp"
#include "crosscheck/text/named_finding.hpp"
#include "crosscheck/text/stage_text.hpp"
#include "crosscheck/text/watched_run.hpp"
#include "crosscheck/text/witness.hpp"

namespace lockstep {

/// What a stage's text makes beside what a reference's text makes of the same inputs.
struct TextComparison {
    std::string reference;
    std::vector<NamedFinding> findings; ///< in the reference
    std::string not_compared;           ///< why; empty: it was
    std::size_t words = 0;              ///< of storage blocks, images and outputs
    std::size_t written = 0;            ///< of these, by either text
    std::size_t differing = 0;          ///< from the reference's bits
    std::size_t legal = 0;              ///< of these, in the sets that the reference's text leaves open
    std::size_t by_bits = 0;            ///< of the rest, made by what is not followed by sets
    std::string by_bits_for;            ///< why, of the first
    std::vector<std::string> first;     ///< the first few of the rest: where, what is expected, what there is
    std::vector<WitnessLine> lines;     ///< of the text that have no counterpart in the reference
    std::string weak;                   ///< what these inputs cannot show; empty: nothing is known of it

    [[nodiscard]] bool is_right() const { return not_compared.empty() && differing == legal && findings.empty(); }
    [[nodiscard]] std::string verdict() const; ///< AGREE, LEGAL or DIVERGENT
    /// `found`: findings in the text that is compared, which the verdict then names.
    [[nodiscard]] std::string text(std::size_t found) const;
    [[nodiscard]] nlohmann::json json() const;
};

/// Of texts that a host runs, each in a run of its own.
struct HostedTexts {
    /// As witness_lines has it.
    std::function<bool(std::string_view where)> is_own;
    const MadeUpWorld* reference = nullptr; ///< what the reference's was bound to; null: it did not run
};

/// Runs the reference from where the text's run began, and compares what both leave. `world` and `stage`: what the text
/// was run from. Throws Error where the interfaces differ, and where neither text writes anything. `hosted`: what both
/// have in common is compared (matched_names).
TextComparison compare_texts(const Examination& of, const StageText& text, const StageText& reference,
                             const MadeUpWorld& world, const text::StageRun& stage, const WatchedRun& run,
                             const HostedTexts* hosted = nullptr);

} // namespace lockstep
