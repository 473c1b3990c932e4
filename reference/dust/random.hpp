#pragma once
#include <cstdint>

#include <glm/vec2.hpp>

#include "reference/dust/grain.hpp"
#include "reference/model/dust/host.hpp"

/// The numbers that look random. Twin of shaders/dust/random.glsl.
namespace lockstep::dust {

/// PCG's output function over one step of its generator, on 32 bits.
constexpr std::uint32_t pcg(std::uint32_t x) {
    const std::uint32_t s = x * 747796405U + 2891336453U;
    const std::uint32_t y = ((s >> ((s >> 28U) + 4U)) ^ s) * 277803737U;
    return (y >> 22U) ^ y;
}

/// What the integer numbers are for.
enum class Stream : std::uint32_t { position_x, position_y, position_z, colour, chance, angle, radius };

constexpr std::uint32_t integer_random(std::uint32_t item, Stream stream, std::uint32_t frame, std::uint32_t seed) {
    return pcg(item + pcg(static_cast<std::uint32_t>(stream) + pcg(frame + pcg(seed))));
}

/// Who draws.
struct Draw {
    std::uint32_t item = 0, seed = 0;
};

template <class R> std::uint32_t seed_of(R& r, const Host& host) {
    return static_cast<std::uint32_t>(
        static_cast<int>(r.uniform(site::random_seed, static_cast<int>(host.settings().seed))));
}

template <class R> class RandomTwin {
    using Real = typename R::Real;

  public:
    RandomTwin(R& reading, const Switches& switches, Draw draw)
        : r(reading), driver_(switches.random == Random::sin), draw_(draw) {
        if constexpr (requires { r.foretell(&draw_); })
            r.foretell(&draw_);
    }
    RandomTwin(const RandomTwin&) = delete;
    RandomTwin& operator=(const RandomTwin&) = delete;

    /// In [0, 1), of those that a frame draws; those that stay are of frame 0.
    Real unit(Stream stream, std::uint32_t frame = 0) const {
        r.uniform(site::stream, static_cast<int>(stream));
        r.uniform(site::drawn_in, static_cast<int>(frame));
        return r.note(site::random, r.real(integer(stream, frame) >> 8U) * 0x1p-24F);
    }
    [[nodiscard]] std::uint32_t integer(Stream stream, std::uint32_t frame = 0) const {
        return integer_random(draw_.item, stream, frame, draw_.seed);
    }

    /// 0 to 1 from one number.
    Real r11(const Real& s) const { return hashed(s * rd1 + s * rd2); }
    /// 0 to 1 from two.
    Real r21(const Real& x, const Real& y) const { return hashed(x * rd1 + y * rd2); }
    /// The second and third number of a seed.
    Real second(const Real& s) const { return r11(s + rp1); }
    Real third(const Real& s) const { return r11(s + rp2); }
    /// 0 to 1 from two, as the first volume of grains was filled.
    Real h1(const Real& x, const Real& y) const { return hashed(x * 73.867F + y * 25.241F); }

    Real sine(const Real& x) const {
        const bool negative = r.decide(site::below_zero, x < 0.0F);
        return r.note(site::sine, of_driver(site::sine, signed_part(x, 0, negative)));
    }
    Real cosine(const Real& x) const { return r.note(site::cosine, of_driver(site::cosine, signed_part(x, 1, false))); }

  private:
    static constexpr float rd1 = 7.8671F, rd2 = 3.3419F, rp1 = 2.1759F, rp2 = 4.7921F;

    /// The driver's own sine is any number: GLSL gives it no precision.
    Real of_driver(At place, const Real& value) const {
        return driver_ ? r.unspecified(place, value, -1.0F, 1.0F) : value;
    }

    Real hashed(const Real& argument) const {
        const Real a = sine(r.note(site::phase, argument)) * 39482.17593F;
        const Real share = a - r.floor(a);
        return r.note(site::random, driver_ ? r.unspecified(site::random, share, 0.0F, 1.0F) : share);
    }

    /// Cody and Waite's reduction to an eighth of a turn, then a polynomial; each operation rounded.
    Real signed_part(const Real& x, int quarter, bool negative) const {
        const Real size = r.abs(x);
        const int whole = r.to_int(site::octant, size * 1.27323954473516F);
        const int j = (whole + 1) & ~1;
        const Real f = r.real(j);
        Real rest = f * -0.78515625F + size;
        rest = f * -2.4187564849853515625e-4F + rest;
        rest = f * -3.77489497744594108e-8F + rest;
        const Real z = rest * rest;
        const int quadrant = (j / 2 + quarter) & 3;
        const Real part = (quadrant & 1) != 0 ? even(z) : odd(z, rest);
        return ((quadrant & 2) != 0) != negative ? -part : part;
    }
    Real even(const Real& z) const {
        Real p = z * 2.443315711809948e-5F + -1.388731625493765e-3F;
        p = p * z + 4.166664568298827e-2F;
        p = p * z;
        p = p * z;
        p = p - z * 0.5F;
        return p + 1.0F;
    }
    Real odd(const Real& z, const Real& rest) const {
        Real q = z * -1.9515295891e-4F + 8.3321608736e-3F;
        q = q * z + -1.6666654611e-1F;
        q = q * z;
        return q * rest + rest;
    }

    R& r;
    bool driver_;
    Draw draw_;
};

} // namespace lockstep::dust
