#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "reference/fluid/linear_fetch.hpp"
#include "reference/system/lane_items.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep::fluid {

namespace linear_lanes {

/// fma(share, to - from, from); of arrays, whose loop GCC makes one instruction.
LOCKSTEP_INLINE FloatLanes mixed(const FloatLanes& from, const FloatLanes& to, const FloatLanes& share) {
    std::array<float, lane_count> first{}, step{}, shares{};
    const FloatLanes way = to - from;
    std::memcpy(first.data(), &from, sizeof from);
    std::memcpy(step.data(), &way, sizeof way);
    std::memcpy(shares.data(), &share, sizeof share);
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t lane = 0; lane < lane_count; ++lane)
        first[lane] = std::fma(shares[lane], step[lane], first[lane]);
    return lanes::loaded<FloatLanes>(first.data());
}

} // namespace linear_lanes

/// linear_fetch with weights of all bits, lane by lane.
template <class F, class Texel> LaneReal<F>
linear_fetch(Lanes<F>& /*r*/, At, LinearFilter, const typename Lanes<F>::Vec2& coordinate, const Texels<Texel>& image) {
    struct Axis {
        FloatLanes f;
        LaneInt base;
    };
    const auto axis = [](const FloatLanes& at, int size) {
        const FloatLanes end = lanes::all(static_cast<float>(size)), t = at * end - 0.5F, whole = lanes::floor(t);
        const FloatLanes from = whole >= -1.0F ? whole : lanes::all(-1.0F); // of no number, too
        return Axis{t - whole, __builtin_convertvector(from > end ? end : from, IntLanes)};
    };
    const Axis x = axis(coordinate.x.v, image.width), y = axis(coordinate.y.v, image.height);
    const auto row = [&](int dy) {
        const LaneInt at = (y.base + dy).clamped(0, image.height - 1);
        return linear_lanes::mixed(image.texel(x.base.clamped(0, image.width - 1), at),
                                   image.texel((x.base + 1).clamped(0, image.width - 1), at), x.f);
    };
    return linear_lanes::mixed(row(0), row(1), y.f);
}

} // namespace lockstep::fluid
