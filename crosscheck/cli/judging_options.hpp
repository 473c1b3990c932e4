#pragma once
#include <CLI/CLI.hpp>

#include "crosscheck/judge/check.hpp"
#include "crosscheck/judge/legal.hpp"

namespace lockstep {

void add_legal_option(CLI::App& verb, Legal& legal);

/// --allow-undefined and --require-hits.
void add_pass_options(CLI::App& verb, PassRules& rules);

} // namespace lockstep
