#pragma once
#include <cmath>

namespace lockstep {

/// How right a window coordinate (clip / w) * half + half is: the error of each operation, relative to its result.
struct WindowAccuracy {
    double ndc, scaled, sum;

    /// Pixels by which it may err at `window`.
    [[nodiscard]] double error(double window, double half) const {
        const double scaled_error = std::abs(window - half) * ((1.0 + ndc) * (1.0 + scaled) - 1.0);
        return scaled_error + (std::abs(window) + scaled_error) * sum;
    }
};

/// All that GL says of fixed function: "about 1 part in 10^5" (GL 4.5, 2.3.4.1).
inline constexpr WindowAccuracy gl_window_accuracy{1e-5, 1e-5, 1e-5};

/// What a shader's own operations would give (GLSL 4.50.7, 4.7.1): 1 / w right to 2.5 ULP, each product and the sum to
/// 1, whatever the rounding mode and the order of the factors. An ULP is at most 2^-23 of a value.
inline constexpr WindowAccuracy glsl_window_accuracy{3.5 * 0x1p-23, 0x1p-23, 0x1p-23};

} // namespace lockstep
