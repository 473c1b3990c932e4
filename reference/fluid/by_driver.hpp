#pragma once
#include <memory>

#include "reference/fluid/point_coord.hpp"
#include "reference/system/pass_by_driver.hpp"

namespace lockstep::fluid {

// Rows of the probe: points whose middle lies outside the view volume.
inline constexpr const char* const dropped_outside_row = "image: points outside, dropped";
inline constexpr const char* const drawn_beside_row = "image: points beside the image, drawn";

// Rows of the probe: GL_LINEAR in 2D textures.
inline constexpr const char* const plane_filter_row = "image: linear filter of a plane";
inline constexpr const char* const aligned_plane_filter_row = "image: linear filter of a plane, aligned";

/// What a driver makes of points, as far as the probe's rows say it.
inline PointRules point_rules(const Profile& profile) {
    const auto found = [&](const char* first, const char* second, auto by_first, auto by_second, auto by_none) {
        return profile.follows(first) ? by_first : profile.follows(second) ? by_second : by_none;
    };
    return {found(point_coord_row, cut_point_coord_row, PointCoord::accurate, PointCoord::cut, PointCoord::open),
            found(dropped_outside_row, drawn_beside_row, PointsOutside::dropped, PointsOutside::drawn_beside,
                  PointsOutside::open),
            profile.point_sizes};
}

/// A pass that draws spheres: `made(host)`, of points by a host that takes them as the driver has them.
template <class Made> std::unique_ptr<ItemPass> by_points(const HostPtr& host, const Made& made) {
    if (host->switches().sprite != Sprite::points)
        return made(host);
    return std::make_unique<PassByRules<PointRules>>(point_rules, [host, made](const PointRules& rules) {
        return made(std::make_shared<const Host>(host->settings(), rules));
    });
}

/// How a driver filters.
inline LinearFilter linear_filter(const Profile& profile) {
    return profile.follows(plane_filter_row)           ? LinearFilter::all_bits
           : profile.follows(aligned_plane_filter_row) ? LinearFilter::aligned
                                                       : LinearFilter::open;
}

/// A pass that reads between texels, likewise.
template <class Made> std::unique_ptr<ItemPass> by_filter(const HostPtr& host, const Made& made) {
    if (!host->switches().filters_by_gl())
        return made(host);
    return std::make_unique<PassByRules<LinearFilter>>(linear_filter, [host, made](LinearFilter filter) {
        return made(std::make_shared<const Host>(host->settings(), host->points(), filter));
    });
}

} // namespace lockstep::fluid
