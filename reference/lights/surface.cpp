#include "reference/lights/surface.hpp"

#include <vector>

namespace lockstep::lights {
namespace {

RoughWindow window_of(const Host& host) {
    return {glm::dmat4(host.view_projection()), host.settings().width, host.settings().height};
}

BoxesByTile by_tile(std::vector<PixelRect> boxes, const RoughWindow& window) {
    return {std::move(boxes), window.width, window.height};
}

} // namespace

BoxesByTile triangle_boxes(const Host& host, const SystemView& state) {
    const RoughWindow window = window_of(host);
    return by_tile(lockstep::triangle_boxes(window, state, field::corner_position), window);
}

BoxesByTile glow_boxes(const Host& host, const SystemView& state) {
    const RoughWindow window = window_of(host);
    std::vector<PixelRect> all;
    for (std::size_t i = 0; i < state[light_buffer].count(); ++i) {
        const glm::dvec4 clip = window.clip(state.vec3(field::light_position, i));
        const double radius = double{host.disc_scale()} / clip.w;
        all.push_back(clip.w > 0.0 ? window.disc(window.place(clip), radius) : PixelRect{});
    }
    return by_tile(std::move(all), window);
}

} // namespace lockstep::lights
