#include "reference/obstacle_pass.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include "reference/collision_code.hpp"
#include "reference/collision_pass.hpp"
#include "reference/draw_in_bands.hpp"
#include "reference/subnormals.hpp"
#include "reference/triangle_interpolation.hpp"
#include "reference/triangle_raster.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

template <class A> std::vector<glm::vec4> project(const Mesh& obstacles, const glm::mat4& proj_view) {
    std::vector<glm::vec4> clip(obstacles.positions.size());
    std::transform(obstacles.positions.begin(), obstacles.positions.end(), clip.begin(),
                   [&](glm::vec3 position) { return A::transform(proj_view, position); });
    return clip;
}

template <class T>
std::array<T, 3> corners(const std::vector<T>& vertices, const Mesh& obstacles, std::uint32_t triangle) {
    const std::uint32_t* index = &obstacles.indices[std::size_t{triangle} * 3];
    return {vertices[index[0]], vertices[index[1]], vertices[index[2]]};
}

template <class A> void draw_obstacle_triangles(const Mesh& obstacles, const FrameParams& params,
                                                const Profile& profile, CollisionImage& cdt, DepthImage& depth) {
    const FlushSubnormals guard(profile.flush_subnormals);
    const std::vector<glm::vec4> clip = project<A>(obstacles, params.collision_proj_view);
    const auto triangles = assemble_triangles(clip, obstacles.indices, params.width, params.height, profile.raster);
    const CollisionCode code(params);
    const auto rows = [&](std::size_t i) { return rows_touched(triangles[i], profile.raster); };
    const auto draw = [&](std::size_t i, const PixelRect& area) {
        const std::uint32_t triangle = triangles[i].primitive;
        const TriangleInterpolation<A> interpolation(corners(clip, obstacles, triangle), params.width, params.height);
        const auto positions = corners(obstacles.positions, obstacles, triangle);
        for_each_pixel(triangles[i], profile.raster, area, [&](int x, int y) {
            const auto weights = interpolation.weights(x, y);
            const float fragment_depth = interpolation.depth(weights);
            if (!(fragment_depth < depth.at(x, y)))
                return;
            depth.at(x, y) = fragment_depth;
            cdt.at(x, y) = code.encode(interpolation.mix(positions, weights));
        });
    };
    draw_in_bands(triangles.size(), params.width, params.height, profile, rows, draw);
}

void draw_obstacle_vertices(const Mesh& obstacles, const FrameParams& params, const Profile& profile,
                            CollisionImage& cdt, DepthImage& depth) {
    const FlushSubnormals guard(profile.flush_subnormals);
    const CollisionCode code(params);
    for (const glm::vec3 position : obstacles.positions) {
        const PointFragment point = point_fragment(position, params, profile);
        if (point.x < 0 || !(point.depth < depth.at(point.x, point.y)))
            continue;
        depth.at(point.x, point.y) = point.depth;
        cdt.at(point.x, point.y) = code.encode(position);
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
        return draw_obstacle_vertices(obstacles, params, profile, cdt, depth);
    case ObstaclesInCdt::triangles:
        return with_arithmetic(profile, params.switches,
                               [&]<class A>(A) { draw_obstacle_triangles<A>(obstacles, params, profile, cdt, depth); });
    }
}

double obstacle_edge_distance(const Mesh& obstacles, const FrameParams& params, const Profile& profile, int x, int y) {
    const FlushSubnormals guard(profile.flush_subnormals);
    return with_arithmetic(profile, params.switches, [&]<class A>(A) {
        double nearest = HUGE_VAL;
        for (const RasterTriangle& triangle :
             assemble_triangles(project<A>(obstacles, params.collision_proj_view), obstacles.indices, params.width,
                                params.height, profile.raster))
            nearest = std::min(nearest, side_distance(triangle, x, y, profile.raster));
        return nearest;
    });
}

} // namespace lockstep
