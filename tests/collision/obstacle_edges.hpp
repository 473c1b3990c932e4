#pragma once
#include <algorithm>
#include <cmath>

#include "reference/collision/obstacle_corners.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/mesh.hpp"
#include "reference/model/profile.hpp"
#include "reference/subnormals.hpp"
#include "reference/triangle_raster.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep::test {

/// Distance from the centre of texel (x, y) to the nearest side of any obstacle triangle, clipped sides included, in
/// sub-pixel units (1/256 texel for 8 bits); infinite without triangles. Another driver may cover a texel otherwise
/// only where this is at most 1: `edge ties`.
inline double obstacle_edge_distance(const Mesh& obstacles, const FrameParams& params, const Profile& profile, int x,
                                     int y) {
    const FlushSubnormals guard(profile.flush_subnormals);
    return with_arithmetic(profile, params.switches.arithmetic, [&](auto fp) {
        double nearest = HUGE_VAL;
        for (const RasterTriangle& triangle :
             assemble_triangles(projected_corners(fp, obstacles, params.collision_proj_view), obstacles.indices,
                                params.width, params.height, profile.raster, params.clip_depth))
            nearest = std::min(nearest, nearest_side(triangle, x, y, profile.raster).distance);
        return nearest;
    });
}

} // namespace lockstep::test
