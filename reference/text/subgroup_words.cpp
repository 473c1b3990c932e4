#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "reference/text/subgroup_words.hpp"

namespace lockstep::text {

std::uint32_t subgroup_input(spv::BuiltIn builtin, std::uint32_t size, std::uint32_t index, std::uint32_t invocations,
                             std::uint32_t c) {
    const std::uint32_t own = index % size;
    const auto mask = [&](std::uint32_t first, std::uint32_t end) { // bits of the c-th word of four
        std::uint32_t bits = 0;
        for (std::uint32_t bit = 0; bit < 32; ++bit)
            if (const std::uint32_t at = 32 * c + bit; at >= first && at < end)
                bits |= 1U << bit;
        return bits;
    };
    switch (builtin) {
    case spv::BuiltInSubgroupSize:
        return size;
    case spv::BuiltInNumSubgroups:
        return (invocations + size - 1) / size;
    case spv::BuiltInSubgroupId:
        return index / size;
    case spv::BuiltInSubgroupLocalInvocationId:
        return own;
    case spv::BuiltInSubgroupEqMask:
        return mask(own, own + 1);
    case spv::BuiltInSubgroupGeMask:
        return mask(own, size);
    case spv::BuiltInSubgroupGtMask:
        return mask(own + 1, size);
    case spv::BuiltInSubgroupLeMask:
        return mask(0, own + 1);
    default:
        return mask(0, own); // gl_SubgroupLtMask
    }
}

std::uint32_t subgroup_identity(std::uint16_t op) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr std::uint32_t most = 0x7fffffffU, least = 0x80000000U;
    switch (op) {
    case spv::OpGroupNonUniformIMul:
    case spv::OpGroupNonUniformLogicalAnd:
        return 1;
    case spv::OpGroupNonUniformFMul:
        return std::bit_cast<std::uint32_t>(1.0F);
    case spv::OpGroupNonUniformSMin:
        return most;
    case spv::OpGroupNonUniformSMax:
        return least;
    case spv::OpGroupNonUniformUMin:
    case spv::OpGroupNonUniformBitwiseAnd:
        return ~0U;
    case spv::OpGroupNonUniformFMin:
        return std::bit_cast<std::uint32_t>(infinity);
    case spv::OpGroupNonUniformFMax:
        return std::bit_cast<std::uint32_t>(-infinity);
    default:
        return 0;
    }
}

std::uint32_t subgroup_combined(std::uint16_t op, std::uint32_t a, std::uint32_t b) {
    const auto real = [](std::uint32_t word) { return std::bit_cast<float>(word); };
    const auto word = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    const bool is_less = static_cast<std::int32_t>(a) < static_cast<std::int32_t>(b);
    switch (op) {
    case spv::OpGroupNonUniformIAdd:
        return a + b;
    case spv::OpGroupNonUniformFAdd:
        return word(real(a) + real(b));
    case spv::OpGroupNonUniformIMul:
        return a * b;
    case spv::OpGroupNonUniformFMul:
        return word(real(a) * real(b));
    case spv::OpGroupNonUniformSMin:
        return is_less ? a : b;
    case spv::OpGroupNonUniformUMin:
        return std::min(a, b);
    case spv::OpGroupNonUniformFMin:
        return word(std::fmin(real(a), real(b)));
    case spv::OpGroupNonUniformSMax:
        return is_less ? b : a;
    case spv::OpGroupNonUniformUMax:
        return std::max(a, b);
    case spv::OpGroupNonUniformFMax:
        return word(std::fmax(real(a), real(b)));
    case spv::OpGroupNonUniformBitwiseAnd:
    case spv::OpGroupNonUniformLogicalAnd:
        return a & b;
    case spv::OpGroupNonUniformBitwiseOr:
    case spv::OpGroupNonUniformLogicalOr:
        return a | b;
    default:
        return a ^ b; // OpGroupNonUniformBitwiseXor, OpGroupNonUniformLogicalXor
    }
}

} // namespace lockstep::text
