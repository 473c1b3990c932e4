#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace lockstep {

/// A report with no line longer than `width` columns, where words allow it, and no more than `most` lines: a long line
/// goes on under its text, a command line as a shell reads it on (backslash), and what is too much is left out above
/// the last line, which says how to repeat the run.
std::string folded_text(const std::string& text, std::size_t width, std::size_t most);

/// What a report's line of that name says.
std::string line_of(const std::string& report, std::string_view name);

/// The same report, with those lines first that a failed test is about: verdict, cause, first difference, and the
/// commands that show it again and repeat it.
std::string failure_first(const std::string& report);

} // namespace lockstep
