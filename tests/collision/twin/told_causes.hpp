#pragma once
#include <string>
#include <vector>

#include "crosscheck/report/report.hpp"
#include "crosscheck/report/verdict_text.hpp"

namespace lockstep::test {

/// The names that a run gives for what diverges; none where no cause is told.
inline std::vector<std::string> told_causes(const CheckReport& report) {
    std::vector<std::string> names;
    if (report.verdicts && tells_cause(*report.verdicts))
        for (const CauseFindings& found : report.verdicts->causes)
            if (found.explains_all())
                for (const Cause& cause : found.best)
                    names.push_back(cause.name());
    return names;
}

} // namespace lockstep::test
