#pragma once
#include <utility>

#include "reference/system/field_sites.hpp"

/// Twin of shaders/turns.glsl.
namespace lockstep {

/// Sine and cosine of x turns, of rounded operations alone: within 1.7 * 2^-24.
template <class R> std::pair<typename R::Real, typename R::Real> sine_cosine(R& r, const typename R::Real& x) {
    using Real = typename R::Real;
    const Real turn = x - r.floor(x + 0.5F);
    const Real quarters = r.floor(turn * 4.0F + 0.5F);
    const Real f = turn - quarters * 0.25F;
    const Real z = f * f;
    const Real s = f * ((((z * 42.0586929F + -76.7058563F) * z + 81.6052475F) * z + -41.3417015F) * z + 6.28318548F);
    const Real c = (((z * 60.2446404F + -85.4568176F) * z + 64.9393921F) * z + -19.7392082F) * z + 1.0F;
    switch (static_cast<int>(r.to_int(field_site::quarter, quarters)) & 3) {
    case 0:
        return {s, c};
    case 1:
        return {c, -s};
    case 2:
        return {-s, -c};
    default:
        return {-c, s};
    }
}

/// A place on the unit sphere: z, and around it in turns.
template <class R> typename R::Vec3 on_circle(R& r, const typename R::Real& z, const typename R::Real& turns) {
    using Real = typename R::Real;
    const Real radius = r.note(field_site::circle, r.sqrt(field_site::circle, Real(1.0F) - z * z));
    const auto [sine, cosine] = sine_cosine(r, r.note(field_site::turns, turns));
    return {radius * cosine, radius * sine, z};
}

} // namespace lockstep
