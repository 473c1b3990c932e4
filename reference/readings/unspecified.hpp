#pragma once
#include <cmath>

#include "reference/interval.hpp"
#include "reference/readings/site.hpp"

namespace lockstep {

/// R::unspecified of a set of floats, which may be all.
template <class R, class Real> Real unspecified_within(R& r, At at, const Real& value, const Interval& set) {
    return r.unspecified(at, value, set.any ? -HUGE_VALF : static_cast<float>(set.low),
                         set.any ? HUGE_VALF : static_cast<float>(set.high));
}

} // namespace lockstep
