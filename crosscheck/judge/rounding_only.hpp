#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace lockstep {

/// By how many ULP of a vector's greatest component the same value may differ that is written in another way: GLSL's
/// 12 of length (4.7.1, as the Vulkan environment derives it), two products and a sum.
inline constexpr float rewritten_ulps = 16.0F;

/// The same of a sum over a window, whose terms may cancel.
inline constexpr float summed_ulps = 64.0F * rewritten_ulps;

/// Whether two values of a field, a vector or one number, differ by rounding alone; what is infinite or NaN on one side
/// is so on the other. `before`: what the item had; a step from there rounds as that does.
inline bool differ_by_rounding(std::span<const float> a, std::span<const float> b, std::span<const float> before,
                               float ulps = rewritten_ulps) {
    float scale = 0.0F;
    for (const std::span<const float> values : {a, b, before})
        for (const float x : values)
            if (std::isfinite(x))
                scale = std::max(scale, std::abs(x));
    for (std::size_t c = 0; c < a.size(); ++c)
        if (!(std::isfinite(a[c]) && std::isfinite(b[c]) && std::abs(a[c] - b[c]) <= scale * (ulps * 0x1p-23F)) &&
            !(std::isnan(a[c]) && std::isnan(b[c])) && a[c] != b[c])
            return false;
    return true;
}

} // namespace lockstep
