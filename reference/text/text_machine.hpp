#pragma once
#include "reference/text/machine.hpp"

namespace lockstep::text {

/// The machine of plain bits, compiled once.
using TextMachine = Machine<TextValues, lanes_at_once>;
/// For each kind of vectors that processors have (text_machine.cpp).
template <> void TextMachine::operations();
extern template class Machine<TextValues, lanes_at_once>;

} // namespace lockstep::text
