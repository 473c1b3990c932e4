#pragma once
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace lockstep {

/// A driver's own reciprocal and inverse square root, measured for every significand, so that the reference can follow
/// hardware that rounds neither correctly. Other exponents are scaled: both functions are taken to depend on the
/// significand (and the exponent's parity) alone, as a table in hardware does; subnormals are zero.
struct RootTables {
    std::vector<float> reciprocal;   ///< [i]: of 1 + i 2^-23, 2^23 values
    std::vector<float> inverse_sqrt; ///< [i]: of the float with bits 0x3f800000 + i, from 1 to 4, 2^24 values
    /// Set: told of every value that is looked up, by whichever thread does.
    std::function<void(const std::vector<float>& table, std::size_t index)> on_lookup = {};

    [[nodiscard]] float reciprocal_of(float x) const {
        const auto bits = std::bit_cast<std::uint32_t>(x);
        const int exponent = static_cast<int>(bits >> 23U & 0xffU);
        if (exponent == 0)
            return std::copysign(std::numeric_limits<float>::infinity(), x);
        if (exponent == 255)
            return (bits & 0x7fffffU) != 0 ? x : std::copysign(0.0F, x);
        const float magnitude = scaled(at(reciprocal, bits & 0x7fffffU), 127 - exponent);
        return std::copysign(magnitude, x);
    }

    [[nodiscard]] float inverse_sqrt_of(float x) const {
        const auto bits = std::bit_cast<std::uint32_t>(x);
        const int exponent = static_cast<int>(bits >> 23U & 0xffU);
        if (exponent == 0)
            return std::copysign(std::numeric_limits<float>::infinity(), x);
        if (exponent == 255 && (bits & 0x7fffffU) != 0)
            return x;
        if (bits >> 31U != 0)
            return std::numeric_limits<float>::quiet_NaN();
        if (exponent == 255)
            return 0.0F;
        const std::uint32_t odd = static_cast<std::uint32_t>(exponent - 127) & 1U;
        const int half = (exponent - 127 - static_cast<int>(odd)) / 2;
        return scaled(at(inverse_sqrt, odd << 23U | (bits & 0x7fffffU)), -half);
    }

  private:
    [[nodiscard]] float at(const std::vector<float>& table, std::size_t index) const {
        if (on_lookup)
            on_lookup(table, index);
        return table[index];
    }

    /// x 2^by, x between 1/2 and 1; results below the normal range are zero.
    static float scaled(float x, int by) {
        const float result = std::ldexp(x, by);
        return result < std::numeric_limits<float>::min() ? 0.0F : result;
    }
};

} // namespace lockstep
