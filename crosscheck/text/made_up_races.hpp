#pragma once
#include <map>
#include <string>
#include <vector>

#include "crosscheck/text/examination.hpp"
#include "reference/text/findings.hpp"
#include "reference/text/program.hpp"

namespace lockstep {

/// Races that would not be if the integers of a name counted up (fills.hpp), by that name: integers that are not given
/// are 0, and often indexes. Few names are tried, in small dispatches.
std::map<std::string, std::vector<const text::Finding*>>
made_up_races(const Examination& of, const text::Program& program, const text::Findings& findings);

} // namespace lockstep
