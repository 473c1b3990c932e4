#pragma once
#include "reference/fluid/linear_laws.hpp"
#include "reference/fluid/sites.hpp"
#include "reference/readings/unspecified.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::fluid {

/// What the texture unit makes of the texels around a coordinate, 0 to 1 on each axis, GL_LINEAR (of lanes
/// linear_lanes.hpp).
template <class R, class Texel> typename R::Real
linear_fetch(R& r, At at, LinearFilter filter, const typename R::Vec2& coordinate, const Texels<Texel>& image) {
    using Real = typename R::Real;
    const FetchedAxis x{item_twin::set_of(coordinate.x), image.width}, y{item_twin::set_of(coordinate.y), image.height};
    const Real value(fetched(filter, x, y, image));
    Interval legal{0.0F};
    if constexpr (requires { value.legal(); })
        legal = legal_fetch(filter, x, y, image);
    return r.note(at, unspecified_within(r, at, value, legal));
}

} // namespace lockstep::fluid
