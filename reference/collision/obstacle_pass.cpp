#include "reference/collision/obstacle_pass.hpp"

#include <cassert>
#include <cstddef>
#include <vector>

#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/obstacle_corners.hpp"
#include "reference/collision/step_stage.hpp"
#include "reference/draw_triangles.hpp"
#include "reference/subnormals.hpp"
#include "reference/triangle_interpolation.hpp"
#include "reference/triangle_raster.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

template <class A> void draw_obstacle_triangles(A fp, const Mesh& obstacles, const FrameParams& params,
                                                const Profile& profile, CollisionImage& cdt, DepthImage& depth) {
    const FlushSubnormals guard(profile.flush_subnormals);
    const std::vector<glm::vec4> clip = projected_corners(fp, obstacles, params.collision_proj_view);
    const CollisionCode code(params);
    const bool depth_alone = params.switches.search == Search::depth;
    const auto shader = [&](std::size_t triangle) {
        return [&, positions = stored_corners(fp, obstacles, triangle)](int x, int y, const auto& weights,
                                                                        float window_depth) {
            if (!(window_depth < depth.at(x, y)))
                return;
            depth.at(x, y) = window_depth;
            cdt.at(x, y) = depth_alone ? depth_code(window_depth)
                                       : code.encode(TriangleInterpolation<A>::mix(fp, positions, weights));
        };
    };
    draw_triangles(fp, clip, obstacles.indices, params.width, params.height, profile, shader, params.clip_depth);
}

template <class A> void draw_obstacle_vertices(A fp, const Mesh& obstacles, const FrameParams& params,
                                               const Profile& profile, CollisionImage& cdt, DepthImage& depth) {
    const FlushSubnormals guard(profile.flush_subnormals);
    const CollisionCode code(params);
    const FrameParams drawn = drawn_by_rasteriser(params);
    for (const glm::vec3 position : obstacles.positions) {
        const PointFragment point = point_fragment(position, drawn, profile);
        if (point.x < 0 || !(point.depth < depth.at(point.x, point.y)))
            continue;
        depth.at(point.x, point.y) = point.depth;
        cdt.at(point.x, point.y) = code.encode(fp.flush(position));
    }
}

} // namespace

void obstacle_pass(const Mesh& obstacles, const FrameParams& params, const Profile& profile, CollisionImage& cdt,
                   DepthImage& depth) {
    assert(cdt.width == params.width && cdt.height == params.height);
    assert(depth.width == params.width && depth.height == params.height);
    switch (params.switches.obstacles_in_cdt) {
    case ObstaclesInCdt::off:
        return;
    case ObstaclesInCdt::vertices:
        return with_arithmetic(profile, params.switches.arithmetic,
                               [&](auto fp) { draw_obstacle_vertices(fp, obstacles, params, profile, cdt, depth); });
    case ObstaclesInCdt::triangles:
        return with_arithmetic(profile, params.switches.arithmetic,
                               [&](auto fp) { draw_obstacle_triangles(fp, obstacles, params, profile, cdt, depth); });
    }
}

} // namespace lockstep
