#pragma once
#include <optional>

#include "reference/readings/site.hpp"

namespace lockstep {

/// a / b, where the shader's text says what b is: `constant`, if it does. GLSL gives a quotient 2.5 ULP (4.50, 4.7.1),
/// so a compiler may write a * (1 / b) for it, 1 / b rounded, and still divide by what it does not know: a reading that
/// has `by_reciprocal` says which.
template <class R, class Real>
Real quotient_of(R& r, At place, const Real& a, const Real& b, std::optional<float> constant) {
    if constexpr (requires { r.by_reciprocal(place, 1.0F); })
        if (constant && r.by_reciprocal(place, *constant))
            return a * Real(1.0F / *constant);
    return r.divide(place, a, b);
}

/// x / c, where c is a constant of the shader's text.
template <class R, class Real> Real divided_by(R& r, At place, const Real& x, float c) {
    return quotient_of(r, place, x, Real(c), c);
}

} // namespace lockstep
