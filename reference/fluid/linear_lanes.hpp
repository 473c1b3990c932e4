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

/// A texel of each lane and the one behind it, in one row.
struct Neighbours {
    FloatLanes one, next;
};

/// Lanes that lie side by side, each of them on its texel or on the one before, as rounding has it, read three vectors.
template <class Texel>
LOCKSTEP_INLINE Neighbours neighbours(const Texels<Texel>& image, const LaneInt& base, const LaneInt& row) {
    const IntLanes off = base.v - from(0);
    const int first = lanes::set_of(off == off[0] + 1) != 0 ? off[0] + 1 : off[0];
    const IntLanes is_before = off == first - 1;
    const bool are_near = lanes::set_of(is_before | (off == first)) == (1U << lane_count) - 1;
    if (!are_near || first < 1 || first + lane_count >= image.width)
        return {image.texel(base.clamped(0, image.width - 1), row),
                image.texel((base + 1).clamped(0, image.width - 1), row)};
    const FloatLanes before = image.texel(LaneInt(from(first - 1)), row), at = image.texel(LaneInt(from(first)), row),
                     behind = image.texel(LaneInt(from(first + 1)), row);
    return {is_before ? before : at, is_before ? at : behind};
}

} // namespace linear_lanes

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
    const Axis x = axis(place.x.v, image.width), y = axis(place.y.v, image.height);
    const auto row = [&](int dy) {
        const auto [one, next] = linear_lanes::neighbours(image, x.base, (y.base + dy).clamped(0, image.height - 1));
        return linear_lanes::mixed(one, next, x.f);
    };
    return linear_lanes::mixed(row(0), row(1), y.f);
}

} // namespace lockstep::fluid
