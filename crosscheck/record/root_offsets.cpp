#include "crosscheck/record/root_offsets.hpp"

#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

std::uint32_t rounded_reciprocal(std::size_t i) {
    const float x = std::bit_cast<float>(0x3f800000U + static_cast<std::uint32_t>(i));
    return std::bit_cast<std::uint32_t>(1.0F / x);
}

std::uint32_t rounded_inverse_sqrt(std::size_t i) {
    const float x = std::bit_cast<float>(0x3f800000U + static_cast<std::uint32_t>(i));
    return std::bit_cast<std::uint32_t>(static_cast<float>(1.0 / std::sqrt(static_cast<double>(x))));
}

template <class Rounded>
std::vector<std::int8_t> offsets(const std::vector<float>& table, const char* name, Rounded rounded) {
    std::vector<std::int8_t> off(table.size());
    std::atomic<bool> too_far{false};
    const auto count = static_cast<std::ptrdiff_t>(table.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const std::int64_t ulp = std::int64_t{std::bit_cast<std::uint32_t>(table[at])} - std::int64_t{rounded(at)};
        if (ulp < INT8_MIN || ulp > INT8_MAX)
            too_far = true;
        off[at] = static_cast<std::int8_t>(ulp);
    }
    if (too_far)
        throw Error(
            fmt::format("the driver's {} is more than 127 units in the last place off; a trace cannot hold it", name));
    return off;
}

template <class Rounded> std::vector<float> table(const std::vector<std::int8_t>& off, Rounded rounded) {
    std::vector<float> values(off.size());
    const auto count = static_cast<std::ptrdiff_t>(off.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(i);
        values[at] = std::bit_cast<float>(rounded(at) + static_cast<std::uint32_t>(off[at]));
    }
    return values;
}

} // namespace

RootOffsets root_offsets(const RootTables& tables) {
    return {offsets(tables.reciprocal, "1/x", rounded_reciprocal),
            offsets(tables.inverse_sqrt, "inversesqrt", rounded_inverse_sqrt)};
}

RootTables root_tables(const RootOffsets& off) {
    return {table(off.reciprocal, rounded_reciprocal), table(off.inverse_sqrt, rounded_inverse_sqrt)};
}

} // namespace lockstep
