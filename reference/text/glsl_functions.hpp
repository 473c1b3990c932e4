#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include <GLSL.std.450.h>

#include "reference/half.hpp"
#include "reference/text/machine_operations.hpp"

/// GLSL's built-in functions (GLSL 4.60, 8) by Machine. What GLSL gives a precision alone is the nearest float; dot,
/// length, normalize, division and roots are as the profile measured them.
namespace lockstep::text {

template <class R, int W> typename R::Real Machine<R, W>::sum_of_products(const Step& s, DotOrder order,
                                                                          std::uint32_t a, std::uint32_t b,
                                                                          std::uint32_t n, Lane l) {
    const auto x = [&](std::uint32_t c) { return cell(a + c)[l].real(); };
    const auto y = [&](std::uint32_t c) { return cell(b + c)[l].real(); };
    if constexpr (has_sets<R>) // `precise` orders no built-in function
        r.set_free(true);
    // Measured of three components; of others, what the same rule gives.
    if (n == 1)
        return x(0) * y(0);
    if (order == DotOrder::right_to_left) {
        Real sum = x(n - 1) * y(n - 1);
        for (std::uint32_t c = n - 1; c-- > 0;)
            sum = x(c) * y(c) + sum;
        return sum;
    }
    Real sum = x(0) * y(0);
    for (std::uint32_t c = 1; c < n; ++c)
        sum = order == DotOrder::fused_chain ? r.fma(in_text, x(c), y(c), sum) : sum + x(c) * y(c);
    if (n > 2 && order != DotOrder::fused_chain && order != DotOrder::left_to_right)
        refuse(s, fmt::format("the profile's order of dot is not known of {} components", n));
    return sum;
}

template <class R, int W> typename R::Real Machine<R, W>::rounded(const Real& v, Rounds how) {
    const auto of = [how](float x) {
        switch (how) {
        case Rounds::to_zero:
            return std::trunc(x);
        case Rounds::up:
            return std::ceil(x);
        case Rounds::to_sign:
            return x > 0.0F ? 1.0F : x < 0.0F ? -1.0F : 0.0F;
        default:
            return std::nearbyint(x);
        }
    };
    // Half of an odd number goes either way by round() (GLSL 4.60, 8.3).
    if constexpr (has_sets<R>)
        return how == Rounds::to_either
                   ? r.whole_of(
                         v, [](float x) { return std::ceil(x - 0.5F); }, [](float x) { return std::floor(x + 0.5F); })
                   : r.whole_of(v, of, of);
    else
        return r.monotone(v, of);
}

template <class R, int W> void Machine<R, W>::geometric_function(const Step& s) {
    const std::uint32_t n = s.d; // components of the first operand
    switch (s.op - code::extended) {
    case GLSLstd450Distance:
    case GLSLstd450Length: {
        if (s.op - code::extended == GLSLstd450Distance)
            for (std::uint32_t c = 0; c < n; ++c) {
                C* const to = cell(p_.scratch + c);
                const C* const a = cell(s.a + c);
                const C* const b = cell(s.b + c);
                each([&](Lane l) { to[l].set(a[l].real() - b[l].real()); });
            }
        const std::uint32_t v = s.op - code::extended == GLSLstd450Distance ? p_.scratch : s.a;
        C* const out = cell(s.out);
        each([&](Lane l) {
            if (n == 1)
                out[l].set(r.abs(cell(v)[l].real()));
            else if (n == 3)
                out[l].set(r.length(in_text, vec3(v, l)));
            else
                out[l].set(r.sqrt(in_text, sum_of_products(s, r.length_order(), v, v, n, l)));
        });
        break;
    }
    case GLSLstd450Normalize:
        each([&](Lane l) {
            if (n == 3) {
                const typename R::Vec3 v = r.normalize(in_text, vec3(s.a, l));
                cell(s.out)[l].set(v.x);
                cell(s.out + 1)[l].set(v.y);
                cell(s.out + 2)[l].set(v.z);
                return;
            }
            const Real squared = sum_of_products(s, r.normalize_order(), s.a, s.a, n, l);
            for (std::uint32_t c = 0; c < n; ++c)
                cell(s.out + c)[l].set(r.part_of_unit(in_text, cell(s.a + c)[l].real(), squared));
        });
        break;
    case GLSLstd450Cross:
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::uint32_t j = (c + 1) % 3, k = (c + 2) % 3;
            C* const out = cell(s.out + c);
            each([&](Lane l) {
                out[l].set(cell(s.a + j)[l].real() * cell(s.b + k)[l].real() -
                           cell(s.a + k)[l].real() * cell(s.b + j)[l].real());
            });
        }
        break;
    case GLSLstd450FaceForward: // dot(Nref, I) < 0 ? N : -N
        active([&](Lane l) {
            const bool faces = r.decide(in_text, sum_of_products(s, r.dot_order(), s.c, s.b, n, l) < Real(0.0F));
            for (std::uint32_t c = 0; c < n; ++c)
                cell(s.out + c)[l].set(faces ? cell(s.a + c)[l].real() : -cell(s.a + c)[l].real());
        });
        break;
    case GLSLstd450Reflect: // I - 2 dot(N, I) N
        active([&](Lane l) {
            const Real twice = Real(2.0F) * sum_of_products(s, r.dot_order(), s.b, s.a, n, l);
            for (std::uint32_t c = 0; c < n; ++c)
                cell(s.out + c)[l].set(cell(s.a + c)[l].real() - twice * cell(s.b + c)[l].real());
        });
        break;
    case GLSLstd450Refract: // k = 1 - eta^2 (1 - dot(N, I)^2); k < 0 ? 0 : eta I - (eta dot(N, I) + sqrt(k)) N
        active([&](Lane l) {
            const Real eta = cell(s.c)[l].real(), d = sum_of_products(s, r.dot_order(), s.b, s.a, n, l);
            const Real k = Real(1.0F) - eta * eta * (Real(1.0F) - d * d);
            const bool is_none = r.decide(in_text, k < Real(0.0F));
            for (std::uint32_t c = 0; c < n; ++c)
                cell(s.out + c)[l].set(is_none ? Real(0.0F)
                                               : eta * cell(s.a + c)[l].real() -
                                                     (eta * d + r.sqrt(in_text, k)) * cell(s.b + c)[l].real());
        });
        break;
    default:
        matrix_function(s);
    }
}

