#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/model/profile.hpp"
#include "reference/subnormals.hpp"
#include "reference/triangle_raster.hpp"

namespace lockstep {

/// Draws `triangles` into an image of width x height: `begin(primitive)` gives a function of (x, y) that is then called
/// for every covered pixel. Bands of rows run in parallel; a pixel meets its triangles in drawing order, so the result
/// does not depend on the number of threads.
template <class Begin> void draw_triangles(std::span<const RasterTriangle> triangles, int width, int height,
                                           const Profile& profile, const Begin& begin) {
    constexpr int band_rows = 32;
    const int bits = profile.raster.subpixel_bits;
    const int bands = (height + band_rows - 1) / band_rows;
    const auto band_of = [&](std::int32_t y) { return std::clamp((y >> bits) / band_rows, 0, bands - 1); };
    std::vector<std::vector<std::uint32_t>> members(static_cast<std::size_t>(bands));
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const auto& c = triangles[t].corners;
        const int last = band_of(std::max({c[0].y, c[1].y, c[2].y}));
        for (int band = band_of(std::min({c[0].y, c[1].y, c[2].y})); band <= last; ++band)
            members[static_cast<std::size_t>(band)].push_back(t);
    }
#pragma omp parallel
    {
        const FlushSubnormals guard(profile.flush_subnormals);
#pragma omp for schedule(dynamic)
        for (int band = 0; band < bands; ++band) {
            const PixelRect area{0, band * band_rows, width, std::min(height, (band + 1) * band_rows)};
            for (const std::uint32_t t : members[static_cast<std::size_t>(band)])
                for_each_pixel(triangles[t], profile.raster, area, begin(triangles[t].primitive));
        }
    }
}

} // namespace lockstep
