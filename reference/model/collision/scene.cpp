#include "reference/model/collision/scene.hpp"

namespace lockstep {

FrameParams frame_params(const Scene& scene, int frame) {
    const Camera render = camera_at(scene.camera, scene.camera_path, frame);
    Camera collision = scene.collision_camera;
    if (scene.switches.cdt_camera == CdtCamera::moving) {
        const glm::vec3 offset(0.0F, 0.0F, scene.switches.cdt_camera_offset);
        collision = render;
        collision.eye += offset;
        collision.target += offset;
    }
    const auto aspect = [](int width, int height) { return static_cast<float>(width) / static_cast<float>(height); };
    FrameParams params;
    params.collision_proj_view = view_projection_matrix(collision, aspect(scene.width, scene.height));
    params.second_proj_view = view_projection_matrix(turned_aside(collision), aspect(scene.width, scene.height));
    params.render_view = view_matrix(render);
    params.render_projection = projection_matrix(render, aspect(scene.render_width, scene.render_height));
    params.width = scene.width;
    params.height = scene.height;
    params.render_width = scene.render_width;
    params.render_height = scene.render_height;
    params.cdt_box = scene.cdt_box;
    params.constants = scene.constants;
    params.switches = scene.switches;
    return params;
}

} // namespace lockstep
