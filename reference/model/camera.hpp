#pragma once
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace lockstep {

/// A perspective camera. Clip space as in GL: -w <= x, y, z <= w.
struct Camera {
    glm::vec3 eye{0.0F, 0.0F, 3.0F};
    glm::vec3 target{0.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    float fov_y = 45.0F;     ///< degrees
    float near_plane = 0.1F; ///< world units, > 0
    float far_plane = 10.0F; ///< world units, > near_plane
};

/// Where a moving camera is from a frame on; between two keys eye and target are interpolated linearly.
struct CameraKey {
    int frame = 0;
    glm::vec3 eye{0.0F};
    glm::vec3 target{0.0F};
};

/// World to view space. Computed in double and rounded once, so that both sides get the same bits.
glm::mat4 view_matrix(const Camera& camera);

/// View to clip space. `aspect`: width / height.
glm::mat4 projection_matrix(const Camera& camera, float aspect);

/// World to clip space, the thesis's u_ProjView.
glm::mat4 view_projection_matrix(const Camera& camera, float aspect);

/// `camera` moved along `keys` (sorted by frame) to where it is at `frame`. No keys: unchanged.
Camera camera_at(const Camera& camera, const std::vector<CameraKey>& keys, int frame);

/// `camera` turned by a right angle round its target, about its up axis. Computed in double and rounded once.
Camera turned_aside(const Camera& camera);

} // namespace lockstep
