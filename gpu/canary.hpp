#pragma once
#include <cstdint>

namespace lockstep {

/// The word that lay_canary() leaves: -4.2e6 or so as a float. A position, speed or time of a real run never has
/// exactly these bits.
inline constexpr std::uint32_t canary_word = 0xca7ca7ca;

} // namespace lockstep
