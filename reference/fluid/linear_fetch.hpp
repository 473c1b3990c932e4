#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "reference/fluid/sites.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::fluid {

/// An image of one number a texel.
template <class Texel> struct Texels {
    int width, height;
    Texel texel; ///< texel(x, y) within the image: a float

    [[nodiscard]] float clamped(int x, int y) const {
        return texel(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1));
    }
    [[nodiscard]] double mean(double x, double y) const {
        const auto bx = static_cast<int>(std::floor(x)), by = static_cast<int>(std::floor(y));
        const double fx = x - bx, fy = y - by;
        const auto row = [&](int dy) {
            return clamped(bx, by + dy) * (1.0 - fx) + double{clamped(bx + 1, by + dy)} * fx;
        };
        return row(0) * (1.0 - fy) + row(1) * fy;
    }
};

/// What the texture unit makes of the texels around a place, given in texels, GL_LINEAR: fma(f, b - a, a) along x, then
/// y. Legal is what weights of 8 fraction bits give, cut or rounded, at a coordinate that is right to 1 part in 10^5,
/// with results right to that (GL 4.5, 2.3.4.1).
template <class R, class Texel>
typename R::Real linear_fetch(R& r, At at, const typename R::Vec2& place, const Texels<Texel>& image) {
    struct Axis {
        double low, high; ///< where the coordinate may lie
        float f;          ///< of the reference's own
        int base;
    };
    const auto along = [](const Interval& set, double size) {
        const float t = set.as_float() - 0.5F;
        const double free = 0x1p-8 + 1e-5 * (std::abs(set.low) + 0.5);
        // Beyond the image's edge all texels are alike; a coordinate that is no number may be anywhere.
        const auto near = [size](double texel, double open) {
            return std::isnan(texel) ? open : std::clamp(texel, -1.0, size);
        };
        return Axis{near(set.low - 0.5 - free, -1.0), near(set.high - 0.5 + free, size), t - std::floor(t),
                    static_cast<int>(near(std::floor(t), -1.0))};
    };
    const Axis x = along(item_twin::set_of(place.x), image.width), y = along(item_twin::set_of(place.y), image.height);
    double low = HUGE_VAL, high = -HUGE_VAL, largest = 0.0;
    const auto for_each = [](const Axis& axis, const auto& visit) {
        visit(axis.low);
        for (double whole = std::ceil(axis.low); whole < axis.high; whole += 1.0)
            visit(whole);
        visit(axis.high);
    };
    for_each(y, [&](double v) {
        for_each(x, [&](double u) {
            const double one = image.mean(u, v);
            low = std::min(low, one);
            high = std::max(high, one);
            largest = std::max(largest, std::abs(one));
        });
    });
    const auto mixed = [](float from, float to, float share) { return std::fma(share, to - from, from); };
    const auto row = [&](int dy) {
        return mixed(image.clamped(x.base, y.base + dy), image.clamped(x.base + 1, y.base + dy), x.f);
    };
    const double error = 1e-5 * largest;
    return r.note(at, r.unspecified(at, typename R::Real(mixed(row(0), row(1), y.f)), static_cast<float>(low - error),
                                    static_cast<float>(high + error)));
}

} // namespace lockstep::fluid
