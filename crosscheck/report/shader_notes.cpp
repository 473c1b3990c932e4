#include "crosscheck/report/shader_notes.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reference/text/findings.hpp"

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

void note_races(CheckReport& report, const std::vector<std::string>& notes) {
    if (report.verdict != Verdict::agree && report.verdict != Verdict::legal)
        return;
    for (const std::string& note : notes)
        if (const std::size_t rule = note.find(fmt::format(": {}", text::race_rule)); rule != std::string::npos) {
            report.untried.push_back(fmt::format("{} races with another invocation", note.substr(0, rule)));
            return;
        }
}

} // namespace lockstep
