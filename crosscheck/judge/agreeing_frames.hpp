#pragma once
#include <span>

#include "crosscheck/judge/check.hpp"
#include "crosscheck/judge/system.hpp"

namespace lockstep {

/// Notes which mistakes refute themselves by not showing (PowerSummary::Mistake::refutes). Of `mistakes` not those with
/// constants, or that round: a shader's own may show later than the one that was tried. Nor those of a host, and of
/// what images store: they may begin in a later frame.
void note_refuting(PowerSummary& power, std::span<const NamedMistake> mistakes);

/// Takes away the causes that frames refute in which nothing diverges: a mistake that would have shown in one of them
/// was not made. `report` has its verdicts, and its power with what refutes noted.
void refute_causes(CheckReport& report);

} // namespace lockstep