/// determinant and inverse, by cofactors, of bits in double: GLSL gives neither a precision.
template <class R, int W> void Machine<R, W>::matrix_function(const Step& s) {
    const auto function = s.op - code::extended;
    if (function != GLSLstd450Determinant && function != GLSLstd450MatrixInverse)
        return packing_function(s);
    const std::uint32_t n = s.d == 16 ? 4 : s.d == 9 ? 3 : 2;
    using Number = std::conditional_t<has_sets<R>, Real, double>;
    using Square = std::array<std::array<Number, 4>, 4>;
    const auto minor = [](const Square& m, std::uint32_t size, std::uint32_t column, std::uint32_t row) {
        Square part{};
        for (std::uint32_t c = 0, to = 0; c < size; ++c)
            if (c != column) {
                for (std::uint32_t k = 0, at = 0; k < size; ++k)
                    if (k != row)
                        part[to][at++] = m[c][k];
                ++to;
            }
        return part;
    };
    const auto determinant = [&](const auto& self, const Square& m, std::uint32_t size) -> Number {
        if (size == 1)
            return m[0][0];
        Number sum{};
        for (std::uint32_t c = 0; c < size; ++c) {
            const Number term = m[c][0] * self(self, minor(m, size, c, 0), size - 1);
            sum = c == 0 ? term : c % 2 == 0 ? sum + term : sum - term;
        }
        return sum;
    };
    const auto quotient = [&](const Number& a, const Number& b) {
        if constexpr (has_sets<R>)
            return r.divide(in_text, a, b);
        else
            return static_cast<Real>(a / b);
    };
    active([&](Lane l) {
        Square m{};
        for (std::uint32_t c = 0; c < n; ++c)
            for (std::uint32_t k = 0; k < n; ++k)
                m[c][k] = Number(cell(s.a + c * n + k)[l].real());
        const Number whole = determinant(determinant, m, n);
        if (function == GLSLstd450Determinant) {
            cell(s.out)[l].set(static_cast<Real>(whole));
            return;
        }
        for (std::uint32_t c = 0; c < n; ++c)
            for (std::uint32_t k = 0; k < n; ++k) {
                const Number cofactor = determinant(determinant, minor(m, n, k, c), n - 1);
                cell(s.out + c * n + k)[l].set(quotient((c + k) % 2 == 0 ? cofactor : -cofactor, whole));
            }
    });
}

