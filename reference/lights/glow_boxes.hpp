#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "reference/lights/made_on_asking.hpp"
#include "reference/lights/wrong_drawing.hpp"
#include "reference/model/lights/host.hpp"
#include "reference/model/lights/schema.hpp"
#include "reference/system/pixel_boxes.hpp"

namespace lockstep::lights {

/// How glows are drawn, by mistake.
struct GlowDrawing {
    enum class Size : std::uint8_t { right, doubled, not_divided };
    static constexpr std::size_t sizes = 3;
    WrongDrawing matrix = WrongDrawing::none;
    Size size = Size::right;
};
GlowDrawing glow_drawing(std::span<const Mistake> made);

/// Of each glow of a state the pixels that it may cover: what lies outside is not tried.
BoxesByTile glow_boxes(const Host& host, const SystemView& state, const GlowDrawing& how = {});

class GlowBoxes {
  public:
    [[nodiscard]] const BoxesByTile& of(const GlowDrawing& how, const Host& host, const SystemView& state) const {
        return by_drawing_.of(index_of(how.matrix) * GlowDrawing::sizes + static_cast<std::size_t>(how.size),
                              [&] { return glow_boxes(host, state, how); });
    }

  private:
    MadeOnAsking<BoxesByTile, wrong_drawings * GlowDrawing::sizes> by_drawing_;
};

} // namespace lockstep::lights
