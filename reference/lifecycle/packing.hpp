#pragma once
#include <cmath>
#include <cstdint>

#include "reference/lifecycle/sites.hpp"
#include "reference/model/lifecycle/half.hpp"

/// Codes of 16 and 8 bits. Twin of shaders/lifecycle/packing.glsl.
namespace lockstep::lifecycle {

/// A number that rises where its half does: what is below 0 is -1 - magnitude, so that -0 is one of its own.
constexpr float ordered_half(std::uint32_t code) {
    const auto magnitude = static_cast<float>(code & 0x7fffU);
    return (code & 0x8000U) != 0 ? -1.0F - magnitude : magnitude;
}
constexpr std::uint32_t half_of_ordered(int ordered) {
    return ordered < 0 ? 0x8000U | static_cast<std::uint32_t>(-1 - ordered) : static_cast<std::uint32_t>(ordered);
}

/// The half of x. With portable arithmetic zero has no sign.
template <class R> std::uint32_t half_of(R& r, At place, const typename R::Real& x, HalfRounding rounding,
                                         std::uint32_t dither, bool zero_is_unsigned) {
    const auto code = r.monotone(r.note(site::half_source, x), [=](float f) {
        const std::uint32_t half = half_code(f, rounding, dither);
        return ordered_half(zero_is_unsigned && half == 0x8000U ? 0U : half);
    });
    const auto half = r.note(site::half, code);
    return half_of_ordered(static_cast<int>(r.note(place, typename R::Int(r.to_int(place, half)))));
}

/// 0 to 1 in `steps` steps; NaN is 0.
template <class R> std::uint32_t unorm_of(R& r, At place, const typename R::Real& c, float steps) {
    const auto clamped = r.monotone(c, [](float f) { return f > 0.0F ? (f < 1.0F ? f : 1.0F) : 0.0F; });
    const auto code = r.floor(clamped * r.uniform(site::color_steps, steps) + r.uniform(site::half_step, 0.5F));
    return static_cast<std::uint32_t>(static_cast<int>(r.note(place, typename R::Int(r.to_int(place, code)))));
}

/// Its code is clamped to 16 bits; NaN is 0. `clamped` is set where it was.
template <class R> std::uint32_t ticks_of(R& r, At place, const typename R::Real& x, bool* clamped = nullptr) {
    const auto code = r.floor(x + 0.5F);
    if (clamped != nullptr && !r.decide(place, code >= 0.0F && code <= 65535.0F))
        *clamped = true;
    const auto fits = r.monotone(code, [](float f) { return f > 0.0F ? (f < 65535.0F ? f : 65535.0F) : 0.0F; });
    return static_cast<std::uint32_t>(static_cast<int>(r.note(place, typename R::Int(r.to_int(place, fits)))));
}

} // namespace lockstep::lifecycle
