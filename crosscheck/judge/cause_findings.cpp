#include "crosscheck/judge/cause_findings.hpp"

namespace lockstep {

std::string Cause::name() const {
    std::string text;
    for (const std::string& mistake : mistakes)
        text += (text.empty() ? "" : " + ") + mistake;
    return text;
}

} // namespace lockstep
