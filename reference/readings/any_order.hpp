#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "reference/interval.hpp"

namespace lockstep {

/// The sum of floats whose partial sums are all floats, whatever the order: multiples of one power of two, whose
/// magnitudes add up to at most 2^24 of it. Nothing where that is not so.
inline std::optional<float> exact_sum(std::span<const Interval> terms) {
    int lowest = 128;
    double sum = 0.0, magnitude = 0.0;
    for (const Interval& term : terms) {
        if (!term.is_point() || !std::isfinite(term.low))
            return {};
        if (term.low == 0.0)
            continue;
        int exponent = 0;
        auto digits = static_cast<std::int64_t>(std::ldexp(std::frexp(term.low, &exponent), 53));
        for (exponent -= 53; digits % 2 == 0; digits /= 2)
            ++exponent;
        lowest = std::min(lowest, exponent);
        sum += term.low;
        magnitude += std::abs(term.low);
    }
    const bool exact = magnitude == 0.0 || (lowest >= -126 && magnitude <= std::ldexp(1.0, lowest + 24));
    return exact ? std::optional(static_cast<float>(sum)) : std::nullopt;
}

/// What a sum may give whose terms are added one after another in an order that nothing fixes, as atomics and blending
/// add them. `arithmetic` (LegalArithmetic) says what one addition gives.
///
/// Up to ten terms: exactly the ends of all orders. Rounding is monotone, so the least sum of a set of terms is the
/// least over its last term of what the others' least gives with it. Beyond: the bound (n - 1) u / (1 - (n - 1) u)
/// times the sum of magnitudes (Higham, Accuracy and Stability of Numerical Algorithms, section 4.2), and what may be
/// flushed.
template <class Arithmetic> Interval any_order_sum(const Arithmetic& arithmetic, std::span<const Interval> terms) {
    constexpr std::size_t most_exact = 10;
    if (terms.empty())
        return {0.0F};
    if (std::any_of(terms.begin(), terms.end(), [](const Interval& t) { return t.any || std::isnan(t.low); }))
        return Interval::anything();
    if (const auto sum = exact_sum(terms))
        return {*sum};
    const std::size_t n = terms.size();
    if (n <= most_exact) {
        std::vector<Interval> sums(std::size_t{1} << n);
        for (std::size_t set = 1; set < sums.size(); ++set) {
            bool first = true;
            for (std::size_t last = 0; last < n; ++last) {
                const std::size_t bit = std::size_t{1} << last;
                if ((set & bit) == 0)
                    continue;
                const Interval sum = set == bit ? terms[last] : arithmetic.sum(sums[set - bit], terms[last]);
                sums[set] = first ? sum : interval::hull(sums[set], sum);
                first = false;
            }
        }
        return sums.back();
    }
    Interval total(0.0F);
    double magnitude = 0.0;
    for (const Interval& term : terms) {
        total = interval::add(total, term);
        magnitude = interval::above(magnitude + std::max(std::abs(term.low), std::abs(term.high)));
    }
    const double u = arithmetic.known().sums ? 0x1p-24 : 0x1p-23;
    const double additions = static_cast<double>(n - 1);
    if (total.any || additions * u >= 0.5 || magnitude * 2.0 > double{std::numeric_limits<float>::max()})
        return Interval::anything();
    const double flushed = additions * double{std::numeric_limits<float>::min()};
    const double error = interval::above(additions * u / (1.0 - additions * u) * magnitude) + flushed;
    return interval::to_floats(interval::outward(total.low - error, total.high + error));
}

} // namespace lockstep
