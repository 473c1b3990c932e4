#pragma once
/// One function of a shader, held against a table of results, or against another function of GLSL, on a table of
/// arguments from a file (docs/functions.md); `lockstep function` does no more:
///
///     const GlslFunction bounce{"shaders/wall.glsl", "bounce", {{"u_Kept", 0.5F}}};
///     CHECK(match_function(gl, bounce, read_function_rows(bounce, "walls.csv")).passed());
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lockstep/function.hpp"

namespace lockstep {

/// A function's arguments, row by row, and what it is to return.
struct FunctionRows {
    std::string file;
    std::vector<function_twin::Column> columns;             ///< of the arguments, in their order
    std::vector<std::string> names;                         ///< of the arguments, as the shader has them
    std::vector<std::uint32_t> words;                       ///< row after row, component by component: bits
    std::vector<std::size_t> lines;                         ///< where each row stands in the file, from 1; of JSON none
    std::optional<std::vector<std::uint32_t>> results = {}; ///< row after row; nothing: the file has no such column

    [[nodiscard]] std::size_t width() const; ///< words of a row
    [[nodiscard]] std::size_t count() const { return words.size() / width(); }
};

/// Reads FILE.json, an array of objects by the arguments' names, or a CSV file with a heading of these names, a column
/// a component (`velocity.x`). `result` is what the function is to return, the same in every row or in none. A number
/// is the float nearest to it; `inf`, `nan` and hexadecimal floats (0x1.8p-3) are numbers, in JSON as texts. Throws
/// Error with FILE:LINE, or the place in the JSON, and what would be right.
FunctionRows read_function_rows(const GlslFunction& function, const std::filesystem::path& file);

/// How a function's text is read where it is compared with another text, not with the bits of a GPU.
struct TextTaken {
    bool as_written = false;   ///< constants are the numbers that they were written as, not the nearest floats
    bool in_any_order = false; ///< sums and products, in spite of `precise`
};
/// Of a row, the results that a function may legally return, each with all components.
using OpenResults = std::function<std::vector<ItemOutcome>(std::size_t row, const TextTaken& taken)>;

/// What is expected of a function.
struct ExpectedResults {
    std::vector<std::uint32_t> words; ///< row after row
    std::string from;                 ///< "results of the table"
    OpenResults own = {};             ///< what the function's text leaves open; empty: nothing is known of it
    OpenResults expected = {};        ///< what is left open where `words` come from; empty: each is one number
};

/// Runs the function on every row. Right is the expected word. Where `own` can be what is expected, each of `own` is
/// legal, too.
MatchResult match_function(const Gl& gl, const GlslFunction& function, const FunctionRows& rows,
                           ExpectedResults expected, const FunctionMatchOptions& options = {});

/// Runs the function on every row and holds what it returns against the results of the rows; another bit is divergent.
/// Throws Error where the rows have none.
MatchResult match_function(const Gl& gl, const GlslFunction& function, const FunctionRows& rows,
                           const FunctionMatchOptions& options = {});

/// The same against what another function with the same arguments returns on the same GL. Throws Error where both are
/// one: the same text, definitions and uniforms.
MatchResult match_function(const Gl& gl, const GlslFunction& function, const FunctionRows& rows,
                           const GlslFunction& like, const FunctionMatchOptions& options = {});

/// What a function returns of each row on this GL, row after row.
std::vector<std::uint32_t> returned(const Gl& gl, const GlslFunction& function, const FunctionRows& rows);
/// Names where they come from: "results of plain (plain.glsl)".
std::string results_of(const GlslFunction& like);
/// Throws Error where both are one, or return different types.
void check_comparable(const GlslFunction& function, const GlslFunction& like, const FunctionRows& rows);

} // namespace lockstep
