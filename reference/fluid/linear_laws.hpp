#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "reference/aligned_filter.hpp"
#include "reference/interval.hpp"
#include "reference/model/fluid/host.hpp"

namespace lockstep::fluid {

/// An image of one number a texel.
template <class Texel> struct Texels {
    int width, height;
    Texel texel; ///< texel(x, y) within the image: a float

    [[nodiscard]] float clamped(int x, int y) const {
        return texel(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1));
    }
    /// What weights of all bits give at a place in texels from the first one's middle; `seen` is told of the four
    /// texels.
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

/// Where a coordinate of a texture may lie, 0 to 1 over `size` texels; a float where `set` is a point.
struct FetchedAxis {
    Interval set;
    int size;

    /// In texels from the first one's middle, as a float.
    struct Place {
        float f; ///< behind the texel
        int base;
    };
    [[nodiscard]] Place place() const {
        const float t = set.as_float() * static_cast<float>(size) - 0.5F, whole = std::floor(t);
        return {t - whole, static_cast<int>(within(whole, -1.0))};
    }
    /// Calls `visit` with the ends of the places, `error` texels wider, and with all whole ones between.
    template <class Visit> void for_each_end(double error, const Visit& visit) const {
        const double low = within(set.low * size - 0.5 - error, -1.0),
                     high = within(set.high * size - 0.5 + error, size);
        visit(low);
        for (double whole = std::floor(low) + 1.0; whole < high; whole += 1.0)
            visit(whole);
        visit(high);
    }
    /// In 256ths of a texel, of one end of the set, as aligned_filter.hpp has them.
    [[nodiscard]] double aligned(double end) const {
        return std::clamp(filter_place(end, size), 0.0, 256.0 * (size - 1));
    }

  private:
    /// Beyond the image's edge all texels are alike; a coordinate that is no number may be anywhere.
    [[nodiscard]] double within(double texel, double open) const {
        return std::isnan(texel) ? open : std::clamp<double>(texel, -1.0, size);
    }
};

namespace linear_laws {

/// Of means at the ends of sets.
struct Hull {
    double low = HUGE_VAL, high = -HUGE_VAL, least = HUGE_VAL, greatest = -HUGE_VAL; ///< of the means, of the texels
    bool are_finite = true;

