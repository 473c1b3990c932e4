#include "reference/fluid/filtered_image.hpp"

#include <cstdint>
#include <cstring>
#include <vector>

#include "reference/fluid/linear_laws.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep::fluid {
namespace {

using linear_laws::fused;

/// A row of pixels and what lies beyond it, from two rows of texels: linear_laws::mixed, fused.
struct FilteredRow {
    const PixelAxis& x;
    const float *lower, *upper;
    float above; ///< the share of the upper row
    int beyond, beyond_end;
    float* pixels;
};

LOCKSTEP_VECTOR_CLONES void make(const FilteredRow& row) {
    const auto width = static_cast<std::ptrdiff_t>(row.x.f.size());
    const float *f = row.x.f.data(), *lower = row.lower, *upper = row.upper;
    const std::int32_t* base = row.x.base.data();
    const float above = row.above;
    float* pixels = row.pixels;
    const auto pixel = [&](std::ptrdiff_t first, std::ptrdiff_t second, float share) {
        return fused(fused(lower[first], lower[second], share), fused(upper[first], upper[second], share), above);
    };
    LOCKSTEP_VECTOR_LOOP
    for (std::ptrdiff_t i = 1; i < width - 1; ++i) {
        const bool is_before = base[i] < i;
        const auto along = [&](const float* texels) {
            const float before = texels[i - 1], own = texels[i], behind = texels[i + 1];
            return fused(is_before ? before : own, is_before ? own : behind, f[i]);
        };
        pixels[i] = fused(along(lower), along(upper), above);
    }
    const std::ptrdiff_t end = width - 1;
    for (const std::ptrdiff_t i : {std::ptrdiff_t{0}, end})
        pixels[i] = pixel(std::max<std::ptrdiff_t>(base[i], 0), std::min<std::ptrdiff_t>(base[i] + 1, end), f[i]);
    std::fill_n(pixels - row.beyond, row.beyond, pixel(0, 0, 0.0F));
    std::fill_n(pixels + width, row.beyond_end, pixel(end, end, 0.0F));
}

} // namespace

FilteredImage::FilteredImage(const Settings& settings, FieldId from, int reach)
    : from_(from), width_(settings.width), height_(settings.height), reach_(reach),
      stride_(reach + width_ + beyond_end()) {}

void FilteredImage::make_around(const SystemView& state, int first, int last) const {
    std::call_once(begun_, [this] {
        places_ = PixelPlaces{PixelAxis(width_), PixelAxis(height_)};
        const auto rows = static_cast<std::size_t>(height_ + 2);
        pixels_ = std::make_unique_for_overwrite<float[]>(rows * static_cast<std::size_t>(stride_));
        made_ = std::make_unique<std::once_flag[]>(rows);
    });
    for (int y = std::max(first - reach_, -1); y <= std::min(last + reach_, height_); ++y)
        std::call_once(made_[static_cast<std::size_t>(y + 1)],
                       [&] { make_row(state[from_.resource].columns[from_.field], y); });
}

void FilteredImage::make_row(const std::byte* texels, int y) const {
    const auto texel_row = [&](int at) {
        std::vector<float> row(static_cast<std::size_t>(width_));
        const auto before = static_cast<std::size_t>(std::clamp(at, 0, height_ - 1)) * row.size();
        std::memcpy(row.data(), texels + before * sizeof(float), row.size() * sizeof(float));
        return row;
    };
    const bool is_inside = y >= 0 && y < height_;
    const int base = is_inside ? places_->y.base[static_cast<std::size_t>(y)] : y;
    const std::vector<float> lower = texel_row(base), upper = texel_row(base + 1);
    make({places_->x, lower.data(), upper.data(), is_inside ? places_->y.f[static_cast<std::size_t>(y)] : 0.0F, reach_,
          beyond_end(), row(y)});
}

std::shared_ptr<const FilteredImage> filtered_image(const Host& host, FieldId from, int reach) {
    if (host.switches().depth_fetch != DepthFetch::linear || host.linear_filter() == LinearFilter::aligned)
        return nullptr;
    return std::make_shared<const FilteredImage>(host.settings(), from, reach);
}

} // namespace lockstep::fluid
