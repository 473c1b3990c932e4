#pragma once
#include <cstdint>

#include <glm/vec4.hpp>

#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// base_texel() of collision_pass.hpp without branches: lines 2 to 4 of the listing. `A`: arithmetic.hpp.
template <class A> struct TexelLookup {
    A fp;
    bool divide;
    float least; ///< x > -1, which truncation takes in, as the least float it holds for
    float width, height;

    TexelLookup(A fp_, const FrameParams& params)
        : fp(fp_), divide(params.switches.perspective_divide == PerspectiveDivide::on),
          least(params.switches.base_texel == BaseTexel::floor ? 0.0F : -0x1.fffffep-1F),
          width(static_cast<float>(params.width)), height(static_cast<float>(params.height)) {}

    struct Texel {
        std::int32_t x, y; ///< 0 outside
        bool inside;
    };

    [[nodiscard]] Texel operator()(glm::vec4 clip) const {
        const float w = divide ? clip.w : 1.0F;
        const float x = (fp.divide(clip.x, w) + 1.0F) * 0.5F * width;
        const float y = (fp.divide(clip.y, w) + 1.0F) * 0.5F * height;
        const bool inside = (x >= least) & (y >= least) & (x < width) & (y < height);
        return {static_cast<std::int32_t>(inside ? x : 0.0F), static_cast<std::int32_t>(inside ? y : 0.0F), inside};
    }
};

} // namespace lockstep
