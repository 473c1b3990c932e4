#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/shader_source.hpp"
#include "reference/text/alignment.hpp"
#include "reference/text/program.hpp"

namespace lockstep {

/// A line of a wrong shader that has no counterpart in the reference's text, as a report has it.
struct WitnessLine {
    std::string where; ///< FILE:LINE
    std::string text;  ///< of the line
    std::string what;  ///< what it gave of an item, and what would have been right there
};

/// What WitnessLine::where of a line of the reference ends with.
inline constexpr std::string_view reference_mark = " of the reference";

/// "FILE:LINE: TEXT: WHAT".
std::string line_of(const WitnessLine& line);

/// One of the two texts that the witness looks at.
struct WitnessedText {
    const text::Program& program;
    /// One invocation apart from others, with some rows forced. Throws Error for what is not run so.
    std::function<text::TracedRun(std::uint32_t invocation, std::span<const text::ForcedRow> forced)> run;
    /// Gives a place the numbers that it has in both texts; nothing: the other text has no such place.
    std::function<std::optional<text::WrittenPlace>(text::WrittenPlace)> common;
    const ShaderSource& source; ///< that its lines are in
};

/// The run of an invocation by places that both texts have. Outputs of one alone lie behind all others, and are none of
/// its words.
text::TracedRun common_run(const WitnessedText& text, std::uint32_t invocation,
                           std::span<const text::ForcedRow> forced = {});

/// The invocation that wrote an item in each of the texts; nothing: none or several did.
struct ItemWriters {
    std::optional<std::uint32_t> wrong, reference;
};

/// Looks for the lines of `wrong` that make what it writes differ from what `reference` writes from the same state,
/// invocation by invocation (reference/text/alignment.hpp). At most three, the likeliest first; none where too little
/// speaks for any. `items` differ from the reference, `others` do not.
/// What lies in a file that is none of the user's, by is_own(FILE:LINE), counts as the call's line; so does a line of a
/// function of which one call of several is at fault, or that both texts have word by word. Such lines say less. Of
/// texts that are written otherwise, what loops compare says nothing.
std::vector<WitnessLine> witness_lines(const WitnessedText& wrong, const WitnessedText& reference,
                                       std::span<const ItemWriters> items, std::span<const ItemWriters> others,
                                       const std::function<bool(std::string_view where)>& is_own,
                                       bool is_written_otherwise = false);

} // namespace lockstep
