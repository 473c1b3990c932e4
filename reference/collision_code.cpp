#include "reference/collision_code.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace lockstep {
namespace {

float nearest_half(float x) {
    if (x != x)
        return x;
    if (std::abs(x) < 0x1p-14F)
        return 0.0F;
    const auto bits = std::bit_cast<std::uint32_t>(std::abs(x));
    const std::uint32_t dropped = bits & 0x1fffU;
    std::uint32_t kept = bits - dropped;
    const bool odd = (kept & 0x2000U) != 0;
    if (dropped > 0x1000U || (dropped == 0x1000U && odd))
        kept += 0x2000U;
    return std::copysign(std::min(std::bit_cast<float>(kept), 65504.0F), x);
}

float unorm8(float x, float low, float scale) {
    const float code = (x - low) * scale;
    return code > 0.0F ? std::floor(std::min(code, 255.0F) + 0.5F) : 0.0F;
}

} // namespace

CollisionCode::CollisionCode(const FrameParams& params)
    : format_(params.switches.cdt_format), low_(params.cdt_box.min),
      step_((params.cdt_box.max - params.cdt_box.min) / 255.0F),
      scale_(255.0F / (params.cdt_box.max - params.cdt_box.min)) {}

glm::vec4 CollisionCode::encode(glm::vec3 p) const {
    switch (format_) {
    case CdtFormat::rgba32f:
        return {p, 1.0F};
    case CdtFormat::rgba16f:
        return {nearest_half(p.x), nearest_half(p.y), nearest_half(p.z), 1.0F};
    case CdtFormat::rgba8:
        return {unorm8(p.x, low_.x, scale_.x), unorm8(p.y, low_.y, scale_.y), unorm8(p.z, low_.z, scale_.z), 255.0F};
    }
    return {};
}

} // namespace lockstep
