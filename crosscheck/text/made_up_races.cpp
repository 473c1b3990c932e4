#include "crosscheck/text/made_up_races.hpp"

#include <algorithm>

#include "crosscheck/text/made_up_inputs.hpp"
#include "crosscheck/text/watched_run.hpp"

namespace lockstep {

std::map<std::string, std::vector<const text::Finding*>>
made_up_races(const Examination& of, const text::Program& program, const text::Findings& findings) {
    constexpr std::size_t most_tried = 4, most_invocations = 65'536;
    std::map<std::string, std::vector<const text::Finding*>> all;
    std::vector<std::string> names = index_names(program);
    std::erase_if(names, [&](const std::string& name) {
        return of.fills.contains(name) || of.fills.contains(name.substr(0, name.find('.'))) ||
               of.uniforms.contains(name);
    });
    const std::size_t invocations = std::size_t{of.groups[0]} * of.groups[1] * of.groups[2] * program.invocations();
    if (std::ranges::none_of(findings.all(), text::is_race) || is_endless(findings) || names.size() > most_tried ||
        program.stage != spv::ExecutionModelGLCompute || invocations > most_invocations)
        return all;
    for (const std::string& name : names) {
        Examination other = of;
        other.fills[name] = "iota";
        const text::Findings found = run_watched(other, program, made_up_world(other, program), {}).findings;
        for (const text::Finding& one : findings.all())
            if (text::is_race(one) && std::ranges::none_of(found.all(), [&](const text::Finding& again) {
                    return again.rule == one.rule && again.place.line == one.place.line;
                }))
                all[name].push_back(&one);
    }
    return all;
}

} // namespace lockstep
