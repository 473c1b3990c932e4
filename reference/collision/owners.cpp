#include "reference/collision/owners.hpp"

#include <cstddef>

#include "reference/collision/collision_pass.hpp"
#include "reference/collision/obstacle_pass.hpp"

namespace lockstep {
namespace {

std::vector<PointFragment> fragments(std::span<const glm::vec3> positions, const FrameParams& params,
                                     const Profile& profile) {
    std::vector<PointFragment> points(positions.size());
    const auto count = static_cast<std::ptrdiff_t>(positions.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t i = 0; i < count; ++i)
        points[static_cast<std::size_t>(i)] = point_fragment(positions[static_cast<std::size_t>(i)], params, profile);
    return points;
}

std::int32_t texel_index(const PointFragment& point, const FrameParams& params) {
    return point.x < 0 ? no_texel : point.y * params.width + point.x;
}

} // namespace

Owners draw_owners(const Particles& before, const Particles& after, const Mesh& obstacles, const FrameParams& params,
                   const Profile& profile) {
    CollisionImage cdt(params.width, params.height);
    DepthImage depth(params.width, params.height, params.clip_depth.cleared());
    obstacle_pass(obstacles, params, profile, cdt, depth);

    Owners owners{Image<std::int32_t>(params.width, params.height, empty_owner), {}};
    for (std::size_t t = 0; t < cdt.texels.size(); ++t)
        if (cdt.texels[t].a != 0.0F)
            owners.owner.texels[t] = obstacle_owner;

    const bool updated = params.switches.raster_position == RasterPosition::updated;
    const auto points = fragments(updated ? after.position : before.position, params, profile);
    owners.drawn.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const PointFragment& point = points[i];
        owners.drawn[i] = texel_index(point, params);
        if (point.x < 0 || !(point.depth < depth.at(point.x, point.y)))
            continue;
        depth.at(point.x, point.y) = point.depth;
        owners.owner.at(point.x, point.y) = static_cast<std::int32_t>(i);
    }
    return owners;
}

std::vector<std::int32_t> drawn_texels(std::span<const glm::vec3> positions, const FrameParams& params,
                                       const Profile& profile) {
    std::vector<std::int32_t> texels;
    texels.reserve(positions.size());
    for (const PointFragment& point : fragments(positions, params, profile))
        texels.push_back(texel_index(point, params));
    return texels;
}

} // namespace lockstep
