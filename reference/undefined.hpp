#pragma once
#include <cstdint>
#include <string_view>

namespace lockstep {

/// Why what becomes of a step is left open.
enum class Undefined : std::uint8_t {
    none,
    zero_direction, ///< normalize of a vector whose length may be 0
    not_a_number,   ///< NaN or an overflow among the operands
    unbounded,      ///< a division by something that may be 0
    undecided,      ///< more ways to go than are followed
};
std::string_view undefined_name(Undefined reason);

} // namespace lockstep
