#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "reference/text/program.hpp"

namespace lockstep::text {

/// Where the invocations of one or more runs came in a program, and which ways they took there.
struct Coverage {
    Coverage() = default;
    explicit Coverage(const Program& program);

    enum Way : std::uint8_t { came = 1, was_true = 2, was_false = 4, was_default = 8 };
    std::vector<std::uint8_t> ways;  ///< by step; `came`: by a jump, or at a run's start
    std::vector<std::uint8_t> cases; ///< by operand: of a switch, whether its pair of literal and step was taken
};

/// By line that has a statement, whether an invocation came there.
std::map<std::uint32_t, bool> covered_lines(const Program& program, const Coverage& coverage);

/// One way on from a decision.
struct DecisionSide {
    std::string never; ///< what holds where it was not taken: "was never true"
    bool is_taken = false;
};
/// All of a decision's.
std::vector<DecisionSide> sides_of(const Program& program, const Decision& decision, const Coverage& coverage);

} // namespace lockstep::text
