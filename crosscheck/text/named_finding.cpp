#include "crosscheck/text/named_finding.hpp"

#include <utility>

#include <fmt/format.h>

namespace lockstep {

std::string NamedFinding::text() const {
    std::string line = fmt::format("{}: {}: {}", where, found.rule, found.what);
    if (found.other && other != where)
        line += fmt::format("; the other at {}", other);
    else if (!found.other)
        line += fmt::format("; invocation {}", found.place.invocation);
    return line + (found.times > 1 ? fmt::format("; {} times\n", found.times) : "\n");
}

nlohmann::json NamedFinding::json() const {
    nlohmann::json row{{"rule", found.rule},
                       {"what", found.what},
                       {"where", where},
                       {"invocation", found.place.invocation},
                       {"times", found.times}};
    if (found.other)
        row["other"] = {{"where", other}, {"invocation", found.other->invocation}};
    return row;
}

std::vector<NamedFinding> named(const text::Findings& findings, const text::Program& program) {
    std::vector<NamedFinding> all;
    for (const text::Finding& found : findings.all())
        all.push_back({found, program.line_name(found.place.line),
                       found.other ? program.line_name(found.other->line) : std::string()});
    return all;
}

} // namespace lockstep
