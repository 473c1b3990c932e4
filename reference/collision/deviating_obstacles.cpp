#include "reference/collision/deviating_obstacles.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include "reference/collision/collision_code.hpp"
#include "reference/collision/obstacle_corners.hpp"
#include "reference/draw_triangles.hpp"
#include "reference/subnormals.hpp"
#include "reference/triangle_interpolation.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

template <class Corner> using Corners = std::array<Corner, 3>;

/// What a triangle stores of its corners.
void spoil(Corners<glm::vec3>& stored, const Deviations& deviations) {
    if (deviations.has(Deviation::obstacle_first_and_second_swapped))
        std::swap(stored[0], stored[1]);
    if (deviations.has(Deviation::obstacle_second_and_third_swapped))
        std::swap(stored[1], stored[2]);
    if (deviations.has(Deviation::obstacle_first_and_third_swapped))
        std::swap(stored[0], stored[2]);
    if (deviations.has(Deviation::obstacle_corners_rotated))
        stored = {stored[1], stored[2], stored[0]};
    if (deviations.has(Deviation::obstacle_corners_rotated_back))
        stored = {stored[2], stored[0], stored[1]};
    if (deviations.has(Deviation::obstacle_first_corner_alone))
        stored.fill(stored[0]);
    if (deviations.has(Deviation::obstacle_last_corner_alone))
        stored.fill(stored[2]);
    if (deviations.has(Deviation::obstacle_centroid_alone))
        stored.fill((stored[0] + stored[1] + stored[2]) / 3.0F);
}

/// Where its corners are taken to be.
void misplace(Corners<glm::vec4>& clip, const Deviations& deviations) {
    if (deviations.has(Deviation::obstacle_interpolated_on_screen))
        for (glm::vec4& corner : clip)
            corner = {corner.x / corner.w, corner.y / corner.w, corner.z / corner.w, 1.0F};
}

void flip(glm::vec4& clip, const Deviations& deviations) {
    if (deviations.has(Deviation::obstacle_y_flipped))
        clip.y = -clip.y;
    if (deviations.has(Deviation::obstacle_x_flipped))
        clip.x = -clip.x;
}

/// By the way its corners go around, of those before the camera.
bool is_drawn(const Corners<glm::vec4>& clip, const Deviations& deviations) {
    const auto at = [&](std::size_t i) { return glm::dvec2(clip[i].x, clip[i].y) / double{clip[i].w}; };
    const glm::dvec2 a = at(1) - at(0), b = at(2) - at(0);
    const double area = a.x * b.y - a.y * b.x;
    return !(deviations.has(Deviation::obstacle_counterclockwise_alone) && area < 0.0) &&
           !(deviations.has(Deviation::obstacle_clockwise_alone) && area > 0.0);
}

template <class A> void draw(A fp, const Mesh& obstacles, const FrameParams& params, const Profile& profile,
                             const Deviations& deviations, CollisionImage& cdt, DepthImage& depth) {
    const FlushSubnormals guard(profile.flush_subnormals);
    const CollisionCode code(params);
    std::vector<glm::vec4> clip = projected_corners(fp, obstacles, params.collision_proj_view);
    for (glm::vec4& corner : clip)
        flip(corner, deviations);
    const auto shader = [&](std::size_t triangle) {
        const std::uint32_t* index = &obstacles.indices[triangle * 3];
        Corners<glm::vec3> stored = stored_corners(fp, obstacles, triangle);
        Corners<glm::vec4> placed{clip[index[0]], clip[index[1]], clip[index[2]]};
        const bool drawn = is_drawn(placed, deviations);
        for (std::size_t i = 0; i < stored.size(); ++i) {
            if (deviations.has(Deviation::obstacle_stores_clip_space))
                stored[i] = glm::vec3(placed[i]);
            if (deviations.has(Deviation::obstacle_stores_ndc))
                stored[i] = glm::vec3(placed[i]) / placed[i].w;
        }
        spoil(stored, deviations);
        misplace(placed, deviations);
        const TriangleInterpolation<A> interpolation(fp, placed, params.width, params.height, params.clip_depth);
        const int centre = deviations.has(Deviation::obstacle_at_pixel_corner) ? 0 : 1;
        return [&, stored, interpolation, centre, drawn](int x, int y, const auto&, float) {
            auto weights = interpolation.weights(
                interpolation.edges_at(2 * x + centre - params.width, 2 * y + centre - params.height));
            if (deviations.has(Deviation::obstacle_shares_exchanged))
                std::swap(weights.second, weights.third);
            float at = interpolation.depth(weights);
            if (deviations.has(Deviation::obstacle_depth_zero))
                at = 0.0F;
            if (deviations.has(Deviation::obstacle_depth_not_halved))
                at = clamp_to(at * 2.0F - 1.0F, 1.0F);
            if (deviations.has(Deviation::obstacle_depth_reversed))
                at = params.clip_depth.sign() - at;
            if (!drawn || !(at < depth.at(x, y)))
                return;
            depth.at(x, y) = at;
            cdt.at(x, y) = code.encode(TriangleInterpolation<A>::mix(fp, stored, weights));
            if (deviations.has(Deviation::obstacle_alpha_missing))
                cdt.at(x, y).a = 0.0F;
        };
    };
    draw_triangles(fp, clip, obstacles.indices, params.width, params.height, profile, shader, params.clip_depth);
}

} // namespace

void deviating_obstacles(const Mesh& obstacles, const FrameParams& params, const Profile& profile,
                         const Deviations& deviations, CollisionImage& cdt, DepthImage& depth) {
    if (params.switches.obstacles_in_cdt != ObstaclesInCdt::triangles ||
        std::none_of(deviations.begin(), deviations.end(), changes_obstacles))
        return;
    cdt = CollisionImage(params.width, params.height);
    depth = DepthImage(params.width, params.height, params.clip_depth.cleared());
    with_arithmetic(profile, params.switches.arithmetic,
                    [&](auto fp) { draw(fp, obstacles, params, profile, deviations, cdt, depth); });
}

} // namespace lockstep
