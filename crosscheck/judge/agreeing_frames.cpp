#include "crosscheck/judge/agreeing_frames.hpp"

#include <algorithm>
#include <map>
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
    // Of the passes that have a mistake of the name, each would have shown it.
    std::map<std::string, bool> is_refuted;
    for (const PowerSummary::Mistake& mistake : report.power.mistakes) {
        bool& by_all = is_refuted.emplace(mistake.name, true).first->second;
        by_all = by_all && mistake.refutes && mistake.first_frame &&
                 *mistake.first_frame < report.verdicts->first->place.frame;
    }
    for (CauseFindings& found : report.verdicts->causes)
        std::erase_if(found.best, [&](const Cause& cause) {
            return std::any_of(cause.mistakes.begin(), cause.mistakes.end(), [&](const std::string& name) {
                const auto known = is_refuted.find(name);
                return known != is_refuted.end() && known->second;
            });
        });
}

} // namespace lockstep
