#pragma once
#include <cstddef>
#include <string>

namespace lockstep {

/// A report with no line longer than `width` columns, where words allow it, and no more than `most` lines: a long line
/// goes on under its text, a command line as a shell reads it on (backslash), and what is too much is left out above
/// the last line, which says how to repeat the run.
std::string folded_text(const std::string& text, std::size_t width, std::size_t most);

} // namespace lockstep
