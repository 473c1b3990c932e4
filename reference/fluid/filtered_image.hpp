#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>

#include "reference/fluid/pixel_places.hpp"
#include "reference/model/system_state.hpp"
#include "reference/readings/lanes.hpp"

namespace lockstep::fluid {

/// An image of floats as GL_LINEAR gives it at the middles of pixels, weights of all bits: for lanes, which read each
/// of its pixels many times. Its rows are made when they are first asked for, by all threads that ask.
class FilteredImage {
  public:
    /// `from`: the image that is filtered. `reach`: pixels on each side of one that are read.
    FilteredImage(const Settings& settings, FieldId from, int reach);

    /// For who makes the pixels of rows first to last, the last included: `state` is the same in every call.
    void make_around(const SystemView& state, int first, int last) const;

    /// The pixels at x and behind it, in rows that are made; beyond the image those at its edge.
    [[nodiscard]] FloatLanes at(int x, int y) const {
        return lanes::loaded<FloatLanes>(row(std::clamp(y, -1, height_)) + x);
    }

  private:
    /// Of its pixel 0.
    [[nodiscard]] float* row(int y) const {
        return pixels_.get() + static_cast<std::ptrdiff_t>(y + 1) * stride_ + reach_;
    }
    [[nodiscard]] int beyond_end() const { return reach_ + lane_count; }
    void make_row(const std::byte* texels, int y) const;

    FieldId from_;
    int width_, height_, reach_, stride_;
    mutable std::once_flag begun_;
    mutable std::optional<PixelPlaces> places_;
    mutable std::unique_ptr<float[]> pixels_;
    mutable std::unique_ptr<std::once_flag[]> made_; ///< rows -1 to height
};

/// What lanes of a pass read that fetches each pixel up to `reach` aside; null where they fetch texels.
std::shared_ptr<const FilteredImage> filtered_image(const Host& host, FieldId from, int reach);

} // namespace lockstep::fluid
