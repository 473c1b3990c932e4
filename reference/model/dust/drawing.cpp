#include "reference/model/dust/drawing.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "reference/model/dust/schema.hpp"

namespace lockstep::dust {
namespace {

constexpr std::array<glm::vec3, 4> quad_corners{
    {{-0.5F, -0.5F, 0.0F}, {0.5F, -0.5F, 0.0F}, {-0.5F, 0.5F, 0.0F}, {0.5F, 0.5F, 0.0F}}};
constexpr std::array<std::uint32_t, 6> quad_triangles{0, 1, 2, 2, 1, 3};

constexpr std::array<glm::vec3, 8> cube_corners{{{-0.5F, -0.5F, -0.5F},
                                                 {0.5F, -0.5F, -0.5F},
                                                 {-0.5F, 0.5F, -0.5F},
                                                 {0.5F, 0.5F, -0.5F},
                                                 {-0.5F, -0.5F, 0.5F},
                                                 {0.5F, -0.5F, 0.5F},
                                                 {-0.5F, 0.5F, 0.5F},
                                                 {0.5F, 0.5F, 0.5F}}};
constexpr std::array<std::uint32_t, 36> cube_triangles{0, 2, 1, 1, 2, 3, 4, 5, 6, 6, 5, 7, 0, 1, 4, 4, 1, 5,
                                                       2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 5, 3, 7};

} // namespace

const Schema& drawn_schema() {
    static const Schema all = [] {
        Schema drawn = schema();
        drawn.resources.push_back({.name = "corners",
                                   .item = "corner",
                                   .title = "the corners",
                                   .fields = {{.name = "clip", .components = 4},
                                              {.name = "tint", .components = 3},
                                              {.name = "drawn", .scalar = Scalar::int32},
                                              {.name = "texel_place", .components = 2}}});
        return checked(std::move(drawn));
    }();
    return all;
}

std::span<const glm::vec3> corners(Mesh mesh) {
    return mesh == Mesh::quad ? std::span<const glm::vec3>(quad_corners) : cube_corners;
}

std::span<const std::uint32_t> triangles(Mesh mesh) {
    return mesh == Mesh::quad ? std::span<const std::uint32_t>(quad_triangles) : cube_triangles;
}

Drawing drawing(const Settings& settings, float aspect) {
    Drawing made;
    made.view_projection = view_projection_matrix(settings.camera, aspect);
    if (settings.switches.mesh == Mesh::cube)
        return made;
    const glm::dvec3 eye(settings.camera.eye), target(settings.camera.target);
    const glm::dvec3 ahead = glm::normalize(target - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(settings.camera.up)));
    made.right = glm::vec3(right);
    made.up = glm::vec3(glm::cross(right, ahead));
    made.back = glm::vec3(ahead);
    return made;
}

bool is_drawn(const Settings& settings, const Drawing& drawing) {
    if (settings.switches.draw_bounds == DrawBounds::off)
        return true;
    const glm::dvec3 half = (glm::dvec3(settings.spawn.max) - glm::dvec3(settings.spawn.min)) * 0.5;
    std::array<int, 6> outside{};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at((corner & 1) != 0 ? half.x : -half.x, (corner & 2) != 0 ? half.y : -half.y,
                            (corner & 4) != 0 ? half.z : -half.z);
        const glm::dvec4 clip = glm::dmat4(drawing.view_projection) * glm::dvec4(at, 1.0);
        for (int axis = 0; axis < 3; ++axis) {
            outside[static_cast<std::size_t>(2 * axis)] += clip[axis] < -clip.w ? 1 : 0;
            outside[static_cast<std::size_t>(2 * axis + 1)] += clip[axis] > clip.w ? 1 : 0;
        }
    }
    return std::none_of(outside.begin(), outside.end(), [](int corners_out) { return corners_out == 8; });
}

} // namespace lockstep::dust
