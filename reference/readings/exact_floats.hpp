#pragma once
#ifdef __FAST_MATH__
#error "a twin promises bits: compile without -ffast-math, -Ofast and their kin"
#endif

#include <string_view>

namespace lockstep {

/// Throws Error where some source that includes this header was compiled so that a * b + c rounds once: GCC and Clang
/// fuse by themselves where the processor can (-ffp-contract=off forbids it). Called before a reading runs.
void require_two_roundings();

/// For require_two_roundings: what a source found of itself, before main.
bool note_roundings(float fused_is_zero, std::string_view source);

namespace {
/// 1 + 2^-12 squared is 1 + 2^-11 + 2^-24, half a unit more than a float holds: gone if the product is rounded first.
inline bool roundings_noted(std::string_view source) {
    volatile float near_one = 1.0F + 0x1p-12F;
    volatile float rounded = -(1.0F + 0x1p-11F);
    const float a = near_one, c = rounded;
    return note_roundings(a * a + c, source);
}
[[maybe_unused]] const bool roundings_are_noted = roundings_noted(__BASE_FILE__);
} // namespace

} // namespace lockstep
