#pragma once
#include <string>

#include "crosscheck/judge/step_row.hpp"
#include "crosscheck/report/value_text.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

std::string number_text(float value, NumberFormat format);

/// One row under the table's heads; the heads alone.
std::string row_text(const StepRow& row, NumberFormat format);
std::string head_text(const Profile& profile);

} // namespace lockstep
