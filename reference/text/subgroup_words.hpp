#pragma once
#include <cstdint>

#include <spirv.hpp>

/// What subgroups make of single words (SPIR-V 1.6, 3.49.21).
namespace lockstep::text {

inline bool is_subgroup_operation(std::uint16_t op) {
    return op >= spv::OpGroupNonUniformElect && op <= spv::OpGroupNonUniformQuadSwap;
}
/// Whether it takes a value of another invocation as it is: broadcasts and shuffles.
inline bool is_subgroup_exchange(std::uint16_t op) {
    return op == spv::OpGroupNonUniformBroadcast || op == spv::OpGroupNonUniformBroadcastFirst ||
           (op >= spv::OpGroupNonUniformShuffle && op <= spv::OpGroupNonUniformShuffleDown) ||
           op == spv::OpGroupNonUniformQuadBroadcast || op == spv::OpGroupNonUniformQuadSwap;
}

inline bool is_subgroup_input(spv::BuiltIn builtin) {
    return (builtin >= spv::BuiltInSubgroupSize && builtin <= spv::BuiltInSubgroupLocalInvocationId &&
            builtin != spv::BuiltInVertexIndex) ||
           (builtin >= spv::BuiltInSubgroupEqMask && builtin <= spv::BuiltInSubgroupLtMask);
}

/// Component c of a built-in variable of subgroups, for the invocation `index` of a group of `invocations`.
std::uint32_t subgroup_input(spv::BuiltIn builtin, std::uint32_t size, std::uint32_t index, std::uint32_t invocations,
                             std::uint32_t c);

/// What a reduction of nothing is, and what it makes of two words.
std::uint32_t subgroup_identity(std::uint16_t op);
std::uint32_t subgroup_combined(std::uint16_t op, std::uint32_t a, std::uint32_t b);

} // namespace lockstep::text
