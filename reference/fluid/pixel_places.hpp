#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ranges>
#include <vector>

#include "reference/aligned_filter.hpp"
#include "reference/model/fluid/host.hpp"

namespace lockstep::fluid {

/// Where GL_LINEAR finds the middles of pixels along an axis: beside those of their texels, by what the shader's
/// quotient by the image's size, and its product with it, leave. A pixel's value is fma(f, next - texel, texel) of the
/// texel at `base`, its own or the one before.
struct PixelAxis {
    std::vector<float> f;
    std::vector<std::int32_t> base;

    /// In every arithmetic, as no number here is tiny.
    explicit PixelAxis(int size) {
        for (int i = 0; i < size; ++i) {
            const auto extent = static_cast<float>(size);
            const float middle = (static_cast<float>(i) + 0.5F) / extent * extent;
            const float place = middle - 0.5F, whole = std::floor(place);
            f.push_back(place - whole);
            base.push_back(static_cast<std::int32_t>(whole));
        }
    }
};

struct PixelPlaces {
    PixelAxis x, y;
};

/// Whether a unit that filters in fixed point gives each pixel its own texel at its middle: so it is up to some
/// thousand pixels.
inline bool middles_are_texels(int size) {
    return std::ranges::all_of(std::views::iota(0, size), [size](int i) {
        return filter_place((static_cast<float>(i) + 0.5F) / static_cast<float>(size), size) == 256.0 * i;
    });
}

/// Whether lanes give what one item gives: of a unit that filters in fixed point only where nothing is filtered.
inline bool lanes_filter(const Host& host, bool between_texels = false) {
    const Settings& s = host.settings();
    return host.linear_filter() != LinearFilter::aligned ||
           (!between_texels && middles_are_texels(s.width) && middles_are_texels(s.height));
}

} // namespace lockstep::fluid
