#pragma once
#include <cstddef>
#include <memory>

#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// The positions a CDT stores, decoded, one array a coordinate, so that a search reads rows without asking what a
/// texel holds: texels without a particle and a margin round the image read as NaN, which is within no range.
struct StoredPositions {
    std::ptrdiff_t stride = 0;        ///< texels from one row to the next
    std::ptrdiff_t origin = 0;        ///< index of texel (0, 0)
    std::unique_ptr<float[]> x, y, z; ///< first written by the threads that fill them

    [[nodiscard]] std::ptrdiff_t index(int tx, int ty) const { return origin + ty * stride + tx; }
    [[nodiscard]] glm::vec3 at(std::ptrdiff_t index) const {
        const auto i = static_cast<std::size_t>(index);
        return {x[i], y[i], z[i]};
    }
};

/// `margin`: texels on every side; reading a row may go on for `overrun` floats beyond its right one.
StoredPositions stored_positions(const CollisionImage& cdt, const FrameParams& params, int margin, int overrun);

} // namespace lockstep
