#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "gpu/probe.hpp"
#include "gpu/probe/judge.hpp"

namespace lockstep::probing {

/// How a window coordinate is put on the sub-pixel grid; the names are findings.
struct SnapRounding {
    std::string_view name;
    double (*round)(double);
};

/// Nearest first: an edge that is only seen where it crosses pixel centres cannot tell 8 bits, ties away, from 9 bits
/// rounded down.
const std::array<SnapRounding, 4>& snap_roundings();

/// Sub-pixel grid, in units of 2^-bits pixels from the centre of pixel 0.
struct Snap {
    int bits = 8;
    SnapRounding rounding;

    [[nodiscard]] std::int64_t operator()(double window) const {
        return static_cast<std::int64_t>(rounding.round((window - 0.5) * static_cast<double>(1 << bits)));
    }
};

/// The pixel a size-1 point covers along one axis.
int point_pixel(double window, const Snap& snap, bool edge_to_lower);

/// What measure_snapping found for "points" or "triangles"; where nothing matched, 8 bits and half away from zero.
Snap found_snap(const std::vector<ProbeRow>& rows, std::string_view primitive);

} // namespace lockstep::probing
