#pragma once
#include <CLI/CLI.hpp>

#include "crosscheck/legal.hpp"

namespace lockstep {

void add_legal_option(CLI::App& verb, Legal& legal);

} // namespace lockstep
