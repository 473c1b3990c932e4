#include "reference/text/function_precision.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <numbers>

namespace lockstep::text {
namespace {

constexpr double pi = std::numbers::pi;
/// Of sin and cos between -pi and pi, and of what Vulkan derives of atan.
constexpr double angle_error = 0x1p-11, arc_ulps = 4096.0;

/// `error(value)`: by how much a result may be off.
template <class Error> Interval around(double low, double high, const Error& error) {
    if (std::isnan(low) || std::isnan(high))
        return Interval::anything();
    return interval::outward(low - error(low), high + error(high));
}

Interval within(Interval v, double lowest, double highest) {
    return v.any ? v : Interval(std::clamp(v.low, lowest, highest), std::clamp(v.high, lowest, highest));
}

/// (3 + 2 |x|) ULP of exp and exp2.
template <class Function> Interval exponential(Interval x, const Function& f) {
    const auto end = [&](double at, double sign) {
        const double value = f(at);
        return value + sign * (3.0 + 2.0 * std::abs(at)) * interval::ulp(value);
    };
    return {std::max(end(x.low, -1.0), 0.0), end(x.high, 1.0)};
}

/// 3 ULP of log and log2, between 1/2 and 2 an absolute error of 2^-21.
template <class Function> Interval logarithm(Interval x, const Function& f) {
    if (x.low < 0.0 || x.high <= 0.0 || x.low == 0.0)
        return Interval::anything();
    const auto end = [&](double at, double sign) {
        const double value = f(at);
        return value + sign * (at >= 0.5 && at <= 2.0 ? 0x1p-21 : 3.0 * interval::ulp(value));
    };
    return {end(x.low, -1.0), end(x.high, 1.0)};
}

/// sin of a set, without an error. cos(x) is sin(x + pi / 2).
Interval sine(double low, double high) {
    if (high - low >= 2.0 * pi)
        return {-1.0, 1.0};
    const auto holds = [&](double top) {
        return std::floor((high - top) / (2.0 * pi)) > std::floor((low - top) / (2.0 * pi));
    };
    const double a = std::sin(low), b = std::sin(high);
    return {holds(-0.5 * pi) ? -1.0 : std::min(a, b), holds(0.5 * pi) ? 1.0 : std::max(a, b)};
}

/// Beyond pi the angle itself is rounded where it is reduced.
Interval with_angle_error(Interval exact, Interval x) {
    const double largest = std::max(std::abs(x.low), std::abs(x.high));
    const double error = angle_error + (largest > pi ? largest * 0x1p-22 : 0.0);
    return within({exact.low - error, exact.high + error}, -1.0, 1.0);
}

Interval sine_of(Interval x) { return with_angle_error(sine(x.low, x.high), x); }
Interval cosine_of(Interval x) { return with_angle_error(sine(x.low + 0.5 * pi, x.high + 0.5 * pi), x); }

double arc_error(double value) { return arc_ulps * interval::ulp(value); }
/// asin and acos, of which Vulkan says atan(x, sqrt(1 - x x)): near 1 the root is off by as much as sin and cos are.
double arc_error_by_root(double value) { return angle_error + arc_error(value); }

/// (e^x - e^-x) / 2 and its like, by what exp may give.
Interval hyperbolic(Interval x, double sign) {
    const auto end = [&](double at) {
        const Interval a = exponential({at, at}, [](double v) { return std::exp(v); });
        const Interval b = exponential({-at, -at}, [](double v) { return std::exp(v); });
        const Interval other = sign < 0.0 ? Interval(-b.high, -b.low) : b;
        const double low = 0.5 * (a.low + other.low), high = 0.5 * (a.high + other.high);
        return Interval(low - interval::ulp(low), high + interval::ulp(high));
    };
    const Interval low = end(x.low), high = end(x.high);
    Interval both(std::min(low.low, high.low), std::max(low.high, high.high));
    if (sign > 0.0 && x.contains_zero())
        both.low = std::min(both.low, end(0.0).low);
    return both;
}

/// pow(x, y) = exp2(y log2(x)).
Interval power(Interval x, Interval y) {
    if (x.low < 0.0 || (x.low == 0.0 && y.low <= 0.0))
        return Interval::anything();
    const auto exponent = [&](double base, double sign) {
        const Interval known = logarithm({base, base}, [](double v) { return std::log2(v); });
        return sign < 0.0 ? known.low : known.high;
    };
    constexpr double below_all = -200.0; // 2^-200 is 0
    Interval product;
    if (x.high == 0.0)
        return {0.0, 0.0};
    const double least = x.low == 0.0 ? -HUGE_VAL : exponent(x.low, -1.0), most = exponent(x.high, 1.0);
    const double ends[] = {y.low * least, y.high * least, y.low * most, y.high * most};
    product = {*std::min_element(std::begin(ends), std::end(ends)),
               *std::max_element(std::begin(ends), std::end(ends))};
    if (std::isnan(product.low) || std::isnan(product.high))
        return Interval::anything();
    product = {std::max(product.low - interval::ulp(product.low), below_all),
               product.high + interval::ulp(product.high)};
    Interval result = exponential(product, [](double v) { return std::exp2(v); });
    if (x.low == 0.0 || product.low == below_all)
        result.low = 0.0;
    return result;
}

} // namespace

Interval legal_function(GLSLstd450 function, Interval x) {
    if (x.any || !std::isfinite(x.low) || !std::isfinite(x.high))
        return Interval::anything();
    const auto rising = [&](double (*f)(double), auto error) { return around(f(x.low), f(x.high), error); };
    const auto legal = [&]() -> Interval {
        switch (function) {
        case GLSLstd450Sin:
            return sine_of(x);
        case GLSLstd450Cos:
            return cosine_of(x);
        case GLSLstd450Tan:
            return interval::widen(interval::divide(sine_of(x), cosine_of(x)), 2.5);
        case GLSLstd450Asin:
            return x.low < -1.0 || x.high > 1.0 ? Interval::anything() : rising(std::asin, arc_error_by_root);
        case GLSLstd450Acos:
            return x.low < -1.0 || x.high > 1.0
                       ? Interval::anything()
                       : within(around(std::acos(x.high), std::acos(x.low), arc_error_by_root), 0.0, 4.0);
        case GLSLstd450Atan:
            return rising(std::atan, arc_error);
        case GLSLstd450Sinh:
            return hyperbolic(x, -1.0);
        case GLSLstd450Cosh:
            return hyperbolic(x, 1.0);
        case GLSLstd450Tanh:
            // (e^x - e^-x) / (e^x + e^-x): each exp is off by 3 + 2 |x| ULP, and what is beyond its range counts as 1.
            return within(rising(std::tanh, [](double v) { return 0x1p-20 + 4.0 * interval::ulp(v); }), -1.0, 1.0);
        case GLSLstd450Asinh:
            return rising(std::asinh, [](double v) { return 0x1p-20 + 4.0 * interval::ulp(v); });
        case GLSLstd450Acosh: // by sqrt(x x - 1), near 1
            return x.low < 1.0 ? Interval::anything()
                               : within(rising(std::acosh, [](double v) { return 0x1p-11 + 4.0 * interval::ulp(v); }),
                                        0.0, HUGE_VAL);
        case GLSLstd450Atanh:
            return x.low <= -1.0 || x.high >= 1.0
                       ? Interval::anything()
                       : rising(std::atanh, [](double v) { return 0x1p-20 + 8.0 * interval::ulp(v); });
        case GLSLstd450Exp:
            return exponential(x, [](double v) { return std::exp(v); });
        case GLSLstd450Exp2:
            return exponential(x, [](double v) { return std::exp2(v); });
        case GLSLstd450Log:
            return logarithm(x, [](double v) { return std::log(v); });
        case GLSLstd450Log2:
            return logarithm(x, [](double v) { return std::log2(v); });
        default:
            return Interval::anything();
        }
    }();
    return interval::to_floats(interval::maybe_flushed(legal));
}

Interval legal_function(GLSLstd450 function, Interval x, Interval y) {
    if (x.any || y.any || !std::isfinite(x.low + x.high) || !std::isfinite(y.low + y.high))
        return Interval::anything();
    if (function == GLSLstd450Pow)
        return interval::to_floats(interval::maybe_flushed(power(x, y)));
    const Interval &sine_part = x, &cosine_part = y; // atan(y, x)
    if (sine_part.contains_zero() && cosine_part.contains_zero())
        return Interval::anything();
    if (sine_part.contains_zero() && cosine_part.high < 0.0) // on both sides of the cut
        return interval::to_floats({-pi - arc_error(pi), pi + arc_error(pi)});
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const double s : {sine_part.low, sine_part.high})
        for (const double c : {cosine_part.low, cosine_part.high}) {
            low = std::min(low, std::atan2(s, c));
            high = std::max(high, std::atan2(s, c));
        }
    return interval::to_floats(interval::maybe_flushed(around(low, high, arc_error)));
}

} // namespace lockstep::text
