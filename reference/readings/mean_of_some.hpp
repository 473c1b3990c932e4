#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "reference/interval.hpp"

namespace lockstep {

/// What a weighted mean is made of: a value, a weight from 0 on, and whether it may as well be left out.
struct WeightedTerm {
    Interval value, weight;
    bool open = false;
};

namespace mean_of_some_rules {

/// The greatest mean of `sign` times the values. A weight that a value above the mean has is as great as it can be, and
/// one that a value below it has as small: so the values, sorted, are cut in two.
inline double greatest(std::span<const WeightedTerm> terms, double sign) {
    struct One {
        double value, least, most;
    };
    std::vector<One> sorted;
    double weighted = 0.0, weights = 0.0;
    for (const WeightedTerm& term : terms) {
        const One one{sign > 0.0 ? term.value.high : -term.value.low, term.open ? 0.0 : std::max(term.weight.low, 0.0),
                      term.weight.high};
        weighted += one.value * one.least;
        weights += one.least;
        sorted.push_back(one);
    }
    std::ranges::sort(sorted, [](const One& a, const One& b) { return a.value > b.value; });
    double best = weights > 0.0 ? weighted / weights : -HUGE_VAL;
    for (const One& one : sorted) {
        weighted += one.value * (one.most - one.least);
        weights += one.most - one.least;
        if (weights > 0.0)
            best = std::max(best, weighted / weights);
    }
    return best;
}

} // namespace mean_of_some_rules

/// What sum(value weight) / sum(weight) may give, added up one after another in floats, whichever of the open terms are
/// left out. Each product and weight is of at most three roundings, and n - 1 additions come to (n - 1) u / (1 - (n -
/// 1) u) of the sum of magnitudes (Higham, Accuracy and Stability of Numerical Algorithms, section 4.2), u being 2^-23
/// where additions may be cut; the quotient is right to 2.5 ULP (GLSL 4.50, 4.7.1). Anything where a term is no finite
/// number or no term must be there.
inline Interval mean_of_some(std::span<const WeightedTerm> terms) {
    using namespace mean_of_some_rules;
    double largest = 0.0, surely = 0.0;
    bool is_any = std::ranges::none_of(terms, [](const WeightedTerm& t) { return !t.open && t.weight.low > 0.0; });
    for (const WeightedTerm& term : terms) {
        is_any = is_any || term.value.any || term.weight.any || !std::isfinite(term.value.low + term.value.high) ||
                 !std::isfinite(term.weight.low + term.weight.high);
        largest = std::max({largest, std::abs(term.value.low), std::abs(term.value.high)});
        surely += term.open ? 0.0 : term.weight.low;
    }
    const double n = static_cast<double>(terms.size()) * 0x1p-23;
    if (is_any || n >= 0.5)
        return Interval::anything();
    // Of the sum above and of that below, and of the quotient; and what may be flushed.
    const double flushed = 2.0 * static_cast<double>(terms.size()) * 0x1p-126 * (1.0 + largest) / surely;
    const double rounded = (2.0 * (n / (1.0 - n) + 3.0 * 0x1p-23) + 3.0 * 0x1p-23) * largest;
    const double error = rounded * (1.0 + 0x1p-20) + flushed;
    return interval::to_floats(interval::outward(-greatest(terms, -1.0) - error, greatest(terms, 1.0) + error));
}

} // namespace lockstep
