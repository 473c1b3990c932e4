#pragma once
#include "reference/text/machine.hpp"

namespace lockstep::text {

/// The machine of plain bits, compiled once.
using TextMachine = Machine<TextValues, lanes_at_once>;
/// Compiled for each kind of vectors that processors have (text_machine.cpp).
template <> void TextMachine::run_on_vectors();
extern template class Machine<TextValues, lanes_at_once>;

} // namespace lockstep::text
