#pragma once
#include <array>

#include "reference/lifecycle/particle.hpp"

/// How a particle looks at its age. Twin of shaders/lifecycle/appearance.glsl.
namespace lockstep::lifecycle {

/// 0 at birth, 1 at death, and where it has no lifetime.
template <class R> typename R::Real age_of(R& r, const Particle<R>& particle) {
    using Real = typename R::Real;
    const Real life = particle.lifetime();
    Real t(1.0F);
    if (r.decide(site::has_life, life < 0.0F || life > 0.0F)) {
        t = Real(1.0F) - r.divide(site::age, particle.remaining(), life);
        t = r.monotone(t, [](float f) { return f > 0.0F ? (f < 1.0F ? f : 1.0F) : 0.0F; });
    }
    return r.note(site::age, t);
}

template <class R> typename R::Real size_of(R& r, const Particle<R>& particle) {
    const auto both = particle.sizes();
    return r.note(site::size, both[0] + age_of(r, particle) * (both[1] - both[0]));
}

/// Red, green, blue, opacity.
template <class R> typename R::Vec4 color_of(R& r, const Particle<R>& particle) {
    const auto first = particle.color(false), end = particle.color(true);
    const auto t = age_of(r, particle);
    const auto at = [&](std::size_t c) { return first[c] + t * (end[c] - first[c]); };
    return r.note(site::tint, typename R::Vec4{at(0), at(1), at(2), at(3)});
}

} // namespace lockstep::lifecycle
