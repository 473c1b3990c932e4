#pragma once
#include "crosscheck/check_file/document.hpp"
#include "reference/model/system_state.hpp"

namespace lockstep::check_file {

/// What each item of a buffer or image begins with, 0 where nothing is said. For a buffer `start` is an object by field
/// or { "table": FILE } with a column a component (number_table.hpp); for an image, or a buffer of one field, a value
/// may stand alone. A value is a number, a list of a component each, { "values": [one an item, ...] },
/// { "random": [low, high], "seed": 1 }, each component by itself, or { "index": [first, step] }. Throws Error as
/// JsonValue does.
void set_start(const StateEntry& entry, const WritableView& state);

} // namespace lockstep::check_file
