#include "crosscheck/judge/agreeing_frames.hpp"

#include <algorithm>
#include <set>
#include <string>

namespace lockstep {

void refute_causes(CheckReport& report, std::span<const NamedMistake> mistakes) {
    if (!report.verdicts || !report.verdicts->first ||
        report.verdicts->first->verdict.kind != DifferenceClass::divergent)
        return;
    std::set<std::string> refuted;
    for (const PowerSummary::Mistake& mistake : report.power.mistakes)
        if (mistake.first_frame && *mistake.first_frame < report.verdicts->first->place.frame)
            refuted.insert(mistake.name);
    for (const NamedMistake& mistake : mistakes)
        if (!mistake.is_exact() || mistake.mistake.site == 0 || mistake.mistake.change == Change::spoiled)
            refuted.erase(mistake.name);
    for (CauseFindings& found : report.verdicts->causes)
        std::erase_if(found.best, [&](const Cause& cause) {
            return std::any_of(cause.mistakes.begin(), cause.mistakes.end(),
                               [&](const std::string& name) { return refuted.contains(name); });
        });
}

} // namespace lockstep
