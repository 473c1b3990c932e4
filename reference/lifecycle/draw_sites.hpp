#pragma once
#include "reference/lifecycle/sites.hpp"

/// The places that the drawing's twin alone has.
namespace lockstep::lifecycle::site {

inline constexpr Site way_to_corner{"way to the corner"};

} // namespace lockstep::lifecycle::site
