#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/model/system_state.hpp"
#include "reference/window.hpp"

namespace lockstep {

/// A place of an image.
struct Pixel {
    int x = 0, y = 0;
    static Pixel of(int width, std::size_t item) {
        const auto row = static_cast<std::size_t>(width);
        return {static_cast<int>(item % row), static_cast<int>(item / row)};
    }
    [[nodiscard]] bool is_in(const PixelRect& box) const {
        return x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1;
    }
};

/// Where things are drawn: clip space over an image of width x height, in double. For what may be covered, not for what
/// is.
struct RoughWindow {
    glm::dmat4 to_clip{1.0};
    int width = 1, height = 1;
    double room = 2.0; ///< around what is drawn, pixels: more than passes' own boxes and rounding need

    [[nodiscard]] glm::dvec4 clip(const glm::vec3& p) const { return to_clip * glm::dvec4(glm::dvec3(p), 1.0); }
    [[nodiscard]] glm::dvec2 place(const glm::dvec4& clip) const {
        return {(clip.x / clip.w + 1.0) * 0.5 * width, (clip.y / clip.w + 1.0) * 0.5 * height};
    }
    /// The pixels of a rectangle of the window, with room around. Nothing where it is no number.
    [[nodiscard]] PixelRect box(const glm::dvec2& low, const glm::dvec2& high) const;
    [[nodiscard]] PixelRect disc(const glm::dvec2& centre, double radius) const {
        return box(centre - radius, centre + radius);
    }
    [[nodiscard]] PixelRect all() const { return {0, 0, width, height}; }
};

/// The pixels that each triangle may cover, three items of `corners` (vec3, m) each: all, if a part of it lies behind
/// the camera.
std::vector<PixelRect> triangle_boxes(const RoughWindow& window, const SystemView& state, FieldId corners);

/// Boxes by the pixels that they may have: what lies elsewhere is not tried.
class BoxesByTile {
  public:
    static constexpr int tile_width = 8, tile_height = 16; ///< pixels

    BoxesByTile() = default;
    BoxesByTile(std::vector<PixelRect> boxes, int width, int height);

    /// Those that touch the pixel's tile, by number, ascending.
    [[nodiscard]] std::span<const std::uint32_t> near(const Pixel& pixel) const {
        return of_tile(static_cast<std::size_t>(pixel.y / tile_height) * columns_ +
                       static_cast<std::size_t>(pixel.x / tile_width));
    }
    [[nodiscard]] std::size_t tiles() const { return starts_.empty() ? 0 : starts_.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> of_tile(std::size_t tile) const {
        return std::span(numbers_).subspan(starts_[tile], starts_[tile + 1] - starts_[tile]);
    }
    [[nodiscard]] const PixelRect& box(std::uint32_t i) const { return boxes_[i]; }

    [[nodiscard]] std::size_t rows() const { return columns_ == 0 ? 0 : tiles() / columns_; }

  private:
    std::vector<PixelRect> boxes_;
    int width_ = 0, height_ = 0;
    std::size_t columns_ = 0;
    std::vector<std::size_t> starts_; ///< of each tile in `numbers_`, and the end
    std::vector<std::uint32_t> numbers_;
};

} // namespace lockstep
