#include "reference/lights/glow_boxes.hpp"

#include <utility>
#include <vector>

#include "reference/lights/sites.hpp"

namespace lockstep::lights {

GlowDrawing glow_drawing(std::span<const Mistake> made) {
    GlowDrawing how{wrong_drawing(made)};
    for (const Mistake& mistake : made) {
        if (mistake.site == site::disc_scale.id && mistake.change == Change::doubled)
            how.size = GlowDrawing::Size::doubled;
        if (mistake.site == site::glow_radius.id && mistake.change == Change::not_done)
            how.size = GlowDrawing::Size::not_divided;
    }
    return how;
}

BoxesByTile glow_boxes(const Host& host, const SystemView& state, const GlowDrawing& how) {
    const RoughWindow window{glm::dmat4(wrong_matrix(host, how.matrix)), host.settings().width, host.settings().height};
    const double scale = double{host.disc_scale()} * (how.size == GlowDrawing::Size::doubled ? 2.0 : 1.0);
    std::vector<PixelRect> all;
    for (std::size_t i = 0; i < state[light_buffer].count(); ++i) {
        const glm::dvec4 clip = window.clip(state.vec3(field::light_position, i));
        const double radius = how.size == GlowDrawing::Size::not_divided ? scale : scale / clip.w;
        all.push_back(clip.w > 0.0 ? window.disc(window.place(clip), radius) : PixelRect{});
    }
    return {std::move(all), window.width, window.height};
}

} // namespace lockstep::lights
