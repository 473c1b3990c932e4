#pragma once
#include <span>

#include "crosscheck/judge/check.hpp"
#include "crosscheck/judge/system.hpp"

namespace lockstep {

/// Takes away the causes that frames refute in which nothing diverges: a mistake that would have shown in one of them
/// was not made. Of `mistakes` those with constants, or that round, are left: a shader's own may show later than the
/// one that was tried. `report` has its verdicts and its power.
void refute_causes(CheckReport& report, std::span<const NamedMistake> mistakes);

} // namespace lockstep
