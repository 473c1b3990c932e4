#pragma once
#include <cmath>

#include "reference/fluid/linear_fetch.hpp"
#include "reference/system/lane_items.hpp"

namespace lockstep::fluid {

/// linear_fetch, lane by lane.
template <class F, class Texel>
LaneReal<F> linear_fetch(Lanes<F>& /*r*/, At, const typename Lanes<F>::Vec2& place, const Texels<Texel>& image) {
    struct Axis {
        FloatLanes f;
        LaneInt base;
    };
    const auto axis = [](const FloatLanes& at, int size) {
        const FloatLanes t = at - 0.5F, whole = lanes::floor(t), end = lanes::all(static_cast<float>(size));
        const FloatLanes from = whole >= -1.0F ? whole : lanes::all(-1.0F); // of no number, too
        return Axis{t - whole, __builtin_convertvector(from > end ? end : from, IntLanes)};
    };
    const auto mixed = [](const FloatLanes& from, const FloatLanes& to, const FloatLanes& share) {
        const FloatLanes step = to - from;
        FloatLanes made = from;
        for (int lane = 0; lane < lane_count; ++lane)
            made[lane] = std::fma(share[lane], step[lane], from[lane]);
        return made;
    };
    const Axis x = axis(place.x.v, image.width), y = axis(place.y.v, image.height);
    const auto row = [&](int dy) {
        const LaneInt at = (y.base + dy).clamped(0, image.height - 1);
        return mixed(image.texel(x.base.clamped(0, image.width - 1), at),
                     image.texel((x.base + 1).clamped(0, image.width - 1), at), x.f);
    };
    return mixed(row(0), row(1), y.f);
}

} // namespace lockstep::fluid
