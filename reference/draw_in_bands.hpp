#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "reference/model/profile.hpp"
#include "reference/subnormals.hpp"
#include "reference/window.hpp"

namespace lockstep {

/// Draws primitives 0 .. count - 1 into an image of width x height: `rows(i)` gives the first and last row primitive i
/// may touch, `draw(i, area)` draws what of it lies in `area`. Bands of rows run in parallel; a pixel meets its
/// primitives in order, so the result does not depend on the number of threads.
template <class Rows, class Draw> void draw_in_bands(std::size_t count, int width, int height, const Profile& profile,
                                                     const Rows& rows, const Draw& draw) {
    constexpr int band_rows = 32;
    const int bands = (height + band_rows - 1) / band_rows;
    std::vector<std::vector<std::uint32_t>> members(static_cast<std::size_t>(bands));
    for (std::size_t i = 0; i < count; ++i) {
        const std::pair<int, int> touched = rows(i);
        const int last = std::min(touched.second, height - 1);
        for (int band = std::max(touched.first, 0) / band_rows; band * band_rows <= last; ++band)
            members[static_cast<std::size_t>(band)].push_back(static_cast<std::uint32_t>(i));
    }
    const FlushSubnormals keep(false); // for threads that start here, and outlive this
#pragma omp parallel
    {
        const FlushSubnormals guard(profile.flush_subnormals);
#pragma omp for schedule(dynamic)
        for (int band = 0; band < bands; ++band) {
            const PixelRect area{0, band * band_rows, width, std::min(height, (band + 1) * band_rows)};
            for (const std::uint32_t i : members[static_cast<std::size_t>(band)])
                draw(i, area);
        }
    }
}

} // namespace lockstep