/// A half's bits.
inline std::uint32_t half_bits(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(half_nearest(x));
    const std::uint32_t sign = bits >> 16U & 0x8000U, magnitude = bits & 0x7fffffffU;
    if (magnitude > 0x7f800000U)
        return sign | 0x7e00U;
    if (magnitude >= 0x47800000U)
        return sign | 0x7c00U;
    if (magnitude < 0x38800000U) // a subnormal half: a multiple of 2^-24
        return sign | static_cast<std::uint32_t>(std::abs(std::bit_cast<float>(bits)) * 0x1p24F);
    return sign | (magnitude - 0x38000000U) >> 13U;
}

inline float half_value(std::uint32_t half) {
    const std::uint32_t sign = (half & 0x8000U) << 16U, exponent = half >> 10U & 0x1fU, rest = half & 0x3ffU;
    if (exponent == 0)
        return std::copysign(static_cast<float>(rest) * 0x1p-24F, sign != 0 ? -1.0F : 1.0F);
    return std::bit_cast<float>(sign | (exponent == 0x1fU ? 0x7f800000U : (exponent + 112U) << 23U) | rest << 13U);
}

/// packUnorm4x8 and its like (GLSL 4.60, 8.4).
template <class R, int W> void Machine<R, W>::packing_function(const Step& s) {
    struct Format {
        std::uint32_t parts, bits;
        bool is_signed, is_half, packs;
    };
    const auto format = [&]() -> Format {
        switch (s.op - code::extended) {
        case GLSLstd450PackSnorm4x8:
            return {4, 8, true, false, true};
        case GLSLstd450PackUnorm4x8:
            return {4, 8, false, false, true};
        case GLSLstd450PackSnorm2x16:
            return {2, 16, true, false, true};
        case GLSLstd450PackUnorm2x16:
            return {2, 16, false, false, true};
        case GLSLstd450PackHalf2x16:
            return {2, 16, true, true, true};
        case GLSLstd450UnpackSnorm4x8:
            return {4, 8, true, false, false};
        case GLSLstd450UnpackUnorm4x8:
            return {4, 8, false, false, false};
        case GLSLstd450UnpackSnorm2x16:
            return {2, 16, true, false, false};
        case GLSLstd450UnpackUnorm2x16:
            return {2, 16, false, false, false};
        case GLSLstd450UnpackHalf2x16:
            return {2, 16, true, true, false};
        default:
            refuse(s, fmt::format("GLSL.std.450 instruction {} is not interpreted", s.op - code::extended));
        }
    }();
    const std::uint32_t mask = (1U << format.bits) - 1U;
    const auto most = static_cast<float>(format.is_signed ? mask >> 1U : mask);
    active([&](Lane l) {
        std::uint32_t packed = format.packs ? 0U : cell(s.a)[l].word();
        for (std::uint32_t k = 0; k < format.parts; ++k) {
            const std::uint32_t shift = k * format.bits;
            if (format.packs) {
                const auto whole_part = [&](const Real& x) {
                    const Real in_range = r.min(r.max(x, Real(format.is_signed ? -1.0F : 0.0F)), Real(1.0F));
                    return static_cast<std::uint32_t>(
                        static_cast<std::int32_t>(number(rounded(in_range * Real(most), Rounds::to_nearest))));
                };
                const Real x = cell(s.a + k)[l].real();
                const std::uint32_t part = format.is_half ? half_bits(number(x)) : whole_part(x);
                packed |= (part & mask) << shift;
                continue;
            }
            const std::uint32_t part = packed >> shift & mask;
            const bool is_negative = format.is_signed && (part >> (format.bits - 1U)) != 0;
            const auto whole = static_cast<float>(static_cast<std::int32_t>(is_negative ? part | ~mask : part));
            if (format.is_half)
                cell(s.out + k)[l].set(Real(half_value(part)));
            else
                cell(s.out + k)[l].set(r.max(r.divide(in_text, Real(whole), Real(most)), Real(-1.0F)));
        }
        if (format.packs)
            cell(s.out)[l].set(packed);
    });
}

