#pragma once
#include <memory>

#include "reference/fluid/point_coord.hpp"
#include "reference/system/pass_by_driver.hpp"

namespace lockstep::fluid {

/// A pass that draws spheres: `made(host)`, of points by a host that takes gl_PointCoord as the driver has it, as far
/// as the probe's rows say it.
template <class Made> std::unique_ptr<ItemPass> by_point_coord(const HostPtr& host, const Made& made) {
    if (host->switches().sprite != Sprite::points)
        return made(host);
    const auto with = [&](PointCoord law) { return made(std::make_shared<const Host>(host->settings(), law)); };
    return std::make_unique<PassByDriver>(
        point_coord_row, made(host),
        std::make_unique<PassByDriver>(cut_point_coord_row, with(PointCoord::cut), with(PointCoord::open)));
}

} // namespace lockstep::fluid
