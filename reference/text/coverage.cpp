#include "reference/text/coverage.hpp"

#include <cstddef>

#include <fmt/format.h>

namespace lockstep::text {
namespace {

/// Whether who takes a step comes to the next one without a jump.
bool goes_on(const Step& step) {
    switch (step.op) {
    case code::jump:
    case code::branch:
    case code::choose:
    case code::call:
    case code::finish:
    case code::barrier:
    case code::discard:
        return false;
    default:
        return true;
    }
}

} // namespace

Coverage::Coverage(const Program& program) : ways(program.steps.size()), cases(program.operands.size()) {}

std::map<std::uint32_t, bool> covered_lines(const Program& program, const Coverage& coverage) {
    std::map<std::uint32_t, bool> lines;
    bool comes = false;
    for (std::size_t at = 0; at < program.steps.size(); ++at) {
        comes = (coverage.ways[at] & Coverage::came) != 0 || (comes && goes_on(program.steps[at - 1]));
        if (program.stated[at] == 0 || program.lines[at] == 0)
            continue;
        bool& is_covered = lines[program.lines[at]];
        is_covered = is_covered || comes;
    }
    return lines;
}

std::vector<DecisionSide> sides_of(const Program& program, const Decision& decision, const Coverage& coverage) {
    const std::uint8_t ways = coverage.ways[decision.step];
    const bool was_true = (ways & Coverage::was_true) != 0, was_false = (ways & Coverage::was_false) != 0;
    using enum Decision::Kind;
    switch (decision.kind) {
    case loop:
        return {{"loop never turned", was_true}, {"loop never ended by its condition", was_false}};
    case loop_again:
        return {{"loop never turned again", was_true}, {"loop never ended by its condition", was_false}};
    case left_of_and:
        return {{"left side of && was never true", was_true}, {"left side of && was never false", was_false}};
    case left_of_or:
        return {{"left side of || was never true", was_false}, {"left side of || was never false", was_true}};
    case condition:
        return {{"was never true", was_true}, {"was never false", was_false}};
    case cases:
        break;
    }
    const Step& step = program.steps[decision.step];
    std::vector<DecisionSide> sides;
    for (std::size_t pair = step.d; pair < step.d + 2U * step.n; pair += 2) {
        const std::uint32_t word = program.operands[pair];
        const std::string literal =
            decision.is_signed ? std::to_string(static_cast<std::int32_t>(word)) : std::to_string(word);
        sides.push_back({fmt::format("case {} was never taken", literal), coverage.cases[pair] != 0});
    }
    sides.push_back({decision.has_default ? "default was never taken" : "one of the cases was always taken",
                     (ways & Coverage::was_default) != 0});
    return sides;
}

} // namespace lockstep::text
