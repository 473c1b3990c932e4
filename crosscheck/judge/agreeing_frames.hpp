#pragma once
#include <span>

#include "crosscheck/judge/check.hpp"
#include "crosscheck/judge/system.hpp"

namespace lockstep {

/// Takes away the causes that frames refute in which nothing diverges: a mistake that would have shown in one of them
/// was not made. Of `mistakes` those with constants, or that round, are left: a shader's own may show later than the
/// one that was tried. So are those of a host, and of what images store: they may begin in a later frame. `report` has
/// its verdicts and its power.
void refute_causes(CheckReport& report, std::span<const NamedMistake> mistakes);

} // namespace lockstep
