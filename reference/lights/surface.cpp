#include "reference/lights/surface.hpp"

namespace lockstep::lights {

std::shared_ptr<const LatestTriangles> obstacle_triangles(const Host& host) {
    const Settings& s = host.settings();
    return std::make_shared<const LatestTriangles>(
        TriangleCamera{field::corner_position, host.view_projection(), s.width, s.height, s.arithmetic});
}

BoxesByTile obstacle_boxes(const Host& host, const SystemView& state, WrongDrawing how) {
    RoughWindow window{glm::dmat4(wrong_matrix(host, how)), host.settings().width, host.settings().height};
    if (how == WrongDrawing::whole_boxes)
        window.room = -0.4375; // shaders/pixel_box.glsl: from half a pixel and 1/16 before the first centre
    return {triangle_boxes(window, state, field::corner_position), window.width, window.height};
}

} // namespace lockstep::lights