template <class R, int W> void Machine<R, W>::integer_function(const Step& s) {
    const auto i = [](std::uint32_t x) { return static_cast<std::int32_t>(x); };
    switch (s.op - code::extended) {
    case GLSLstd450SAbs:
        return word1(s, [&](auto a) { return i(a) < 0 ? 0U - a : a; });
    case GLSLstd450SSign:
        return word1(s, [&](auto a) { return i(a) > 0 ? 1 : i(a) < 0 ? -1 : 0; });
    case GLSLstd450UMin:
        return word2(s, [](auto a, auto b) { return std::min(a, b); });
    case GLSLstd450SMin:
        return word2(s, [&](auto a, auto b) { return std::min(i(a), i(b)); });
    case GLSLstd450UMax:
        return word2(s, [](auto a, auto b) { return std::max(a, b); });
    case GLSLstd450SMax:
        return word2(s, [&](auto a, auto b) { return std::max(i(a), i(b)); });
    case GLSLstd450UClamp:
    case GLSLstd450SClamp:
        for (std::uint32_t c = 0; c < s.n; ++c)
            active([&](Lane l) {
                const std::uint32_t x = cell(s.a + c)[l].word(), low = cell(s.b + c)[l].word(),
                                    high = cell(s.c + c)[l].word();
                cell(s.out + c)[l].set(s.op - code::extended == GLSLstd450UClamp
                                           ? std::min(std::max(x, low), high)
                                           : static_cast<std::uint32_t>(std::min(std::max(i(x), i(low)), i(high))));
            });
        break;
    case GLSLstd450FindILsb:
        return word1(s, [](auto a) { return a == 0 ? -1 : std::countr_zero(a); });
    case GLSLstd450FindUMsb:
        return word1(s, [](auto a) { return 31 - std::countl_zero(a); });
    case GLSLstd450FindSMsb:
        return word1(s, [&](auto a) { return 31 - std::countl_zero(i(a) < 0 ? ~a : a); });
    default:
        geometric_function(s);
    }
}

