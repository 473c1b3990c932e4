#pragma once
#include <string>

#include "crosscheck/judge/check.hpp"
#include "crosscheck/judge/verdict_summary.hpp"

namespace lockstep {

/// "--frame 3 --texel 4,5", as `lockstep explain` takes it. `width`: of an image, texels.
std::string place_arguments(const Place& place, const Schema& schema, int width);

/// The same of a run's first divergence: of its state, else "--frame 3 --pixel 4,5" of its rendered frame. Empty where
/// there is none.
std::string first_arguments(const CheckReport& report, int width);

/// As many frames as show a run's first divergence again; without one, its first difference, or all.
int frames_to_repeat(const CheckReport& report);

} // namespace lockstep
