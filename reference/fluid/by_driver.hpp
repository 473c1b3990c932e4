#pragma once
#include <memory>
#include <utility>

#include "reference/fluid/point_coord.hpp"
#include "reference/system/pass_by_driver.hpp"

namespace lockstep::fluid {

// Rows of the probe: points whose middle lies outside the view volume.
inline constexpr const char* const dropped_outside_row = "image: points outside, dropped";
inline constexpr const char* const drawn_beside_row = "image: points beside the image, drawn";

/// A pass that draws spheres: `made(host)`, of points by a host that takes them as the driver has them, as far as the
/// probe's rows say it.
template <class Made> std::unique_ptr<ItemPass> by_points(const HostPtr& host, const Made& made) {
    if (host->switches().sprite != Sprite::points)
        return made(host);
    using PassPtr = std::unique_ptr<ItemPass>;
    const auto by_row = [](const char* row, PassPtr followed, PassPtr open) -> PassPtr {
        return std::make_unique<PassByDriver>(row, std::move(followed), std::move(open));
    };
    const auto by_coord = [&](PointsOutside outside) {
        const auto with = [&](PointCoord coord) {
            return made(std::make_shared<const Host>(host->settings(), PointRules{coord, outside}));
        };
        return by_row(point_coord_row, with(PointCoord::accurate),
                      by_row(cut_point_coord_row, with(PointCoord::cut), with(PointCoord::open)));
    };
    return by_row(dropped_outside_row, by_coord(PointsOutside::dropped),
                  by_row(drawn_beside_row, by_coord(PointsOutside::drawn_beside), by_coord(PointsOutside::open)));
}

} // namespace lockstep::fluid
