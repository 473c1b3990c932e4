#pragma once
#include "crosscheck/command/verb.hpp"

namespace lockstep {

/// `lockstep study thesis`.
Verb thesis_verb();

} // namespace lockstep
