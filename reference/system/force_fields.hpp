#pragma once
#include "reference/system/noise.hpp"

/// What accelerates a particle at a place. Twin of shaders/force_fields.glsl.
namespace lockstep {

template <class Vec> Vec cross_of(const Vec& a, const Vec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// How much of a force is left at a distance: (1 - l / radius)^exponent, of 0, 1 or 2.
template <class R>
typename R::Real force_left(R& r, const typename R::Real& l, const typename R::Real& radius, int exponent) {
    using Real = typename R::Real;
    const Real left = r.note(field_site::left_of_force, Real(1.0F) - r.divide(field_site::left_of_force, l, radius));
    const Real base = r.decide(field_site::is_in_reach, left > 0.0F) ? left : Real(0.0F);
    return exponent == 0 ? Real(1.0F) : exponent == 1 ? base : base * base;
}

/// Around an axis of length 1.
template <class R> struct Vortex {
    typename R::Vec3 centre, axis;
    typename R::Real strength, radius, pull;
    int exponent = 1;

    /// `a` with it.
    typename R::Vec3 added(R& r, const typename R::Vec3& a, const typename R::Vec3& p) const {
        using Vec3 = typename R::Vec3;
        using Real = typename R::Real;
        namespace site = field_site;
        const Vec3 way = r.note(site::to_centre, p - centre);
        const Vec3 q = r.note(site::across, way - axis * r.note(site::along_axis, r.dot(site::along_axis, axis, way)));
        const Real l = r.note(site::distance, r.length(site::distance, q));
        if (!r.decide(site::is_off_axis, l > 0.0F))
            return a;
        const Real f = force_left(r, l, radius, exponent);
        const Vec3 swirl = cross_of(axis, q) * r.divide(site::swirl, strength * f, l);
        const Vec3 turned = a + r.note(site::swirl, swirl);
        const Vec3 sink = q * r.divide(site::sink, pull * f, l);
        return turned - r.note(site::sink, sink);
    }
};

/// Towards a point.
template <class R> struct Attraction {
    typename R::Real strength, radius, square; ///< square: of the softening, where `inverse_square`
    int exponent = 1;
    bool inverse_square = false;

    /// `a` with it; `way`: to the point, `l` long.
    typename R::Vec3 added(R& r, const typename R::Vec3& a, const typename R::Vec3& way,
                           const typename R::Real& l) const {
        using Real = typename R::Real;
        namespace site = field_site;
        if (!r.decide(site::is_off_centre, l > 0.0F))
            return a;
        Real share;
        if (inverse_square) {
            const Real q = r.note(site::spread, r.dot(site::spread, way, way) + square);
            share = r.divide(site::attraction, strength, q * r.sqrt(site::spread, q));
        } else {
            share = r.divide(site::attraction, strength * force_left(r, l, radius, exponent), l);
        }
        return a + r.note(site::attraction, way * share);
    }
};

/// The curl of the noise at a place of it; `difference`: by differences instead of derivatives.
template <class R> typename R::Vec3 curl_noise(R& r, const typename R::Vec3& x, const typename R::Real& strength,
                                               std::uint32_t seed, bool difference) {
    if (!in_noise(r, x))
        return {};
    const Noise<R> noise(r, seed);
    return r.note(field_site::curl, difference ? noise.difference_curl(x) : noise.analytic_curl(x)) * strength;
}

} // namespace lockstep