    [[nodiscard]] double step() const { return greatest - least; }
    [[nodiscard]] double largest() const { return std::max(std::abs(least), std::abs(greatest)); }
};

template <class Texel>
Hull hull_of(const FetchedAxis& x, const FetchedAxis& y, double error_x, double error_y, const Texels<Texel>& image) {
    Hull hull;
    y.for_each_end(error_y, [&](double v) {
        x.for_each_end(error_x, [&](double u) {
            const double one = image.mean(u, v, [&](double texel) {
                hull.are_finite = hull.are_finite && std::isfinite(texel);
                hull.least = std::min(hull.least, texel);
                hull.greatest = std::max(hull.greatest, texel);
            });
            hull.low = std::min(hull.low, one);
            hull.high = std::max(hull.high, one);
        });
    });
    return hull;
}

inline constexpr auto fused = [](float a, float b, float f) { return std::fma(f, b - a, a); };
inline constexpr auto lerped = [](float a, float b, float f) { return a + f * (b - a); };

template <class Texel, class Mix>
float mixed(const FetchedAxis& x, const FetchedAxis& y, const Texels<Texel>& image, const Mix& mix) {
    const FetchedAxis::Place px = x.place(), py = y.place();
    const auto row = [&](int dy) {
        return mix(image.clamped(px.base, py.base + dy), image.clamped(px.base + 1, py.base + dy), px.f);
    };
    return mix(row(0), row(1), py.f);
}

/// Weights of all bits, in either of the forms that leave texels alone where they are alike. Of one place, what these
/// give; else what lies between the ends, each form's two levels being of three roundings of at most the step between
/// texels, and one of the result.
template <class Texel> Interval all_bits(const FetchedAxis& x, const FetchedAxis& y, const Texels<Texel>& image) {
    if (x.set.is_point() && y.set.is_point()) {
        const auto [low, high] = std::minmax({mixed(x, y, image, fused), mixed(x, y, image, lerped)});
        return std::isfinite(low) && std::isfinite(high) ? Interval(low, high) : Interval(-HUGE_VAL, HUGE_VAL);
    }
    const auto rounded = [](const FetchedAxis& axis) { return 0x1p-23 * (axis.size + 1); };
    const Hull hull = hull_of(x, y, rounded(x), rounded(y), image);
    if (!hull.are_finite)
        return {-HUGE_VAL, HUGE_VAL};
    if (hull.step() == 0.0)
        return {hull.least, hull.least};
    const double error = 0x1p-24 * (6.0 * hull.step() + 3.0 * hull.largest());
    return {hull.low - error, hull.high + error};
}

/// What an aligned unit makes of the cell at a place of 256ths.
template <class Texel> std::pair<float, float> aligned_at(double x, double y, const Texels<Texel>& image) {
    const auto base_x = static_cast<int>(std::floor(x / 256.0)), base_y = static_cast<int>(std::floor(y / 256.0));
    const int behind_x = static_cast<int>(x) - 256 * base_x, behind_y = static_cast<int>(y) - 256 * base_y;
    if (behind_x == 0 && behind_y == 0) {
        const float texel = image.clamped(base_x, base_y);
        return {texel, texel};
    }
    FilterCell cell{};
    for (int k = 0; k < 4; ++k)
        cell[static_cast<std::size_t>(k)] = image.clamped(base_x + k % 2, base_y + k / 2);
    if (!std::all_of(cell.begin(), cell.end(), [](float texel) { return std::isfinite(texel); }))
        return {-HUGE_VALF, HUGE_VALF}; // what weighs nothing may make it no number (D3D 11.3, 7.18.16.2)
    return aligned_sum(cell, filter_weights({behind_x, behind_y, 0}), float_filter_bits);
}

/// What any unit may give whose places and weights have 8 fraction bits: places right to 1 part in 10^5
/// (GL 4.5, 2.3.4.1), of coordinates that may be cut to 2^-21, and then to 0.6 of a 256th (D3D 11.3, 3.2.4.1); each of
/// the three halvings of the four texels rounded to a 256th; nothing beyond the least and the greatest of them
/// (7.18.16.3); results right to 1 part in 10^5.
template <class Texel> Interval eight_bits(const FetchedAxis& x, const FetchedAxis& y, const Texels<Texel>& image) {
    const auto free = [](const FetchedAxis& axis) {
        return 0.6 / 256.0 + axis.size * 0x1p-21 + 1e-5 * std::abs(axis.set.low * axis.size);
    };
    const Hull hull = hull_of(x, y, free(x), free(y), image);
    if (!hull.are_finite)
        return {-HUGE_VAL, HUGE_VAL};
    const double halvings = 3.0 / 512.0 * hull.step(), error = 1e-5 * hull.largest();
    return {std::max(hull.low - halvings, hull.least) - error, std::min(hull.high + halvings, hull.greatest) + error};
}

/// In fixed point, all places that the coordinates may be rounded to; what any unit may give where these are many.
template <class Texel> Interval aligned(const FetchedAxis& x, const FetchedAxis& y, const Texels<Texel>& image) {
    constexpr double most = 64.0;
    const double left = x.aligned(x.set.low), right = x.aligned(x.set.high), lower = y.aligned(y.set.low),
                 upper = y.aligned(y.set.high);
    if (!((right - left + 1.0) * (upper - lower + 1.0) <= most)) // or no number
        return eight_bits(x, y, image);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (double v = lower; v <= upper; v += 1.0)
        for (double u = left; u <= right; u += 1.0) {
            const auto [least, most_of] = aligned_at(u, v, image);
            low = std::min<double>(low, least);
            high = std::max<double>(high, most_of);
        }
    return {low, high};
}

} // namespace linear_laws

/// What a fetch may give.
template <class Texel>
Interval legal_fetch(LinearFilter filter, const FetchedAxis& x, const FetchedAxis& y, const Texels<Texel>& image) {
    using namespace linear_laws;
    switch (filter) {
    case LinearFilter::all_bits:
        return all_bits(x, y, image);
    case LinearFilter::aligned:
        return aligned(x, y, image);
    case LinearFilter::open:
        break;
    }
    return eight_bits(x, y, image);
}

/// What the reference makes of the sets' first places: in fixed point where the unit is known to work so, no number of
/// no number; else fma(f, b - a, a) along x, then y.
template <class Texel>
float fetched(LinearFilter filter, const FetchedAxis& x, const FetchedAxis& y, const Texels<Texel>& image) {
    using namespace linear_laws;
    if (filter != LinearFilter::aligned)
        return mixed(x, y, image, fused);
    const double u = x.aligned(x.set.low), v = y.aligned(y.set.low);
    const float value = std::isnan(u) || std::isnan(v) ? NAN : aligned_at(u, v, image).first;
    return std::isfinite(value) ? value : NAN;
}

} // namespace lockstep::fluid
