#pragma once
#include <cstddef>
#include <string>

#include "crosscheck/judge/step_row.hpp"
#include "crosscheck/report/value_text.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

std::string number_text(float value, NumberFormat format);

/// Columns of a row's label.
inline constexpr std::size_t narrowest_label = 25;

/// One row under the table's heads; the heads alone.
std::string row_text(const StepRow& row, NumberFormat format, std::size_t label_width = narrowest_label);
std::string head_text(const Profile& profile, std::size_t label_width = narrowest_label);

} // namespace lockstep
