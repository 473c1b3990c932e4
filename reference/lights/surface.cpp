#include "reference/lights/surface.hpp"

#include <utility>
#include <vector>

namespace lockstep::lights {
namespace {

/// Whether no part of a triangle lies before the camera.
bool is_behind(const RoughWindow& window, const SystemView& state, std::size_t triangle) {
    constexpr double room = 1e-3;
    for (std::size_t k = 0; k < 3; ++k)
        if (window.clip(state.vec3(field::corner_position, 3 * triangle + k)).w > -room)
            return false;
    return true;
}

} // namespace

std::shared_ptr<const LatestTriangles> obstacle_triangles(const Host& host) {
    const Settings& s = host.settings();
    return std::make_shared<const LatestTriangles>(
        TriangleCamera{field::corner_position, host.view_projection(), s.width, s.height, s.arithmetic});
}

BoxesByTile obstacle_boxes(const Host& host, const SystemView& state, WrongDrawing how) {
    RoughWindow window{glm::dmat4(wrong_matrix(host, how)), host.settings().width, host.settings().height};
    if (how == WrongDrawing::whole_boxes)
        window.room = -0.4375; // shaders/pixel_box.glsl: from half a pixel and 1/16 before the first centre
    std::vector<PixelRect> boxes = triangle_boxes(window, state, field::corner_position);
    for (std::size_t t = 0; t < boxes.size(); ++t)
        if (is_behind(window, state, t))
            boxes[t] = {};
    return {std::move(boxes), window.width, window.height};
}

} // namespace lockstep::lights
