#pragma once
#include <vector>

#include "crosscheck/judge/system.hpp"
#include "reference/model/fluid/host.hpp"

namespace lockstep::fluid {

/// The mistakes that have names, with the numbers that a host may take for its own.
std::vector<NamedMistake> mistakes(const Host& host);

} // namespace lockstep::fluid
