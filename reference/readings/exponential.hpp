#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "reference/interval.hpp"
#include "reference/model/exponential.hpp"
#include "reference/readings/site.hpp"
#include "reference/readings/unspecified.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep {

/// e^x of x <= 0 by + - * (model/exponential.hpp), 0 below -87. Twin of ls_exp in shaders/exponential.glsl.
template <class R, class Real> Real portable_exponential(R& r, At reaches, const Real& x) {
    if (!r.decide(reaches, x >= Real(least_exponent)))
        return Real(0.0F);
    return exponential(
        x, [&](const Real& v) { return r.floor(v); },
        [&](const Real& p, const Real& j) {
            // In two steps: 2^-126 itself counts as 0 in the portable arithmetic.
            const int n = static_cast<int>(r.to_int(reaches, j)), half = n / 2;
            return p * Real(std::ldexp(1.0F, half)) * Real(std::ldexp(1.0F, n - half));
        });
}

namespace exponential_rules {

/// What exp2 may give of an interval, e^x being it too: 3 + 2 |x| ULP (GLSL 4.50, 4.7.1).
template <class Function> Interval widened(double low, double high, const Function& f) {
    const auto end = [&](double x, double sign) {
        const double right = f(x);
        return right + sign * (3.0 + 2.0 * std::abs(x)) * interval::ulp(right);
    };
    return {std::max(end(low, -1.0), 0.0), end(high, 1.0)};
}

template <class R, class Real> Real legal(R& r, At at, double value, const Interval& set) {
    return unspecified_within(r, at, Real(static_cast<float>(value)), set);
}

template <class R, class Real> Real anything(R& r, At at, double value) {
    return legal<R, Real>(r, at, value, {-HUGE_VAL, HUGE_VAL});
}

} // namespace exponential_rules

/// e^x, the nearest float or one beside it, as lanes have it too (system/lane_items.hpp).
inline float exponential_value(float x) {
    if (!(x >= least_exponent && x <= 0.0F))
        return static_cast<float>(std::exp(double{x}));
    return exponential(
        x, [](float v) { return std::floor(v); }, [](float p, float j) { return std::ldexp(p, static_cast<int>(j)); });
}

/// GLSL's exp.
template <class R, class Real> Real built_in_exponential(R& r, At at, const Real& x) {
    const Interval set = item_twin::set_of(x);
    if (set.any)
        return exponential_rules::anything<R, Real>(r, at, 0.0);
    Interval legal{0.0, 0.0};
    if constexpr (requires { x.legal(); })
        legal = exponential_rules::widened(set.low, set.high, [](double v) { return std::exp(v); });
    return exponential_rules::legal<R, Real>(r, at, exponential_value(set.as_float()), legal);
}

/// x^n of 1 <= n < 1024: the squares that make it up, the largest first.
template <class Real> Real product_power(const Real& x, int n) {
    std::array<Real, 10> square{x};
    for (std::size_t i = 1; i < square.size(); ++i)
        square[i] = square[i - 1] * square[i - 1];
    std::size_t i = square.size() - 1;
    while ((n >> i & 1) == 0)
        --i;
    Real product = square[i];
    while (i-- > 0)
        if ((n >> i & 1) != 0)
            product = product * square[i];
    return product;
}

/// GLSL's pow of x >= 0: exp2(n log2(x)), log2 being right to 3 ULP, or to 2^-21 from 1/2 to 2 (GLSL 4.50, 4.7.1).
template <class R, class Real> Real built_in_power(R& r, At at, const Real& x, int n) {
    const Interval set = item_twin::set_of(x);
    if (set.any)
        return exponential_rules::anything<R, Real>(r, at, 0.0);
    const auto end = [&](double base, double sign) {
        const double logarithm = std::log2(base);
        const double error = base >= 0.5 && base <= 2.0 ? 0x1p-21 : 3.0 * interval::ulp(logarithm);
        const double product = n * (logarithm + sign * error);
        return product + sign * interval::ulp(product);
    };
    const auto f = [](double v) { return std::exp2(v); };
    Interval legal{0.0, 0.0};
    if (set.high > 0.0)
        legal = exponential_rules::widened(set.low > 0.0 ? end(set.low, -1.0) : -200.0, end(set.high, 1.0), f);
    if (!(set.low > 0.0))
        legal.low = 0.0;
    return exponential_rules::legal<R, Real>(r, at, std::pow(std::max(double{set.as_float()}, 0.0), n), legal);
}

} // namespace lockstep
