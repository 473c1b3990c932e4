#pragma once
#include <cmath>
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
        if constexpr (requires { r.foretell(draw_); })
            r.foretell(draw_);
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
        if (driver_)
            return r.note(site::sine, of_driver(site::sine, x, 0));
        const bool negative = r.decide(site::below_zero, x < 0.0F);
        return r.note(site::sine, signed_part(x, 0, negative));
    }
    Real cosine(const Real& x) const {
        return r.note(site::cosine, driver_ ? of_driver(site::cosine, x, 1) : signed_part(x, 1, false));
    }

  private:
    static constexpr float rd1 = 7.8671F, rd2 = 3.3419F, rp1 = 2.1759F, rp2 = 4.7921F;

    /// The driver's own sine is any number: GLSL gives it no precision. The reference's is llvmpipe's, where the
    /// processor has fused products.
    Real of_driver(At place, const Real& x, int quarter) const {
        return r.unspecified(place, r.monotone(x, [quarter](float v) { return fused_part(v, quarter); }), -1.0F, 1.0F);
    }

    Real hashed(const Real& argument) const {
        const Real a = sine(r.note(site::phase, argument)) * 39482.17593F;
        const Real share = a - r.floor(a);
        return r.note(site::random, driver_ ? r.unspecified(site::random, share, 0.0F, 1.0F) : share);
    }

    /// Cody and Waite's reduction to an eighth of a turn, then a polynomial; each operation rounded.
    Real signed_part(const Real& x, int quarter, bool negative) const {
        const Real size = r.abs(x), eighths = size * 1.27323954473516F;
        if constexpr (requires { eighths.set(); })
            if (spreads(eighths.set()))
                return r.unspecified(site::octant, eighths, -1.0F, 1.0F);
        const int whole = r.to_int(site::octant, eighths);
        const int j = (whole + 1) & ~1;
        const Real part = part_of(size, r.real(j), j / 2 + quarter,
                                  [](const Real& a, const Real& b, const Real& c) { return a * b + c; });
        return is_negative(j / 2 + quarter, negative) ? -part : part;
    }
    /// Whether a set has angles all around, of which nothing follows but that a sine is one.
    template <class Set> static bool spreads(const Set& eighths) {
        return !eighths.any && eighths.high - eighths.low >= 3.0 && eighths.high < 0x1p30;
    }
    /// The same with each product fused into its sum.
    static float fused_part(float x, int quarter) {
        const float size = std::abs(x), eighths = size * 1.27323954473516F;
        const int j = eighths < 1e9F ? (static_cast<int>(eighths) + 1) & ~1 : 0;
        const float part = part_of(size, static_cast<float>(j), j / 2 + quarter,
                                   [](float a, float b, float c) { return std::fma(a, b, c); });
        return is_negative(j / 2 + quarter, quarter == 0 && x < 0.0F) ? -part : part;
    }
    static bool is_negative(int quadrant, bool negative) { return ((quadrant & 2) != 0) != negative; }

    template <class Number, class Mad>
    static Number part_of(const Number& size, const Number& eighths, int quadrant, const Mad& mad) {
        Number rest = mad(eighths, Number(-0.78515625F), size);
        rest = mad(eighths, Number(-2.4187564849853515625e-4F), rest);
        rest = mad(eighths, Number(-3.77489497744594108e-8F), rest);
        const Number z = rest * rest;
        if ((quadrant & 1) != 0) {
            Number p = mad(z, Number(2.443315711809948e-5F), Number(-1.388731625493765e-3F));
            p = mad(p, z, Number(4.166664568298827e-2F));
            p = p * z;
            p = p * z;
            p = p - z * Number(0.5F);
            return p + Number(1.0F);
        }
        Number q = mad(z, Number(-1.9515295891e-4F), Number(8.3321608736e-3F));
        q = mad(q, z, Number(-1.6666654611e-1F));
        q = q * z;
        return mad(q, rest, rest);
    }

    R& r;
    bool driver_;
    Draw draw_;
};

} // namespace lockstep::dust
