#include "reference/lights/surface.hpp"

#include <utility>
#include <vector>

namespace lockstep::lights {
std::shared_ptr<const LatestTriangles> obstacle_triangles(const Host& host) {
    const Settings& s = host.settings();
    return std::make_shared<const LatestTriangles>(
        TriangleCamera{field::corner_position, host.view_projection(), s.width, s.height, s.arithmetic});
}

BoxesByTile glow_boxes(const Host& host, const SystemView& state) {
    const RoughWindow window{glm::dmat4(host.view_projection()), host.settings().width, host.settings().height};
    std::vector<PixelRect> all;
    for (std::size_t i = 0; i < state[light_buffer].count(); ++i) {
        const glm::dvec4 clip = window.clip(state.vec3(field::light_position, i));
        const double radius = double{host.disc_scale()} / clip.w;
        all.push_back(clip.w > 0.0 ? window.disc(window.place(clip), radius) : PixelRect{});
    }
    return {std::move(all), window.width, window.height};
}

} // namespace lockstep::lights
