#include "reference/collision/obstacle_pass.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/step_stage.hpp"
#include "reference/draw_triangles.hpp"
#include "reference/subnormals.hpp"
#include "reference/triangle_interpolation.hpp"
#include "reference/triangle_raster.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

template <class A> std::vector<glm::vec4> project(A fp, const Mesh& obstacles, const glm::mat4& proj_view) {
    std::vector<glm::vec4> clip(obstacles.positions.size());
    std::transform(obstacles.positions.begin(), obstacles.positions.end(), clip.begin(),
                   [&](glm::vec3 position) { return fp.transform(proj_view, position); });
    return clip;
}

template <class A> std::array<glm::vec3, 3> corners(A fp, const Mesh& obstacles, std::size_t triangle) {
    const std::uint32_t* index = &obstacles.indices[triangle * 3];
    const auto corner = [&](std::size_t i) { return fp.flush(obstacles.positions[index[i]]); };
    return {corner(0), corner(1), corner(2)};
}

template <class A> void draw_obstacle_triangles(A fp, const Mesh& obstacles, const FrameParams& params,
                                                const Profile& profile, CollisionImage& cdt, DepthImage& depth) {
    const FlushSubnormals guard(profile.flush_subnormals);
    const std::vector<glm::vec4> clip = project(fp, obstacles, params.collision_proj_view);
    const CollisionCode code(params);
    const auto shader = [&](std::size_t triangle) {
        return
            [&, positions = corners(fp, obstacles, triangle)](int x, int y, const auto& weights, float window_depth) {
                if (!(window_depth < depth.at(x, y)))
                    return;
                depth.at(x, y) = window_depth;
                cdt.at(x, y) = code.encode(TriangleInterpolation<A>::mix(fp, positions, weights));
            };
    };
    draw_triangles(fp, clip, obstacles.indices, params.width, params.height, profile, shader);
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

double obstacle_edge_distance(const Mesh& obstacles, const FrameParams& params, const Profile& profile, int x, int y) {
    const FlushSubnormals guard(profile.flush_subnormals);
    return with_arithmetic(profile, params.switches.arithmetic, [&](auto fp) {
        double nearest = HUGE_VAL;
        for (const RasterTriangle& triangle :
             assemble_triangles(project(fp, obstacles, params.collision_proj_view), obstacles.indices, params.width,
                                params.height, profile.raster))
            nearest = std::min(nearest, nearest_side(triangle, x, y, profile.raster).distance);
        return nearest;
    });
}

} // namespace lockstep
