#pragma once
#include <array>
#include <cmath>
#include <cstdint>

#include "reference/system/field_sites.hpp"
#include "reference/system/pcg3d.hpp"

/// Gradient noise (Perlin, "Improving noise", 2002) with its analytic derivatives, and the curl of three of them
/// (Bridson, "Curl-noise for procedural fluid flow", 2007). Twin of shaders/noise.glsl.
namespace lockstep {

/// One of Perlin's 16 edge directions.
constexpr std::array<float, 3> edge_of(std::uint32_t h) {
    std::array<float, 3> g{};
    const std::size_t first = h < 8 ? 0 : 1, second = h < 4 ? 1 : h == 12 || h == 14 ? 0 : 2;
    g[first] = (h & 1U) == 0 ? 1.0F : -1.0F;
    g[second] = (h & 2U) == 0 ? 1.0F : -1.0F;
    return g;
}

/// Whether there is noise at a place: beyond, cells are no whole numbers.
template <class R> bool in_noise(R& r, const typename R::Vec3& x) {
    constexpr float most = 4194304.0F;
    return r.decide(field_site::is_in_noise, r.abs(x.x) < most) &&
           r.decide(field_site::is_in_noise, r.abs(x.y) < most) && r.decide(field_site::is_in_noise, r.abs(x.z) < most);
}

template <class R> class Noise {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;
    using Corners = std::array<Real, 8>;

  public:
    Noise(R& reading, std::uint32_t seed) : r(reading), seed_(seed) {}

    /// The gradient of psi_1, psi_2 or psi_3 at a place, and its value.
    struct Sample {
        Vec3 gradient;
        Real value;
    };
    std::array<Sample, 3> all(const Vec3& x) const {
        const Cell cell = cell_of(x);
        return {of(cell, 0), of(cell, 1), of(cell, 2)};
    }

    Vec3 analytic_curl(const Vec3& x) const {
        const auto psi = all(x);
        const Vec3 &d1 = psi[0].gradient, &d2 = psi[1].gradient, &d3 = psi[2].gradient;
        return {d3.y - d2.z, d1.z - d3.x, d2.x - d1.y};
    }

    /// All three, at a place.
    Vec3 potentials(const Vec3& x) const {
        const auto psi = all(x);
        return {psi[0].value, psi[1].value, psi[2].value};
    }

    Vec3 difference_curl(const Vec3& x) const {
        constexpr float h = 0.015625F;
        const Real zero(0.0F);
        const Vec3 dx = slope(x, {Real(h), zero, zero}), dy = slope(x, {zero, Real(h), zero}),
                   dz = slope(x, {zero, zero, Real(h)});
        return {dy.z - dz.y, dz.x - dx.z, dx.y - dy.x};
    }

  private:
    struct Cell {
        std::array<Bits3, 8> hash;
        Vec3 at;
    };

    Cell cell_of(const Vec3& x) const {
        Cell cell;
        const Vec3 corner{r.floor(x.x), r.floor(x.y), r.floor(x.z)};
        const auto whole = [&](const Real& c) {
            return static_cast<std::uint32_t>(static_cast<int>(r.to_int(field_site::cell, c)));
        };
        const Bits3 i{whole(corner.x), whole(corner.y), whole(corner.z)};
        cell.at = x - corner;
        for (std::uint32_t k = 0; k < 8; ++k) {
            cell.hash[k] = pcg3d({i[0] + (k & 1U), i[1] + (k >> 1U & 1U), (i[2] + (k >> 2U)) ^ seed_});
            for (std::uint32_t& bits : cell.hash[k])
                bits >>= 28U;
        }
        return cell;
    }

    static Real lerp(const Real& a, const Real& b, const Real& t) { return a + (b - a) * t; }
    static Real trilerp(const Corners& c, const Vec3& t) {
        const Real y0 = lerp(lerp(c[0], c[1], t.x), lerp(c[2], c[3], t.x), t.y);
        const Real y1 = lerp(lerp(c[4], c[5], t.x), lerp(c[6], c[7], t.x), t.y);
        return lerp(y0, y1, t.z);
    }
    static Real fade(const Real& w) { return ((w * w) * w) * (w * (w * 6.0F - 15.0F) + 10.0F); }
    static Real fade_slope(const Real& w) { return ((w * w) * 30.0F) * (w * (w - 2.0F) + 1.0F); }

    Sample of(const Cell& cell, std::size_t which) const {
        Corners value, gx, gy, gz;
        for (std::uint32_t k = 0; k < 8; ++k) {
            const std::array<float, 3> g = edge_of(cell.hash[k][which]);
            const Vec3 d{cell.at.x - static_cast<float>(k & 1U), cell.at.y - static_cast<float>(k >> 1U & 1U),
                         cell.at.z - static_cast<float>(k >> 2U)};
            gx[k] = Real(g[0]);
            gy[k] = Real(g[1]);
            gz[k] = Real(g[2]);
            value[k] = (gx[k] * d.x + gy[k] * d.y) + gz[k] * d.z;
        }
        const Vec3 u = r.note(field_site::fade, Vec3{fade(cell.at.x), fade(cell.at.y), fade(cell.at.z)});
        const Corners& v = value;
        const Real dx = lerp(lerp(v[1] - v[0], v[3] - v[2], u.y), lerp(v[5] - v[4], v[7] - v[6], u.y), u.z);
        const Real dy = lerp(lerp(v[2] - v[0], v[3] - v[1], u.x), lerp(v[6] - v[4], v[7] - v[5], u.x), u.z);
        const Real dz = lerp(lerp(v[4] - v[0], v[5] - v[1], u.x), lerp(v[6] - v[2], v[7] - v[3], u.x), u.y);
        return {r.note(field_site::noise,
                       Vec3{trilerp(gx, u) + fade_slope(cell.at.x) * dx, trilerp(gy, u) + fade_slope(cell.at.y) * dy,
                            trilerp(gz, u) + fade_slope(cell.at.z) * dz}),
                trilerp(value, u)};
    }

    Vec3 slope(const Vec3& x, const Vec3& h) const { return (potentials(x + h) - potentials(x - h)) * 32.0F; }

    R& r;
    std::uint32_t seed_;
};

} // namespace lockstep
