#pragma once
#include "reference/numbers.hpp"
#include "reference/readings/site.hpp"

namespace lockstep {

/// A reading of many items at once (lanes.hpp).
template <class R>
concept HasLanes = requires {
    typename R::Index;
};

/// What a reading counts pixels by: an int, or one a lane.
template <class R> struct PixelIndex { using Type = int; };
template <HasLanes R> struct PixelIndex<R> { using Type = typename R::Index; };
template <class R> using IndexOf = typename PixelIndex<R>::Type;

// An `if` on data of which both ways are computed, and one is chosen: where a reading has lanes, lane by lane.

/// What R::decide says; of lanes what each says.
template <class R, class Condition> auto decided(R& r, At place, const Condition& condition) {
    if constexpr (HasLanes<R>)
        return typename R::Mask(condition);
    else
        return r.decide(place, condition);
}

/// A decision that no number takes part in: lanes that would go another way drop out.
template <class R, class Condition> bool agreed(R& r, At place, const Condition& condition) {
    if constexpr (HasLanes<R>)
        return r.decide(place, condition);
    else
        return condition;
}

inline bool everywhere(bool decision) { return decision; }
inline bool nowhere(bool decision) { return !decision; }

} // namespace lockstep
