#include "reference/collision/collision_code.hpp"

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

/// The half next to x, towards an infinity.
float neighbouring_half(float x, bool above) {
    if (x != x)
        return x;
    constexpr float largest = 65504.0F;
    if (std::abs(x) > largest)
        return std::copysign(above == (x > 0.0F) ? HUGE_VALF : largest, x);
    const double unit = std::ldexp(1.0, (x == 0.0F ? -14 : std::max(std::ilogb(x), -14)) - 10);
    const double steps = static_cast<double>(x) / unit;
    return static_cast<float>((above ? std::ceil(steps) : std::floor(steps)) * unit);
}

/// The code next to x's place in the box. A shader may compute that place as (x - low) * scale or as x * scale - low *
/// scale: each product, sum and quotient errs by an ULP, which is at most 2^-23 of it, and so does the driver's by 255.
float neighbouring_unorm8(float x, float low, float size, bool above) {
    if (x != x)
        return 0.0F;
    const double scale = 255.0 / static_cast<double>(size);
    const double place = (static_cast<double>(x) - static_cast<double>(low)) * scale;
    const double magnitude = (std::abs(static_cast<double>(x)) + std::abs(static_cast<double>(low))) * scale;
    const double error = 0x1p-23 * (5.0 * magnitude + std::abs(place));
    return static_cast<float>(std::clamp(above ? std::ceil(place + error) : std::floor(place - error), 0.0, 255.0));
}

} // namespace

CollisionCode::CollisionCode(const FrameParams& params)
    : format_(params.switches.cdt_format), low_(params.cdt_box.min),
      step_((params.cdt_box.max - params.cdt_box.min) / 255.0F),
      scale_(255.0F / (params.cdt_box.max - params.cdt_box.min)), size_(params.cdt_box.max - params.cdt_box.min) {}

std::pair<glm::vec4, glm::vec4> CollisionCode::driver_codes(glm::vec3 low, glm::vec3 high) const {
    std::pair<glm::vec4, glm::vec4> codes{encode(low), encode(high)};
    for (int c = 0; c < 3; ++c) {
        if (format_ == CdtFormat::rgba16f) {
            codes.first[c] = neighbouring_half(low[c], false);
            codes.second[c] = neighbouring_half(high[c], true);
        } else if (format_ == CdtFormat::rgba8) {
            codes.first[c] = neighbouring_unorm8(low[c], low_[c], size_[c], false);
            codes.second[c] = neighbouring_unorm8(high[c], low_[c], size_[c], true);
        }
    }
    return codes;
}

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
