#include "reference/model/collision/scene.hpp"

#include <algorithm>
#include <vector>

#include <glm/matrix.hpp>

namespace lockstep {
namespace {

/// A matrix of a host, its first row at y / w = 1, in the clip space of one whose first row is at -1: the signs of y.
/// Every sum of it then has the other sign and no other bit.
glm::mat4 first_row_at_minus_one(glm::mat4 matrix, const ClipSpace& space) {
    if (space.first_row > 0.0F)
        for (int column = 0; column < 4; ++column)
            matrix[column].y = -matrix[column].y;
    return matrix;
}

/// Null before the first.
const FrameSettings* settings_at(const std::vector<FrameSettings>& frames, int frame) {
    const auto after = std::upper_bound(frames.begin(), frames.end(), frame,
                                        [](int at, const FrameSettings& settings) { return at < settings.frame; });
    return after == frames.begin() ? nullptr : &*(after - 1);
}

void take_settings(const FrameSettings& settings, const ClipSpace& space, FrameParams& params) {
    if (settings.proj_view)
        params.collision_proj_view = first_row_at_minus_one(*settings.proj_view, space);
    if (settings.second_proj_view)
        params.second_proj_view = first_row_at_minus_one(*settings.second_proj_view, space);
    params.constants = settings.constants;
    params.switches.speed_factor = settings.speed_factor;
}

/// Of one frame, without regard to the one before.
FrameParams params_of(const Scene& scene, int frame) {
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
    params.clip_depth = scene.clip_space.depth;
    if (const FrameSettings* settings = settings_at(scene.frames, frame))
        take_settings(*settings, scene.clip_space, params);
    return params;
}

} // namespace

FrameParams frame_params(const Scene& scene, int frame) {
    FrameParams params = params_of(scene, frame);
    if (scene.switches.search != Search::depth)
        return params;
    params.earlier_proj_view = params_of(scene, std::max(frame - 1, 0)).collision_proj_view;
    params.earlier_inverse = glm::mat4(glm::inverse(glm::dmat4(params.earlier_proj_view)));
    return params;
}

} // namespace lockstep
