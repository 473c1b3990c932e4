#pragma once
#include <cstdint>

#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// base_texel() of collision_pass.hpp without branches: lines 2 to 4 of the listing, from what the perspective divide
/// leaves, or without one from clip space.
struct TexelLookup {
    float least; ///< x > -1, which truncation takes in, as the least float it holds for
    float width, height;

    explicit TexelLookup(const FrameParams& params)
        : least(params.switches.base_texel == BaseTexel::floor ? 0.0F : -0x1.fffffep-1F),
          width(static_cast<float>(params.width)), height(static_cast<float>(params.height)) {}

    struct Texel {
        std::int32_t x, y; ///< 0 outside
        bool inside;
    };

    [[nodiscard]] Texel operator()(float ndc_x, float ndc_y) const {
        const float x = (ndc_x + 1.0F) * 0.5F * width;
        const float y = (ndc_y + 1.0F) * 0.5F * height;
        const bool inside = (x >= least) & (y >= least) & (x < width) & (y < height);
        return {static_cast<std::int32_t>(inside ? x : 0.0F), static_cast<std::int32_t>(inside ? y : 0.0F), inside};
    }
};

} // namespace lockstep
