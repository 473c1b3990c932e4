#pragma once
#include <cstddef>

#include "crosscheck/judge/system.hpp"
#include "crosscheck/judge/verdict_summary.hpp"

namespace lockstep {

/// Where an item's step went wrong, as far as the state alone tells: the one decision that explains all of it where it
/// is made otherwise; else the first named value that no legal run gives, of the outcome that comes nearest to what the
/// GPU has.
WrongStep wrong_step_of_item(const JudgedPass& pass, std::size_t item);

} // namespace lockstep
