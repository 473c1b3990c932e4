#pragma once
#include <cstddef>
#include <string>

#include "crosscheck/judge/compare.hpp"
#include "crosscheck/judge/verdict.hpp"

namespace lockstep {

/// The first step of the pass at which no legal run reaches what the GPU has, as far as what was captured tells:
/// whether it hit, then speed, direction and position, then the texel.
struct WrongStep {
    std::string step;      ///< "search", "nearest", "speed", ...
    std::string operation; ///< what the reference computed there, with its operands
    std::string gpu;       ///< what the GPU must have done instead, where that is known; else empty
    std::string margin;    ///< how far the GPU is from what is legal
    Difference difference; ///< the field that shows it
};

WrongStep wrong_step_of_particle(const JudgedFrame& frame, std::size_t particle);
WrongStep wrong_step_of_texel(const JudgedFrame& frame, std::size_t texel);

} // namespace lockstep
