#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "reference/model/root_tables.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep {

/// A driver's tables (root_tables.hpp) in a fifth of their size, for loops over many numbers: of each value how many
/// units in the last place it is from what plain operations give, four bits each. The same bits as RootTables, any NaN
/// counting as any other, whether the thread flushes subnormals or not.
class PackedRoots {
  public:
    /// Null where a value is more than 7 units off or no number, a table is not complete, or its look-ups are listened
    /// to.
    static std::shared_ptr<const PackedRoots> pack(const RootTables& tables);

    /// The largest relative error of sqrt() over all numbers, from an exhaustive test. It need not rise everywhere; but
    /// of two squares whose ratio is beyond 1 + 4 errors the larger has the larger root.
    [[nodiscard]] double sqrt_error() const { return sqrt_error_; }

    [[nodiscard]] float reciprocal(float x) const { return scaled_reciprocal(x, off_of_reciprocal(x)); }
    [[nodiscard]] float inverse_sqrt(float x) const {
        return scaled_root(x, low_off(roots_of(x)), plain_inverse_sqrt, -1);
    }
    /// The reciprocal of the inverse square root.
    [[nodiscard]] float sqrt(float x) const { return scaled_root(x, high_off(roots_of(x)), plain_sqrt, 1); }

    /// Of `count` numbers, at most block_size; `results` may be `numbers`.
    void reciprocals(const float* numbers, std::size_t count, float* results) const {
        std::array<std::int32_t, block_size> offs;
        for (std::size_t i = 0; i < count; ++i)
            offs[i] = off_of_reciprocal(numbers[i]);
        LOCKSTEP_VECTOR_LOOP
        for (std::size_t i = 0; i < count; ++i)
            results[i] = scaled_reciprocal(numbers[i], offs[i]);
    }
    void inverse_sqrts(const float* numbers, std::size_t count, float* results) const {
        std::array<std::int32_t, block_size> offs;
        for (std::size_t i = 0; i < count; ++i)
            offs[i] = roots_of(numbers[i]);
        LOCKSTEP_VECTOR_LOOP
        for (std::size_t i = 0; i < count; ++i)
            results[i] = scaled_root(numbers[i], low_off(offs[i]), plain_inverse_sqrt, -1);
    }
    void sqrts(const float* numbers, std::size_t count, float* roots, float* inverse_roots) const {
        std::array<std::int32_t, block_size> offs;
        for (std::size_t i = 0; i < count; ++i)
            offs[i] = roots_of(numbers[i]);
        LOCKSTEP_VECTOR_LOOP
        for (std::size_t i = 0; i < count; ++i) {
            inverse_roots[i] = scaled_root(numbers[i], low_off(offs[i]), plain_inverse_sqrt, -1);
            roots[i] = scaled_root(numbers[i], high_off(offs[i]), plain_sqrt, 1);
        }
    }

  private:
    using Bytes = std::vector<std::uint8_t>;
    static constexpr std::uint32_t sign_bit = 0x80000000U, significand_bits = 0x7fffffU, one = 0x3f800000U,
                                   infinite = 0x7f800000U, least_normal = 0x00800000U, nan = 0x7fc00000U;

    static std::uint32_t bits_of(float x) { return std::bit_cast<std::uint32_t>(x); }

    // Four bits, 8 for 0.
    static std::int32_t low_off(std::int32_t byte) { return (byte & 15) - 8; }
    static std::int32_t high_off(std::int32_t byte) { return (byte >> 4) - 8; }
    [[nodiscard]] std::int32_t off_of_reciprocal(float x) const {
        const std::uint32_t significand = bits_of(x) & significand_bits;
        return (reciprocal_[significand >> 1U] >> (4U * (significand & 1U)) & 15) - 8;
    }
    /// The lowest bit of an exponent is set where it is even: 127 stands for 0.
    [[nodiscard]] std::int32_t roots_of(float x) const { return roots_[(bits_of(x) ^ least_normal) & 0xffffffU]; }

    // What `off` is added to: of a number from 1 to 2, and of one from 1 to 4.
    static std::int32_t plain_reciprocal(float x) { return std::bit_cast<std::int32_t>(1.0F / x); }
    static std::int32_t plain_inverse_sqrt(float x) { return std::bit_cast<std::int32_t>(1.0F / std::sqrt(x)); }
    static std::int32_t plain_sqrt(float x) { return std::bit_cast<std::int32_t>(std::sqrt(x)); }

    static float scaled_reciprocal(float x, std::int32_t off) {
        const std::uint32_t bits = bits_of(x), magnitude = bits & ~sign_bit, sign = bits & sign_bit;
        const auto exponent = static_cast<std::int32_t>(magnitude >> 23U);
        const std::int32_t value = plain_reciprocal(std::bit_cast<float>(one | (bits & significand_bits))) + off +
                                   (127 - exponent) * (1 << 23);
        const auto finite = static_cast<std::uint32_t>(value < static_cast<std::int32_t>(least_normal) ? 0 : value);
        const std::uint32_t large = magnitude == infinite ? 0U : magnitude; // NaN stays
        const std::uint32_t result = magnitude < least_normal ? infinite : (magnitude >= infinite ? large : finite);
        return std::bit_cast<float>(result | sign);
    }

    /// `direction`: 1 of a root, -1 of an inverse one.
    template <class Plain> static float scaled_root(float x, std::int32_t off, Plain plain, std::int32_t direction) {
        const std::uint32_t bits = bits_of(x), magnitude = bits & ~sign_bit, sign = bits & sign_bit;
        const auto exponent = static_cast<std::int32_t>(magnitude >> 23U);
        const std::int32_t odd = (exponent & 1) ^ 1;
        const std::int32_t half = (exponent - 127 - odd) / 2; // even: nothing is lost
        const float between =
            std::bit_cast<float>((static_cast<std::uint32_t>(127 + odd) << 23U) | (bits & significand_bits));
        const auto finite = static_cast<std::uint32_t>(plain(between) + off + direction * half * (1 << 23));
        const std::uint32_t of_infinity = direction < 0 ? 0U : infinite, of_zero = infinite - of_infinity;
        const std::uint32_t large = magnitude > infinite ? nan : of_infinity;
        const std::uint32_t positive = magnitude >= infinite ? large : finite;
        const std::uint32_t result = magnitude < least_normal ? of_zero | sign : (sign != 0 ? nan : positive);
        return std::bit_cast<float>(result);
    }

    Bytes reciprocal_; ///< two significands a byte
    Bytes roots_;      ///< of each number from 1 to 4: of the inverse root below, of the root above
    double sqrt_error_ = 0.0;
};

/// PackedRoots::pack of a profile's tables, which may be null; made once for as long as the tables live.
std::shared_ptr<const PackedRoots> packed_roots(const std::shared_ptr<const RootTables>& tables);

} // namespace lockstep
