#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "crosscheck/judge/step_row.hpp"
#include "crosscheck/judge/system.hpp"

namespace lockstep {

/// One item's step in a pass, value by value down its twin, each judged by what the GPU told before it.
std::vector<StepRow> item_rows(const JudgedPass& pass, std::size_t item, std::span<const ToldValue> told);

/// What the state that the GPU wrote tells by itself: its fields, by the outputs that the twin knows them by.
std::vector<ToldValue> told_by_state(const JudgedPass& pass, std::size_t item);

} // namespace lockstep
