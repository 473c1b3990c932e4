#pragma once
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "crosscheck/judge/power_summary.hpp"

namespace lockstep {

/// "101 of 106 mistakes would have shown".
std::string power_words(const PowerSummary& power);

/// "101 of 106 mistakes would have shown; not: a (nothing collided) and 4 more".
std::string power_line(const PowerSummary& power);

/// "not: last_row_skipped, last_column_skipped (nothing collided)": a line a reason, all of them.
std::vector<std::string> unseen_by_reason(const PowerSummary& power);

/// "hits 1,200; hits with two in range 31".
std::string situations_text(const PowerSummary& power);

/// Each mistake of a run's power, and the first frame in which it would have shown, or why it could not.
std::string power_text(const PowerSummary& power);

/// The same as data.
nlohmann::json power_json(const PowerSummary& power);

} // namespace lockstep
