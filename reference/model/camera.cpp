#include "reference/model/camera.hpp"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

namespace lockstep {
namespace {

glm::dmat4 view(const Camera& camera) {
    return glm::lookAt(glm::dvec3(camera.eye), glm::dvec3(camera.target), glm::dvec3(camera.up));
}

glm::dmat4 projection(const Camera& camera, float aspect) {
    return glm::perspective(glm::radians(static_cast<double>(camera.fov_y)), static_cast<double>(aspect),
                            static_cast<double>(camera.near_plane), static_cast<double>(camera.far_plane));
}

} // namespace

glm::mat4 view_matrix(const Camera& camera) { return glm::mat4(view(camera)); }

glm::mat4 projection_matrix(const Camera& camera, float aspect) { return glm::mat4(projection(camera, aspect)); }

glm::mat4 view_projection_matrix(const Camera& camera, float aspect) {
    return glm::mat4(projection(camera, aspect) * view(camera));
}

Camera camera_at(const Camera& camera, const std::vector<CameraKey>& keys, int frame) {
    if (keys.empty())
        return camera;
    Camera moved = camera;
    const auto after = std::find_if(keys.begin(), keys.end(), [&](const CameraKey& key) { return key.frame > frame; });
    const CameraKey& to = after == keys.end() ? keys.back() : *after;
    const CameraKey& from = after == keys.begin() ? keys.front() : *(after - 1);
    const double span = to.frame - from.frame;
    const double t = span > 0.0 ? std::clamp((frame - from.frame) / span, 0.0, 1.0) : 0.0;
    moved.eye = glm::vec3(glm::mix(glm::dvec3(from.eye), glm::dvec3(to.eye), t));
    moved.target = glm::vec3(glm::mix(glm::dvec3(from.target), glm::dvec3(to.target), t));
    return moved;
}

Camera turned_aside(const Camera& camera) {
    const glm::dvec3 up = glm::normalize(glm::dvec3(camera.up));
    const glm::dvec3 offset = glm::dvec3(camera.eye) - glm::dvec3(camera.target);
    Camera turned = camera;
    turned.eye = glm::vec3(glm::dvec3(camera.target) + glm::dot(offset, up) * up + glm::cross(up, offset));
    return turned;
}

} // namespace lockstep
