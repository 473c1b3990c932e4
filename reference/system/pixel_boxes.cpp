#include "reference/system/pixel_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reference/parallel_blocks.hpp"

namespace lockstep {
namespace {

bool is_empty(const PixelRect& box) { return box.x0 >= box.x1 || box.y0 >= box.y1; }

/// Calls `visit` with every tile that a box touches.
template <class Visit> void for_each_tile(const PixelRect& box, std::size_t columns, const Visit& visit) {
    constexpr int width = BoxesByTile::tile_width, height = BoxesByTile::tile_height;
    if (is_empty(box))
        return;
    for (int y = box.y0 / height; y <= (box.y1 - 1) / height; ++y)
        for (int x = box.x0 / width; x <= (box.x1 - 1) / width; ++x)
            visit(static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x));
}

} // namespace

PixelRect RoughWindow::box(const glm::dvec2& low, const glm::dvec2& high) const {
    if (!std::isfinite(low.x + low.y + high.x + high.y))
        return {};
    const auto clamped = [](double at, int size) { return static_cast<int>(std::clamp(at, 0.0, double(size))); };
    return {clamped(std::floor(low.x - room), width), clamped(std::floor(low.y - room), height),
            clamped(std::ceil(high.x + room), width), clamped(std::ceil(high.y + room), height)};
}

std::vector<PixelRect> triangle_boxes(const RoughWindow& window, const SystemView& state, FieldId corners) {
    std::vector<PixelRect> all;
    for (std::size_t t = 0; t < state[corners.resource].count() / 3; ++t) {
        constexpr double far = 1e9;
        glm::dvec2 low(far), high(-far);
        bool behind = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec4 clip = window.clip(state.vec3(corners, 3 * t + k));
            behind = behind || !(clip.w > 1e-3);
            const glm::dvec2 at = window.place(clip);
            low = {std::min(low.x, at.x), std::min(low.y, at.y)};
            high = {std::max(high.x, at.x), std::max(high.y, at.y)};
        }
        all.push_back(behind ? window.all() : window.box(low, high));
    }
    return all;
}

BoxesByTile::BoxesByTile(std::vector<PixelRect> boxes, int width, int height)
    : boxes_(std::move(boxes)), width_(width), height_(height),
      columns_(static_cast<std::size_t>((width + tile_width - 1) / tile_width)),
      starts_(columns_ * static_cast<std::size_t>((height + tile_height - 1) / tile_height) + 1) {
    // A counting sort by parts of the boxes: where each part's numbers of a tile begin depends on the boxes alone.
    constexpr std::size_t most_parts = 16, boxes_of_part = 4096;
    const std::size_t tiles = starts_.size() - 1,
                      parts = std::clamp(boxes_.size() / boxes_of_part, std::size_t{1}, most_parts);
    std::vector<std::size_t> places(parts * tiles);
    const auto for_each_part = [&](const auto& visit) {
        parallel_blocks(static_cast<std::ptrdiff_t>(parts), [&](std::ptrdiff_t which) {
            const auto part = static_cast<std::size_t>(which);
            std::size_t* const of_part = &places[part * tiles];
            for (std::size_t i = part * boxes_.size() / parts; i < (part + 1) * boxes_.size() / parts; ++i)
                for_each_tile(boxes_[i], columns_, [&](std::size_t tile) { visit(i, of_part[tile]); });
        });
    };
    for_each_part([](std::size_t, std::size_t& count) { ++count; });
    std::size_t total = 0;
    for (std::size_t tile = 0; tile < tiles; ++tile) {
        for (std::size_t part = 0; part < parts; ++part) {
            std::size_t& place = places[part * tiles + tile];
            total += std::exchange(place, total);
        }
        starts_[tile + 1] = total;
    }
    numbers_.resize(total);
    for_each_part([&](std::size_t i, std::size_t& place) { numbers_[place++] = static_cast<std::uint32_t>(i); });
}

} // namespace lockstep
