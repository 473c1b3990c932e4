#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace lockstep {

/// Text from elsewhere (names, paths, what a file or a driver says) as one line that a terminal or a browser shows as
/// it stands there, and that cannot pass for one of ours: control characters, line breaks, marks that turn the
/// direction of writing round, and bytes that are no UTF-8 become \n, \x1b, \u202e, \xff. All other characters stay.
std::string plain_line(std::string_view text);

/// The same, of which at most some 1,500 bytes are left: beginning and end.
std::string short_line(std::string_view text);

/// plain_line of a whole report: its line breaks stay.
std::string plain_text(std::string_view text);

/// Whether plain_line leaves it as it is.
bool is_plain(std::string_view text);

/// "1 row", "2 rows".
std::string counted(std::size_t count, std::string_view one);

} // namespace lockstep
