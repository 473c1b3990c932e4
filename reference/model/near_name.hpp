#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep {

/// How many letters to add, drop, change or swap with the next to make one word of the other (Damerau 1964, each letter
/// once).
std::size_t edits(std::string_view a, std::string_view b);

/// The one of `names` that `name` is a slip away from: two letters, or a third of a long name, and less than half of a
/// short one. Nothing where none is near.
std::string nearest_name(std::string_view name, const std::vector<std::string>& names);

/// "; did you mean check?", or nothing.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& names);

} // namespace lockstep
