#pragma once
#include <bit>
#include <cstdint>

namespace lockstep {

/// How this thread treats subnormals (FlushSubnormals), for the threads of a parallel loop to do the same.
struct SubnormalMode {
    bool flush_operands = false, flush_results = false;
};

inline SubnormalMode subnormal_mode() {
    const volatile float subnormal = 0x1p-140F, least = 0x1p-126F;
    const volatile float product = least * 0.5F;
    return {!(subnormal > 0.0F), std::bit_cast<std::uint32_t>(static_cast<float>(product)) == 0};
}

} // namespace lockstep
