#pragma once
#include <algorithm>
#include <cmath>

#include "reference/interval.hpp"
#include "reference/model/fluid/host.hpp"

namespace lockstep::fluid {

// Rows of the probe: gl_PointCoord.
inline constexpr const char* const point_coord_row = "image: gl_PointCoord, accuracy";
inline constexpr const char* const cut_point_coord_row = "image: gl_PointCoord, cut size";

/// Of one coordinate of a point, in pixels: a fragment's place, the point's middle, and half its side.
struct PointSpan {
    Interval pixel, middle, half;
};

namespace point_coord {

/// How far a coordinate is on an H200 from what its middle and size make it, at most 2^-21 in 500,000 measured ones
/// (data/results/h200/points.txt); the probe's row asks for this.
inline constexpr double cut_error = 0x1p-20;

inline double cut_size(double size) { return std::max(std::floor(size * 32.0) / 32.0, 1.0); }
inline double snapped(double x) { return std::nearbyint(x * 256.0) / 256.0; }

/// (pixel - middle) / half of any of them.
inline Interval quotients(const PointSpan& of) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const double away : {of.pixel.low - of.middle.high, of.pixel.high - of.middle.low})
        for (const double half : {of.half.low, of.half.high}) {
            low = std::min(low, away / half);
            high = std::max(high, away / half);
        }
    return {low, high};
}

} // namespace point_coord

/// What 2 gl_PointCoord - 1 may be. GL says of which middle and size it comes, and not of how many bits these are (4.5,
/// 14.4.1). Accurate: right to 2/256 of a pixel. Cut: the middle on 256ths, halves to even, the size cut to 32nds, as
/// an H200 has them. Else a middle that is right to 2/256 and a size that is the next of steps of at most 1/8
/// (GL_POINT_SIZE_GRANULARITY).
inline Interval point_place(PointCoord law, const PointSpan& of) {
    using namespace point_coord;
    PointSpan taken = of;
    double error = 0x1p-22;
    switch (law) {
    case PointCoord::accurate:
        error += 2.0 / 256.0 / of.half.low;
        break;
    case PointCoord::cut:
        taken.middle = {snapped(of.middle.low), snapped(of.middle.high)};
        taken.half = {cut_size(2.0 * of.half.low) / 2.0, cut_size(2.0 * of.half.high) / 2.0};
        error += 2.0 * cut_error;
        break;
    case PointCoord::open:
        taken.half = {std::max(of.half.low - 1.0 / 32.0, 0.5), std::max(of.half.high + 1.0 / 32.0, 0.5)};
        error += 2.0 / 256.0 / taken.half.low;
        break;
    }
    const Interval place = quotients(taken);
    return {place.low - error, place.high + error};
}

} // namespace lockstep::fluid
