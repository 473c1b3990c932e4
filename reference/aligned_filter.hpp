#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace lockstep {

/// A texture unit that filters in fixed point, as measured of NVIDIA's (data/results/h200/filter.txt): a place is
/// rounded to 256ths of a texel, the eight texels around it get weights of 256ths, those of a plane are cut to a grid
/// below the greatest of them, and the sum is rounded, halves away from 0.

/// Bits that it keeps of texels, below the greatest, and of the sum.
struct FilterBits {
    int texel, result;
    int least_exponent; ///< of the result's last bit
};
inline constexpr FilterBits float_filter_bits{28, 24, -149}, half_filter_bits{15, 11, -24};

/// Texels x, y, z of a cell at x + 2 y + 4 z.
using FilterCell = std::array<float, 8>;

/// A place on an axis, in texels from the first one's middle, to 256ths, halves up.
inline double filter_place(double texels) { return std::floor(texels * 256.0 + 0.5); }
/// The same of a texture's coordinate, 0 to 1 over `size` texels, which is cut to 2^-21 first.
inline double filter_place(double coordinate, int size) {
    const double cut = std::floor(coordinate * 0x1p21) * 0x1p-21;
    return filter_place(cut * size - 0.5);
}

/// Weights, 256 in all, of a cell's texels at a place that is so many 256ths behind the first on each axis: shared out
/// by z, then x, then y, the second half rounded and the first what is left.
inline std::array<int, 8> filter_weights(const std::array<int, 3>& behind) {
    std::array<int, 8> weights{};
    for (std::size_t z = 0; z < 2; ++z) {
        const int plane = z == 0 ? 256 - behind[2] : behind[2];
        const int right = (plane * behind[0] + 128) >> 8;
        for (std::size_t x = 0; x < 2; ++x) {
            const int column = x == 0 ? plane - right : right;
            const int upper = (column * behind[1] + (x == 0 ? 127 : 128)) >> 8;
            weights[x + 4 * z] = column - upper;
            weights[x + 2 + 4 * z] = upper;
        }
    }
    return weights;
}

namespace aligned_filter {

/// `sum` 2^(exponent - bits of a texel - 8)
struct Plane {
    double sum = 0.0;
    int exponent = 0;
};

inline Plane plane_of(const FilterCell& cell, const std::array<int, 8>& weights, std::size_t first, int bits) {
    Plane plane;
    bool is_first = true;
    const auto for_each = [&](const auto& visit) {
        for (std::size_t i = first; i < first + 4; ++i)
            if (weights[i] != 0 && cell[i] != 0.0F)
                visit(cell[i], weights[i]);
    };
    for_each([&](float texel, int) {
        const int exponent = std::ilogb(texel) + 1;
        plane.exponent = is_first ? exponent : std::max(plane.exponent, exponent);
        is_first = false;
    });
    for_each([&](float texel, int weight) {
        plane.sum += std::trunc(std::ldexp(double{texel}, bits - plane.exponent)) * weight;
    });
    return plane;
}

/// sum + rest, |rest| at most half of sum's last bit, rounded.
inline float rounded(double sum, double rest, const FilterBits& bits) {
    if (sum == 0.0)
        return static_cast<float>(sum);
    const double size = std::fabs(sum),
                 last = std::ldexp(1.0, std::max(std::ilogb(size) + 1 - bits.result, bits.least_exponent));
    const double cut = std::floor(size / last) * last, behind = 2.0 * (size - cut);
    const bool beyond = behind > last || (behind == last && !(std::signbit(rest) != std::signbit(sum) && rest != 0.0));
    return static_cast<float>(std::copysign(beyond ? cut + last : cut, sum));
}

} // namespace aligned_filter

/// The least and the greatest of what a cell's texels, all of them finite, are known to give: how many bits of a plane
/// are kept below the other's was not found to the last one.
inline std::pair<float, float> aligned_sum(const FilterCell& cell, const std::array<int, 8>& weights,
                                           const FilterBits& bits) {
    using namespace aligned_filter;
    const Plane near = plane_of(cell, weights, 0, bits.texel), far = plane_of(cell, weights, 4, bits.texel);
    if (near.sum == 0.0 || far.sum == 0.0) {
        const Plane& one = near.sum == 0.0 ? far : near;
        const float value = rounded(std::ldexp(one.sum, one.exponent - bits.texel - 8), 0.0, bits);
        return {value, value};
    }
    const Plane& coarse = near.exponent < far.exponent ? far : near;
    const Plane& fine = near.exponent < far.exponent ? near : far;
    const double a = std::ldexp(coarse.sum, coarse.exponent - bits.texel - 8),
                 b = std::ldexp(fine.sum, fine.exponent - bits.texel - 8);
    const double sum = a + b, of_b = sum - a, rest = (a - (sum - of_b)) + (b - of_b);
    const float kept = rounded(sum, rest, bits);
    const double floored = coarse.sum + std::floor(std::ldexp(fine.sum, fine.exponent - coarse.exponent));
    const float cut = rounded(std::ldexp(floored, coarse.exponent - bits.texel - 8), 0.0, bits);
    return std::minmax({kept, cut});
}

} // namespace lockstep
