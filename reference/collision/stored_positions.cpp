#include "reference/collision/stored_positions.hpp"

#include <algorithm>
#include <limits>

#include "reference/collision/collision_code.hpp"

namespace lockstep {
namespace {

constexpr float no_position = std::numeric_limits<float>::quiet_NaN();

} // namespace

StoredPositions stored_positions(const CollisionImage& cdt, const FrameParams& params, int margin, int overrun) {
    const CollisionCode code(params);
    const bool phantom = params.switches.empty_texel == EmptyTexel::phantom;
    StoredPositions stored;
    stored.stride = cdt.width + 2 * margin;
    stored.origin = margin * stored.stride + margin;
    const auto size = static_cast<std::size_t>((cdt.height + 2 * margin) * stored.stride + overrun);
    for (std::unique_ptr<float[]>* const column : {&stored.x, &stored.y, &stored.z}) {
        *column = std::make_unique_for_overwrite<float[]>(size);
        std::fill_n(column->get() + size - overrun, overrun, no_position);
    }
#pragma omp parallel for schedule(static)
    for (int ty = -margin; ty < cdt.height + margin; ++ty) {
        float* x = stored.x.get() + stored.index(0, ty);
        float* y = stored.y.get() + stored.index(0, ty);
        float* z = stored.z.get() + stored.index(0, ty);
        if (ty < 0 || ty >= cdt.height) {
            std::fill(x - margin, x + cdt.width + margin, no_position);
            continue;
        }
        std::fill(x - margin, x, no_position);
        std::fill(x + cdt.width, x + cdt.width + margin, no_position);
        const glm::vec4* texel = &cdt.at(0, ty);
        for (int tx = 0; tx < cdt.width; ++tx) {
            const glm::vec3 position = code.decode(texel[tx]);
            const bool held = phantom || texel[tx].a != 0.0F;
            x[tx] = held ? position.x : no_position;
            y[tx] = position.y;
            z[tx] = position.z;
        }
    }
    return stored;
}

} // namespace lockstep
