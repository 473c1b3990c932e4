#include "crosscheck/judge/agreeing_frames.hpp"

#include <algorithm>
#include <set>
#include <string>

namespace lockstep {

void note_refuting(PowerSummary& power, std::span<const NamedMistake> mistakes) {
    std::set<std::string> silent;
    for (const NamedMistake& mistake : mistakes)
        if (!mistake.is_exact() || mistake.mistake.site == 0 || mistake.mistake.change == Change::spoiled)
            silent.insert(mistake.name);
    for (PowerSummary::Mistake& mistake : power.mistakes)
        mistake.refutes = !silent.contains(mistake.name);
}

void refute_causes(CheckReport& report) {
    if (!report.verdicts || !report.verdicts->first ||
        report.verdicts->first->verdict.kind != DifferenceClass::divergent)
        return;
    std::set<std::string> refuted;
    for (const PowerSummary::Mistake& mistake : report.power.mistakes)
        if (mistake.refutes && mistake.first_frame && *mistake.first_frame < report.verdicts->first->place.frame)
            refuted.insert(mistake.name);
    for (CauseFindings& found : report.verdicts->causes)
        std::erase_if(found.best, [&](const Cause& cause) {
            return std::any_of(cause.mistakes.begin(), cause.mistakes.end(),
                               [&](const std::string& name) { return refuted.contains(name); });
        });
}

} // namespace lockstep
