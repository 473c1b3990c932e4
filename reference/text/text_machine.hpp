#pragma once
#include "reference/text/machine.hpp"

namespace lockstep::text {

/// Invocations that dispatches and stages run at once.
inline constexpr int lanes_at_once = 16;

/// The machine of plain bits, compiled once.
using TextMachine = Machine<TextValues, lanes_at_once>;
extern template class Machine<TextValues, lanes_at_once>;

} // namespace lockstep::text
