#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crosscheck/cli/text_passes.hpp"
#include "crosscheck/judge/registered_system.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// What watched runs of the texts of a system's shaders find (docs/shader_text.md), on a sample of the groups of
/// the first frames, from the reference's states: a line each. A text that is not interpreted is one of them.
/// `own`: those that were read already; `shaders`: where the others are, or nothing: they are not looked into.
std::vector<std::string> shader_findings(const ShadedSystem& of, const OwnTexts& own,
                                         const std::optional<std::filesystem::path>& shaders, const Profile& profile,
                                         int frames);

} // namespace lockstep
