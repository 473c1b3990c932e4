#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crosscheck/judge/registered_system.hpp"
#include "crosscheck/package/text_passes.hpp"
#include "crosscheck/report/report.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// Where a text does what GLSL does not allow, or gives no value, and by which rule.
struct ShortFinding {
    std::string place; ///< FILE:LINE
    std::string rule;
    bool is_race = false;
    std::size_t pass = 0; ///< whose text it is
};

/// Notes on texts, and what the runs of them covered.
struct TextNotes {
    std::vector<std::string> lines;
    std::vector<ShortFinding> findings; ///< that lines are of
    std::vector<TextCoverage> coverage;
};

/// To what a report says of its run.
void add_notes(RunDescription& run, TextNotes notes);

/// Which frames count for the coverage: those that are watched, or all as far as that does not take long.
enum class CoveredRuns : std::uint8_t { watched, all };
[[nodiscard]] inline CoveredRuns covered_runs(const PassRules& rules) {
    return rules.cover_at_least > 0.0 ? CoveredRuns::all : CoveredRuns::watched;
}

/// What watched runs of the texts of a system's shaders find (docs/shader_text.md), on a sample of the groups of the
/// first frames, more of them where a state is small, from the reference's states: a line each. A text that is not
/// interpreted is one of them.
/// `own`: those that were read already; `shaders`: where the others are, or nothing: they are not looked into, and
/// coverage is that of files in it.
TextNotes shader_findings(const ShadedSystem& of, const OwnTexts& own,
                          const std::optional<std::filesystem::path>& shaders, const Profile& profile, int frames,
                          CoveredRuns covered);

/// The same of the texts that are references of passes, in a check of so many frames.
std::vector<std::string> reference_notes(const ShadedSystem& of, const OwnTexts& references, const Profile& profile,
                                         int frames);

/// Shaders of a run that are the user's own.
struct OwnShaders {
    OwnTexts texts;
    ShaderUse use;
    std::filesystem::path folder;    ///< where they are
    std::filesystem::path reference; ///< where the reference's texts are; empty: the shipped ones
};

/// What the texts of a run's own shaders say: shader_findings, and where it is DIVERGENT lines_without_counterpart. A
/// finding limits a green verdict (CheckReport::untried).
TextNotes text_notes(const ShadedSystem& of, const OwnShaders& own, DivergentPass& divergence, CheckReport& report,
                     CoveredRuns covered);

} // namespace lockstep
