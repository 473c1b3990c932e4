#pragma once
#include <string>

namespace lockstep {

/// Verdicts in colour where standard output is a terminal that has some and NO_COLOR (no-color.org) is not set: green
/// for what agrees, yellow for what is legal, red for what is not; else the text as it is.
std::string colored(std::string text);

} // namespace lockstep