template <class R, int W> void Machine<R, W>::extended(const Step& s) {
    const Real zero(0.0F), one(1.0F);
    const auto function = static_cast<GLSLstd450>(s.op - code::extended);
    if constexpr (has_sets<R>) {
        const bool is_measured = function == GLSLstd450Sqrt || function == GLSLstd450InverseSqrt ||
                                 (s.d == 3 && (function == GLSLstd450Length || function == GLSLstd450Distance ||
                                               function == GLSLstd450Normalize));
        r.set_free(!is_measured);
    }
    // The nearest float of what GLSL gives a precision, or none.
    const auto nearest = [&](double (*f)(double)) __attribute__((noinline)) {
        real1(s, [&](const Real& v) {
            if constexpr (has_sets<R>)
                return r.function(function, v);
            else
                return Real(static_cast<float>(f(double{v})));
        });
    };
    const auto nearest2 = [&](double (*f)(double, double)) __attribute__((noinline)) {
        real2(s, [&](const Real& a, const Real& b) {
            if constexpr (has_sets<R>)
                return r.function(function, a, b);
            else
                return Real(static_cast<float>(f(double{a}, double{b})));
        });
    };
    const auto clamped = [&](const Real& v, const Real& low, const Real& high) { return r.min(r.max(v, low), high); };
    switch (function) {
    case GLSLstd450Round:
        return real1(s, [&](const Real& v) { return rounded(v, Rounds::to_either); });
    case GLSLstd450RoundEven:
        return real1(s, [&](const Real& v) { return rounded(v, Rounds::to_nearest); });
    case GLSLstd450Trunc:
        return real1(s, [&](const Real& v) { return rounded(v, Rounds::to_zero); });
    case GLSLstd450FAbs:
        return real1(s, [&](const Real& v) { return r.abs(v); });
    case GLSLstd450FSign:
        return real1(s, [&](const Real& v) { return rounded(v, Rounds::to_sign); });
    case GLSLstd450Floor:
        return real1(s, [&](const Real& v) { return r.floor(v); });
    case GLSLstd450Ceil:
        return real1(s, [&](const Real& v) { return rounded(v, Rounds::up); });
    case GLSLstd450Fract:
        return real1(s, [&](const Real& v) {
            const Real rest = v - r.floor(v);
            if constexpr (has_sets<R>)
                return r.rest_of(rest, v, Real(1.0F));
            else
                return rest;
        });
    case GLSLstd450Radians:
        return real1(s, [&](const Real& v) { return v * Real(std::numbers::pi_v<float> / 180.0F); });
    case GLSLstd450Degrees:
        return real1(s, [&](const Real& v) { return v * Real(180.0F / std::numbers::pi_v<float>); });
    case GLSLstd450Sin:
        return nearest(std::sin);
    case GLSLstd450Cos:
        return nearest(std::cos);
    case GLSLstd450Tan:
        return nearest(std::tan);
    case GLSLstd450Asin:
        return nearest(std::asin);
    case GLSLstd450Acos:
        return nearest(std::acos);
    case GLSLstd450Atan:
        return nearest(std::atan);
    case GLSLstd450Sinh:
        return nearest(std::sinh);
    case GLSLstd450Cosh:
        return nearest(std::cosh);
    case GLSLstd450Tanh:
        return nearest(std::tanh);
    case GLSLstd450Asinh:
        return nearest(std::asinh);
    case GLSLstd450Acosh:
        return nearest(std::acosh);
    case GLSLstd450Atanh:
        return nearest(std::atanh);
    case GLSLstd450Atan2:
        return nearest2(std::atan2);
    case GLSLstd450Pow:
        return nearest2(std::pow);
    case GLSLstd450Exp:
        return nearest(std::exp);
    case GLSLstd450Log:
        return nearest(std::log);
    case GLSLstd450Exp2:
        return nearest(std::exp2);
    case GLSLstd450Log2:
        return nearest(std::log2);
    case GLSLstd450Sqrt:
        return real1(s, [&](const Real& v) { return r.sqrt(in_text, v); });
    case GLSLstd450InverseSqrt:
        return real1(s, [&](const Real& v) { return r.inverse_sqrt(in_text, v); });
    case GLSLstd450FMin:
        return real2(s, [&](const Real& a, const Real& b) { return r.min(a, b); });
    case GLSLstd450FMax:
        return real2(s, [&](const Real& a, const Real& b) { return r.max(a, b); });
    case GLSLstd450FClamp:
        return real3(s, clamped);
    case GLSLstd450FMix: // x (1 - a) + y a
        return real3(s, [&](const Real& x, const Real& y, const Real& a) { return x * (one - a) + y * a; });
    case GLSLstd450Step:
        return real2(s, [&](const Real& edge, const Real& v) { return r.decide(in_text, v < edge) ? zero : one; });
    case GLSLstd450SmoothStep:
        return real3(s, [&](const Real& low, const Real& high, const Real& v) {
            const Real t = clamped(r.divide(in_text, v - low, high - low), zero, one);
            return t * t * (Real(3.0F) - Real(2.0F) * t);
        });
    case GLSLstd450Fma:
        return real3(s, [&](const Real& a, const Real& b, const Real& c) { return r.fma(in_text, a, b, c); });
    case GLSLstd450Ldexp:
        for (std::uint32_t c = 0; c < s.n; ++c)
            active([&](Lane l) {
                const auto e = static_cast<std::int32_t>(cell(s.b + c)[l].word());
                cell(s.out + c)[l].set(r.monotone(cell(s.a + c)[l].real(), [e](float x) { return std::ldexp(x, e); }));
            });
        break;
    case GLSLstd450FrexpStruct: // a number from 0.5 to 1, and the power of 2 that it is multiplied by
        for (std::uint32_t c = 0; c < s.d; ++c)
            active([&](Lane l) {
                int power = 0;
                cell(s.out + c)[l].set(Real(std::frexp(number(cell(s.a + c)[l].real()), &power)));
                cell(s.out + s.d + c)[l].set(static_cast<std::uint32_t>(power));
            });
        break;
    default:
        integer_function(s);
    }
}

} // namespace lockstep::text
