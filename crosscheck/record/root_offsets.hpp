#pragma once
#include <cstdint>
#include <vector>

#include "reference/model/root_tables.hpp"

namespace lockstep {

/// A driver's tables as they are kept: how many units in the last place each value is from the rounded one, which every
/// machine computes alike. One byte instead of four, and nearly all of them 0 or 1.
struct RootOffsets {
    std::vector<std::int8_t> reciprocal;   ///< 2^23
    std::vector<std::int8_t> inverse_sqrt; ///< 2^24
};

inline constexpr std::size_t reciprocal_count = std::size_t{1} << 23U;
inline constexpr std::size_t inverse_sqrt_count = std::size_t{1} << 24U;

/// Throws Error if a value is more than 127 units off.
RootOffsets root_offsets(const RootTables& tables);

RootTables root_tables(const RootOffsets& offsets);

} // namespace lockstep
