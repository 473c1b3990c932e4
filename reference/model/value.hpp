#pragma once
#include <bit>
#include <cstdint>

#include "reference/model/schema.hpp"
#include "reference/model/ulp.hpp"

namespace lockstep {

/// One component of a field: its bits, and what they are.
struct Value {
    Scalar scalar = Scalar::float32;
    std::uint32_t bits = 0;

    constexpr Value() = default;
    constexpr Value(float value) : bits(std::bit_cast<std::uint32_t>(value)) {}
    constexpr Value(Scalar scalar_, std::uint32_t bits_) : scalar(scalar_), bits(bits_) {}

    [[nodiscard]] constexpr float real() const { return std::bit_cast<float>(bits); } ///< of a float32
    [[nodiscard]] constexpr std::int64_t integer() const {                            ///< of the others
        return scalar == Scalar::int32 ? std::int64_t{std::bit_cast<std::int32_t>(bits)} : std::int64_t{bits};
    }
    [[nodiscard]] constexpr bool is_nan() const {
        return scalar == Scalar::float32 && (bits & 0x7fffffffU) > 0x7f800000U;
    }
    constexpr bool operator==(const Value&) const = default;
};

/// The same bits, or both NaN.
[[nodiscard]] constexpr bool same_bits(Value a, Value b) {
    return a.scalar == b.scalar && (a.bits == b.bits || (a.is_nan() && b.is_nan()));
}

/// ulp_distance of floats; of integers how far they lie apart.
[[nodiscard]] inline std::int64_t distance(Value a, Value b) {
    if (a.scalar == Scalar::float32)
        return ulp_distance(a.real(), b.real());
    const std::int64_t apart = a.integer() - b.integer();
    return apart < 0 ? -apart : apart;
}

} // namespace lockstep
