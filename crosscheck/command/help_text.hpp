#pragma once
#include <cstddef>
#include <string>

#include "crosscheck/command/verb.hpp"

namespace lockstep {

/// Columns that help keeps to.
inline constexpr std::size_t help_columns = 80;

/// What --help prints of a verb, in lines of at most help_columns; an option's value without it stands behind it.
/// `called`: as it is typed, "lockstep capsule cut".
std::string help_text(const Verb& verb, const std::string& called);

} // namespace lockstep
