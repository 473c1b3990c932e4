#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "reference/fluid/sites.hpp"
#include "reference/readings/unspecified.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::fluid {

/// An image of one number a texel.
template <class Texel> struct Texels {
    int width, height;
    Texel texel; ///< texel(x, y) within the image: a float

    [[nodiscard]] float clamped(int x, int y) const {
        return texel(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1));
    }
    /// What weights of all bits give; `seen` is told of the four texels.
    template <class Seen> [[nodiscard]] double mean(double x, double y, const Seen& seen) const {
        const auto bx = static_cast<int>(std::floor(x)), by = static_cast<int>(std::floor(y));
        const double fx = x - bx, fy = y - by;
        const auto row = [&](int dy) {
            const double left = clamped(bx, by + dy), right = clamped(bx + 1, by + dy);
            seen(left);
            seen(right);
            return left * (1.0 - fx) + right * fx;
        };
        return row(0) * (1.0 - fy) + row(1) * fy;
    }
};

/// Where a coordinate may lie, in texels from the first one's middle.
struct FetchedAxis {
    double low, high;
    float f; ///< of the reference's own place
    int base;

    FetchedAxis(const Interval& set, double size) {
        const float t = set.as_float() - 0.5F;
        const double free = 0.6 / 256.0 + 1e-5 * (std::abs(set.low) + 0.5);
        // Beyond the image's edge all texels are alike; a coordinate that is no number may be anywhere.
        const auto near = [size](double texel, double open) {
            return std::isnan(texel) ? open : std::clamp(texel, -1.0, size);
        };
        low = near(set.low - 0.5 - free, -1.0);
        high = near(set.high - 0.5 + free, size);
        f = t - std::floor(t);
        base = static_cast<int>(near(std::floor(t), -1.0));
    }
    template <class Visit> void for_each_end(const Visit& visit) const {
        visit(low);
        for (double whole = std::ceil(low); whole < high; whole += 1.0)
            visit(whole);
        visit(high);
    }
};

/// What any unit may give whose places and weights have 8 fraction bits: places right to 1 part in 10^5
/// (GL 4.5, 2.3.4.1) and then to 0.6 of a 256th (D3D 11.3, 3.2.4.1); each of the three halvings of the four texels
/// rounded to a 256th; nothing beyond the least and the greatest of them (7.18.16.3); results right to 1 part in 10^5.
template <class Texel> Interval legal_fetch(const FetchedAxis& x, const FetchedAxis& y, const Texels<Texel>& image) {
    double low = HUGE_VAL, high = -HUGE_VAL, least = HUGE_VAL, greatest = -HUGE_VAL;
    bool are_finite = true;
    y.for_each_end([&](double v) {
        x.for_each_end([&](double u) {
            const double one = image.mean(u, v, [&](double texel) {
                are_finite = are_finite && std::isfinite(texel);
                least = std::min(least, texel);
                greatest = std::max(greatest, texel);
            });
            low = std::min(low, one);
            high = std::max(high, one);
        });
    });
    if (!are_finite)
        return {-HUGE_VAL, HUGE_VAL};
    const double halvings = 3.0 / 512.0 * (greatest - least);
    const double error = 1e-5 * std::max(std::abs(least), std::abs(greatest));
    return {std::max(low - halvings, least) - error, std::min(high + halvings, greatest) + error};
}

/// What the texture unit makes of the texels around a place, given in texels, GL_LINEAR: fma(f, b - a, a) along x, then
/// y (of lanes linear_lanes.hpp).
template <class R, class Texel>
typename R::Real linear_fetch(R& r, At at, const typename R::Vec2& place, const Texels<Texel>& image) {
    using Real = typename R::Real;
    const FetchedAxis x(item_twin::set_of(place.x), image.width), y(item_twin::set_of(place.y), image.height);
    const auto mixed = [](float from, float to, float share) { return std::fma(share, to - from, from); };
    const auto row = [&](int dy) {
        return mixed(image.clamped(x.base, y.base + dy), image.clamped(x.base + 1, y.base + dy), x.f);
    };
    const Real value(mixed(row(0), row(1), y.f));
    Interval legal{0.0F};
    if constexpr (requires { value.legal(); })
        legal = legal_fetch(x, y, image);
    return r.note(at, unspecified_within(r, at, value, legal));
}

} // namespace lockstep::fluid
