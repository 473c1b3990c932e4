#pragma once
#include <array>
#include <cstdint>

/// The numbers that look random. Twin of shaders/random.glsl.
namespace lockstep {

using Bits3 = std::array<std::uint32_t, 3>;

/// Jarzynski and Olano, "Hash functions for GPU rendering", JCGT 9(3), 2020.
constexpr Bits3 pcg3d(Bits3 v) {
    for (std::uint32_t& x : v)
        x = x * 1664525U + 1013904223U;
    v[0] += v[1] * v[2];
    v[1] += v[2] * v[0];
    v[2] += v[0] * v[1];
    for (std::uint32_t& x : v)
        x ^= x >> 16U;
    v[0] += v[1] * v[2];
    v[1] += v[2] * v[0];
    v[2] += v[0] * v[1];
    return v;
}

/// Three numbers in [0, 1) of such bits.
template <class R> typename R::Vec3 unit_numbers(const Bits3& bits) {
    return {R::real(bits[0] >> 8U) * 0x1p-24F, R::real(bits[1] >> 8U) * 0x1p-24F, R::real(bits[2] >> 8U) * 0x1p-24F};
}

} // namespace lockstep
