#pragma once
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "crosscheck/judge/step_row.hpp"
#include "reference/model/value.hpp"

namespace lockstep {

/// A value as the page shows it: decimal and as its bits have it.
nlohmann::json number_json(Value value);

/// The rows of a step table, as crosscheck/report_page/src/steps_section.js shows them.
nlohmann::json rows_json(const std::vector<StepRow>& rows);

} // namespace lockstep
