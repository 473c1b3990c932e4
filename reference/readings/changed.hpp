#pragma once
#include <algorithm>
#include <utility>

#include "reference/readings/condition.hpp"
#include "reference/readings/mistake.hpp"
#include "reference/readings/number.hpp"
#include "reference/readings/values.hpp"

/// What a change makes of one value, one comparison, one loop.
namespace lockstep {

template <class Int> IntRange<Int> changed_turns(Change change, int first, int last) {
    const int middle = first + (last - first) / 2;
    switch (change) {
    case Change::backwards:
        return {last, first, -1};
    case Change::first_skipped:
        return {first + 1, last};
    case Change::last_skipped:
        return {first, last - 1};
    case Change::first_alone:
        return {first, std::min(first, last)};
    case Change::last_alone:
        return {std::max(first, last), last};
    case Change::first_half:
        return {first, std::min(middle, last)};
    case Change::last_half:
        return {middle, last};
    case Change::every_second:
        return {first, last < first ? last : last - (last - first) % 2, 2};
    default:
        return {first, last};
    }
}

/// `change`: which of x, y and z are swapped.
template <class T> void reorder(T& x, T& y, T& z, Change change) {
    if (change == Change::rotated)
        std::swap(x, y);
    if (change == Change::xz_swapped || change == Change::rotated_back)
        std::swap(x, z);
    if (change != Change::xz_swapped)
        std::swap(y, z);
}

/// `other`: the value of another site.
template <class A> float changed_value(Change change, float x, float other) {
    switch (change) {
    case Change::zero:
        return 0.0F;
    case Change::one:
        return 1.0F;
    case Change::negated:
        return -x;
    case Change::doubled:
        return x * 2.0F;
    case Change::halved:
        return x * 0.5F;
    case Change::reciprocal:
        return 1.0F / x;
    case Change::opposite:
        return 1.0F - x;
    case Change::one_more:
        return x + 1.0F;
    case Change::one_less:
        return x - 1.0F;
    case Change::half_more:
        return x + 0.5F;
    case Change::half_less:
        return x - 0.5F;
    case Change::instead:
        return other;
    case Change::plus:
        return A::flush(x + other);
    case Change::minus:
        return A::flush(x - other);
    case Change::times:
        return static_cast<float>(NumberOf<A>(x) * NumberOf<A>(other));
    default:
        return x;
    }
}

inline float changed_right(float b, Change change) {
    switch (change) {
    case Change::right_zero:
        return 0.0F;
    case Change::right_doubled:
        return b * 2.0F;
    case Change::right_halved:
        return b * 0.5F;
    default:
        return b;
    }
}
inline bool changed_order_holds(float a, float b, CompareOp op, Change change) {
    if (change == Change::differs)
        return a != b;
    const bool or_equal = (op == CompareOp::less_equal) != (change == Change::or_equal);
    if (change == Change::reversed)
        return or_equal ? a >= b : a > b;
    return or_equal ? a <= b : a < b;
}
template <class Real> bool changed_answer(const OpenComparison<Real>& c, Change change) {
    const float a = change == Change::left_zero ? 0.0F : static_cast<float>(c.a);
    const float b = changed_right(static_cast<float>(c.b), change);
    switch (c.op) {
    case CompareOp::less:
    case CompareOp::less_equal:
        return changed_order_holds(a, b, c.op, change) != c.negated;
    case CompareOp::equal:
        if (change == Change::at_most || change == Change::at_least)
            return (change == Change::at_most ? a <= b : a >= b) != c.negated;
        return (a == b) != (c.negated != (change == Change::reversed));
    case CompareOp::always:
    case CompareOp::never:
        break;
    }
    return (c.op == CompareOp::always) != c.negated;
}

} // namespace lockstep
