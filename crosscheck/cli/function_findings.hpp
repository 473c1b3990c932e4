#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "lockstep/function_table.hpp"

namespace lockstep {

/// A row of a table whose arguments lead a function to an operand for which GLSL defines no result, or to a variable
/// that was never set: any result is as right as another.
struct UndefinedRow {
    std::size_t row = 0;
    std::string where, rule, what; ///< FILE:LINE of the operation
};

/// Runs the function's own text on each row (docs/shader_text.md). Rows ascend; none where the text is not interpreted.
std::vector<UndefinedRow> undefined_rows(const GlslFunction& function, const FunctionRows& rows);

/// The rows that are none of these, which ascend.
FunctionRows without(const FunctionRows& rows, const std::vector<UndefinedRow>& undefined);

/// The verdict on a table with such rows, and a line for each; `others`: rows that were judged, all of which agree.
std::string undefined_text(const FunctionRows& rows, const std::vector<UndefinedRow>& undefined, std::size_t others);

} // namespace lockstep
