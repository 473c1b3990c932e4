#pragma once
#include "crosscheck/command/verb.hpp"
#include "crosscheck/judge/check.hpp"
#include "crosscheck/judge/legal.hpp"

namespace lockstep {

void add_legal_option(Verb& verb, Legal& legal);

/// --allow-undefined, --require-hits and --power-at-least.
void add_pass_options(Verb& verb, PassRules& rules);

} // namespace lockstep
