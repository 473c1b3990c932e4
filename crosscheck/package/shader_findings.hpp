#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crosscheck/judge/registered_system.hpp"
#include "crosscheck/package/text_passes.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// What watched runs of the texts of a system's shaders find (docs/shader_text.md), on a sample of the groups of the
/// first frames, more of them where a state is small, from the reference's states: a line each. A text that is not
/// interpreted is one of them.
/// `own`: those that were read already; `shaders`: where the others are, or nothing: they are not looked into.
std::vector<std::string> shader_findings(const ShadedSystem& of, const OwnTexts& own,
                                         const std::optional<std::filesystem::path>& shaders, const Profile& profile,
                                         int frames);

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
/// race limits a green verdict (CheckReport::untried).
std::vector<std::string> text_notes(const ShadedSystem& of, const OwnShaders& own, SystemSide& side,
                                    const KnownOperations& known, CheckReport& report);

} // namespace lockstep
