#include "crosscheck/report/shader_notes.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace lockstep {

std::vector<std::string> warning_notes(const std::vector<ShaderWarning>& warnings) {
    constexpr std::size_t most = 5; // of a report's 60 lines
    std::vector<std::string> notes;
    for (std::size_t i = 0; i < warnings.size() && i < most; ++i)
        notes.push_back(fmt::format("the driver warns: {}: {}", warnings[i].place, warnings[i].message));
    if (warnings.size() > most)
        notes.push_back(fmt::format("the driver warns: {} more", warnings.size() - most));
    return notes;
}

void note_unset_variables(CheckReport& report, const std::vector<ShaderWarning>& warnings) {
    if (report.verdict != Verdict::agree && report.verdict != Verdict::legal)
        return;
    const auto first = std::ranges::find_if(warnings, is_about_unset_variable);
    if (first != warnings.end())
        report.untried.push_back(fmt::format("{} may read a variable that was never set", first->place));
}

} // namespace lockstep
