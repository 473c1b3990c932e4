#pragma once
#include "reference/readings/site.hpp"

namespace lockstep {

/// x / c, where c is a constant of the shader's text. GLSL gives a quotient 2.5 ULP (4.50, 4.7.1), so a compiler may
/// write x * (1 / c) for it, 1 / c rounded, and still divide by what it does not know: a reading that has
/// `by_reciprocal` says which.
template <class R, class Real> Real divided_by(R& r, At place, const Real& x, float c) {
    if constexpr (requires { r.by_reciprocal(place); })
        if (r.by_reciprocal(place))
            return x * Real(1.0F / c);
    return r.divide(place, x, Real(c));
}

} // namespace lockstep
