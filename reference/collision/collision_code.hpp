#pragma once
#include <utility>

#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// The stored code of a CDT texel (image.hpp says what each format holds; alpha is 1, or 255 for rgba8), and back.
/// rgba16f: nearest half, ties to even; magnitudes below 2^-14 become +0, above 65504 they become 65504; NaN stays.
/// rgba8: nearest of 256 codes across the scene's cdt_box, half up, clamped to it; NaN is code 0.
class CollisionCode {
  public:
    explicit CollisionCode(const FrameParams& params);

    [[nodiscard]] glm::vec4 encode(glm::vec3 position) const;
    /// Codes that a driver may make of plain floats: those next to each coordinate on either side (GL 4.5, 2.3.5), and,
    /// for rgba8, of what a shader's rounding may make of its place in the box. `low` and `high`: of a position that
    /// may lie anywhere between.
    [[nodiscard]] std::pair<glm::vec4, glm::vec4> driver_codes(glm::vec3 low, glm::vec3 high) const;
    [[nodiscard]] glm::vec3 decode(glm::vec4 code) const {
        if (format_ != CdtFormat::rgba8)
            return {code.x, code.y, code.z};
        return {low_.x + code.x * step_.x, low_.y + code.y * step_.y, low_.z + code.z * step_.z};
    }

  private:
    CdtFormat format_;
    glm::vec3 low_, step_, scale_, size_;
};

/// What a texel of the obstacles' depth holds, search = depth; alpha 0: no obstacle.
inline glm::vec4 depth_code(float window_depth) { return {window_depth, 0.0F, 0.0F, 1.0F}; }

} // namespace lockstep
