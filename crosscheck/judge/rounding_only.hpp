#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace lockstep {

/// By how many ULP of a vector's greatest component the same value may differ that is written in another way: GLSL's
/// 12 of length (4.7.1, as the Vulkan environment derives it), two products and a sum.
inline constexpr double rewritten_ulps = 16.0;

/// How far two values of a field, a vector or one number, are apart, in ULP of the greatest component of either and of
/// `before`, what the item had: a step from there rounds as that does. Infinite where one side alone is infinite or
/// NaN.
inline double ulps_apart(std::span<const float> a, std::span<const float> b, std::span<const float> before) {
    double scale = 0.0;
    for (const std::span<const float> values : {a, b, before})
        for (const float x : values)
            if (std::isfinite(x))
                scale = std::max(scale, std::abs(double{x}));
    double most = 0.0;
    for (std::size_t c = 0; c < a.size(); ++c) {
        if (a[c] == b[c] || (std::isnan(a[c]) && std::isnan(b[c])))
            continue;
        const bool both = std::isfinite(a[c]) && std::isfinite(b[c]);
        most = std::max(most, both ? std::abs(double{a[c]} - double{b[c]}) / (scale * 0x1p-23) : HUGE_VAL);
    }
    return most;
}

/// Whether two values differ by rounding alone.
inline bool differ_by_rounding(std::span<const float> a, std::span<const float> b, std::span<const float> before) {
    return ulps_apart(a, b, before) <= rewritten_ulps;
}

} // namespace lockstep
