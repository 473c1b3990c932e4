#pragma once
#include <bit>
#include <cmath>
#include <limits>

#include "reference/text/machine_subgroup.hpp"

/// Arithmetic, comparisons and conversions of Machine (SPIR-V 3.42.11 to 3.42.15).
namespace lockstep::text {

/// Where the readings' words are said from.
inline constexpr Site in_text{"text"};

template <class R, int W> template <class F> void Machine<R, W>::real1(const Step& s, const F& f) {
    for (std::uint32_t c = 0; c < s.n; ++c) {
        C* const out = cell(s.out + c);
        const C* const a = cell(s.a + c);
        each([&](Lane l) { out[l].set(f(a[l].real())); });
    }
}

template <class R, int W> template <class F> void Machine<R, W>::real2(const Step& s, const F& f) {
    for (std::uint32_t c = 0; c < s.n; ++c) {
        C* const out = cell(s.out + c);
        const C* const a = cell(s.a + c);
        const C* const b = cell(s.b + c);
        each([&](Lane l) { out[l].set(f(a[l].real(), b[l].real())); });
    }
}

template <class R, int W> template <class F> void Machine<R, W>::real3(const Step& s, const F& f) {
    for (std::uint32_t c = 0; c < s.n; ++c) {
        C* const out = cell(s.out + c);
        const C* const a = cell(s.a + c);
        const C* const b = cell(s.b + c);
        const C* const d = cell(s.c + c);
        each([&](Lane l) { out[l].set(f(a[l].real(), b[l].real(), d[l].real())); });
    }
}

template <class R, int W> template <class F> void Machine<R, W>::word1(const Step& s, const F& f) {
    for (std::uint32_t c = 0; c < s.n; ++c) {
        C* const out = cell(s.out + c);
        const C* const a = cell(s.a + c);
        each([&](Lane l) { out[l].set(static_cast<std::uint32_t>(f(a[l].word()))); });
    }
}

template <class R, int W> template <class F> void Machine<R, W>::word2(const Step& s, const F& f) {
    for (std::uint32_t c = 0; c < s.n; ++c) {
        C* const out = cell(s.out + c);
        const C* const a = cell(s.a + c);
        const C* const b = cell(s.b + c);
        each([&](Lane l) { out[l].set(static_cast<std::uint32_t>(f(a[l].word(), b[l].word()))); });
    }
}

template <class R, int W> template <class F> void Machine<R, W>::compare(const Step& s, const F& f) {
    for (std::uint32_t c = 0; c < s.n; ++c) {
        C* const out = cell(s.out + c);
        const C* const a = cell(s.a + c);
        const C* const b = cell(s.b + c);
        each([&](Lane l) { out[l].set(r.decide(in_text, f(a[l].real(), b[l].real())) ? 1U : 0U); });
    }
}

/// A sum over columns or rows takes its terms from left to right, as `precise` was measured to give on every driver.
template <class R, int W> void Machine<R, W>::multiply_matrix(const Step& s) {
    const std::uint32_t columns = s.c, rows = s.d;
    const auto sum = [&](std::uint32_t out, std::uint32_t a, std::uint32_t step_a, std::uint32_t b, std::uint32_t n) {
        for (std::uint32_t k = 0; k < n; ++k) {
            C* const to = cell(out);
            const C* const u = cell(a + k * step_a);
            const C* const v = cell(b + k);
            if (k == 0)
                each([&](Lane l) { to[l].set(u[l].real() * v[l].real()); });
            else
                each([&](Lane l) { to[l].set(to[l].real() + u[l].real() * v[l].real()); });
        }
    };
    if (s.op == spv::OpVectorTimesMatrix) {
        for (std::uint32_t column = 0; column < columns; ++column)
            sum(s.out + column, s.a, 1, s.b + column * rows, rows);
        return;
    }
    const std::uint32_t vectors = s.n / rows;
    for (std::uint32_t v = 0; v < vectors; ++v)
        for (std::uint32_t row = 0; row < rows; ++row)
            sum(s.out + v * rows + row, s.a + row, rows, s.b + v * columns, columns);
}

/// Operations whose operands have other sizes than their results.
template <class R, int W> void Machine<R, W>::vector_operation(const Step& s) {
    switch (s.op) {
    case spv::OpVectorTimesMatrix:
    case spv::OpMatrixTimesVector:
    case spv::OpMatrixTimesMatrix:
        multiply_matrix(s);
        break;
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            C* const out = cell(s.out + c);
            const C* const a = cell(s.a + c);
            const C* const b = cell(s.b);
            each([&](Lane l) { out[l].set(a[l].real() * b[l].real()); });
        }
        break;
    case spv::OpDot: {
        C* const out = cell(s.out);
        if constexpr (has_sets<R>) // as it was measured
            r.set_free(false);
        each([&](Lane l) {
            if (s.d == 3)
                out[l].set(r.dot(in_text, vec3(s.a, l), vec3(s.b, l)));
            else
                out[l].set(sum_of_products(s, r.dot_order(), s.a, s.b, s.d, l));
        });
        break;
    }
    case spv::OpTranspose:
        for (std::uint32_t column = 0; column < s.c; ++column)
            for (std::uint32_t row = 0; row < s.d; ++row) {
                C* const out = cell(s.out + row * s.c + column);
                const C* const a = cell(s.a + column * s.d + row);
                each([&](Lane l) { assign(out[l], a[l]); });
            }
        break;
    case spv::OpVectorExtractDynamic:
    case spv::OpVectorInsertDynamic: {
        const bool inserts = s.op == spv::OpVectorInsertDynamic;
        active([&](Lane l) {
            std::uint32_t index = cell(inserts ? s.c : s.b)[l].word();
            if (index >= s.d) {
                memory_.note_index(index, s.d, place(s, l));
                index = 0;
            }
            if (inserts) {
                for (std::uint32_t c = 0; c < s.n; ++c)
                    cell(s.out + c)[l] = cell(s.a + c)[l];
                cell(s.out + index)[l] = cell(s.b)[l];
            } else {
                cell(s.out)[l] = cell(s.a + index)[l];
            }
        });
        break;
    }
    case spv::OpSelect:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            C* const out = cell(s.out + c);
            const C* const condition = cell(s.d != 0 ? s.a + c : s.a);
            const C* const a = cell(s.b + c);
            const C* const b = cell(s.c + c);
            each([&](Lane l) { assign(out[l], condition[l].word() != 0 ? a[l] : b[l]); });
        }
        break;
    case spv::OpAny:
    case spv::OpAll: {
        C* const out = cell(s.out);
        each([&](Lane l) {
            std::uint32_t count = 0;
            for (std::uint32_t c = 0; c < s.d; ++c)
                count += cell(s.a + c)[l].word() != 0 ? 1U : 0U;
            out[l].set(s.op == spv::OpAny ? (count > 0 ? 1U : 0U) : (count == s.d ? 1U : 0U));
        });
        break;
    }
    case spv::OpIAddCarry:
    case spv::OpISubBorrow:
    case spv::OpUMulExtended:
    case spv::OpSMulExtended: {
        const std::uint32_t half = s.n / 2U;
        for (std::uint32_t c = 0; c < half; ++c)
            active([&](Lane l) {
                const std::uint64_t a = cell(s.a + c)[l].word(), b = cell(s.b + c)[l].word();
                const auto is_signed = [](std::uint64_t x) { return std::int64_t{static_cast<std::int32_t>(x)}; };
                const std::uint64_t both = s.op == spv::OpIAddCarry    ? a + b
                                           : s.op == spv::OpISubBorrow ? a - b
                                           : s.op == spv::OpUMulExtended
                                               ? a * b
                                               : static_cast<std::uint64_t>(is_signed(a) * is_signed(b));
                cell(s.out + c)[l].set(static_cast<std::uint32_t>(both));
                cell(s.out + half + c)[l].set(s.op == spv::OpISubBorrow ? (a < b ? 1U : 0U)
                                                                        : static_cast<std::uint32_t>(both >> 32U));
            });
        break;
    }
    default:
        subgroup(s);
    }
}

/// Of words that are open: an operation that has a range of words from one, component by component. False: it wants to
/// know the words.
template <class R, int W> bool Machine<R, W>::open_operation(const Step& s) requires has_sets<R> {
    const auto is_open = [&](std::uint32_t first) {
        return std::any_of(cell(first), cell(first) + s.n, [](const C& c) { return c.is_open(); });
    };
    const bool has_two = s.op != spv::OpSNegate && s.op != spv::OpNot;
    if (!word_range::is_known(s.op) || !(is_open(s.a) || (has_two && is_open(s.b))))
        return false;
    for (std::uint32_t c = 0; c < s.n; ++c) {
        const C a = *cell(s.a + c), b = has_two ? *cell(s.b + c) : C{};
        std::optional<WordRange> made = word_range::of(s.op, a.range(), b.range());
        if (!made)
            made = word_range::of(s.op, {a.word(), 0}, {b.word(), 0});
        cell(s.out + c)->set(*made, r);
    }
    return true;
}

/// Of integers and truth values. Divisions by 0 give all ones, shifts take their operand's low bits: both are
/// undefined.
template <class R, int W> void Machine<R, W>::integer_operation(const Step& s) {
    const auto i = [](std::uint32_t x) { return static_cast<std::int32_t>(x); };
    constexpr std::uint32_t by_zero = 0xffffffffU;
    if constexpr (has_sets<R>)
        if (open_operation(s))
            return;
    switch (s.op) {
    case spv::OpSNegate:
        return word1(s, [](auto a) { return 0U - a; });
    case spv::OpNot:
        return word1(s, [](auto a) { return ~a; });
    case spv::OpLogicalNot:
        return word1(s, [](auto a) { return a == 0 ? 1U : 0U; });
    case spv::OpIAdd:
        return word2(s, [](auto a, auto b) { return a + b; });
    case spv::OpISub:
        return word2(s, [](auto a, auto b) { return a - b; });
    case spv::OpIMul:
        return word2(s, [](auto a, auto b) { return a * b; });
    case spv::OpUDiv:
        return word2(s, [](auto a, auto b) { return b == 0 ? by_zero : a / b; });
    case spv::OpUMod:
        return word2(s, [](auto a, auto b) { return b == 0 ? by_zero : a % b; });
    case spv::OpSDiv:
        return word2(s, [&](auto a, auto b) {
            return b == 0 ? by_zero : b == by_zero ? 0U - a : static_cast<std::uint32_t>(i(a) / i(b));
        });
    case spv::OpSRem:
        return word2(s, [&](auto a, auto b) {
            return b == 0 ? by_zero : b == by_zero ? 0U : static_cast<std::uint32_t>(i(a) % i(b));
        });
    case spv::OpSMod:
        return word2(s, [&](auto a, auto b) {
            if (b == 0 || b == by_zero)
                return b == 0 ? by_zero : 0U;
            const std::int32_t rest = i(a) % i(b);
            return static_cast<std::uint32_t>(rest != 0 && (rest < 0) != (i(b) < 0) ? rest + i(b) : rest);
        });
    case spv::OpLogicalEqual:
        return word2(s, [](auto a, auto b) { return (a != 0) == (b != 0); });
    case spv::OpLogicalNotEqual:
        return word2(s, [](auto a, auto b) { return (a != 0) != (b != 0); });
    case spv::OpLogicalOr:
        return word2(s, [](auto a, auto b) { return (a | b) != 0; });
    case spv::OpLogicalAnd:
        return word2(s, [](auto a, auto b) { return (a & b) != 0; });
    case spv::OpIEqual:
        return word2(s, [](auto a, auto b) { return a == b; });
    case spv::OpINotEqual:
        return word2(s, [](auto a, auto b) { return a != b; });
    case spv::OpUGreaterThan:
        return word2(s, [](auto a, auto b) { return a > b; });
    case spv::OpSGreaterThan:
        return word2(s, [&](auto a, auto b) { return i(a) > i(b); });
    case spv::OpUGreaterThanEqual:
        return word2(s, [](auto a, auto b) { return a >= b; });
    case spv::OpSGreaterThanEqual:
        return word2(s, [&](auto a, auto b) { return i(a) >= i(b); });
    case spv::OpULessThan:
        return word2(s, [](auto a, auto b) { return a < b; });
    case spv::OpSLessThan:
        return word2(s, [&](auto a, auto b) { return i(a) < i(b); });
    case spv::OpULessThanEqual:
        return word2(s, [](auto a, auto b) { return a <= b; });
    case spv::OpSLessThanEqual:
        return word2(s, [&](auto a, auto b) { return i(a) <= i(b); });
    case spv::OpShiftRightLogical:
        return word2(s, [](auto a, auto b) { return a >> (b & 31U); });
    case spv::OpShiftRightArithmetic:
        return word2(s, [&](auto a, auto b) { return i(a) >> (b & 31U); });
    case spv::OpShiftLeftLogical:
        return word2(s, [](auto a, auto b) { return a << (b & 31U); });
    case spv::OpBitwiseOr:
        return word2(s, [](auto a, auto b) { return a | b; });
    case spv::OpBitwiseXor:
        return word2(s, [](auto a, auto b) { return a ^ b; });
    case spv::OpBitwiseAnd:
        return word2(s, [](auto a, auto b) { return a & b; });
    case spv::OpBitCount:
        return word1(s, [](auto a) { return std::popcount(a); });
    case spv::OpBitReverse:
        return word1(s, [](auto a) {
            std::uint32_t to = 0;
            for (int bit = 0; bit < 32; ++bit, a >>= 1U)
                to = to << 1U | (a & 1U);
            return to;
        });
    case spv::OpBitFieldInsert:
    case spv::OpBitFieldSExtract:
    case spv::OpBitFieldUExtract: {
        const bool inserts = s.op == spv::OpBitFieldInsert;
        for (std::uint32_t c = 0; c < s.n; ++c)
            active([&](Lane l) {
                const std::uint32_t from = cell(inserts ? s.c : s.b)[l].word() & 31U,
                                    bits = cell(inserts ? s.d : s.c)[l].word(), base = cell(s.a + c)[l].word();
                const std::uint32_t mask = bits >= 32 ? ~0U : (1U << bits) - 1U;
                std::uint32_t value = base >> from & mask;
                if (inserts)
                    value = (base & ~(mask << from)) | (cell(s.b + c)[l].word() & mask) << from;
                else if (s.op == spv::OpBitFieldSExtract && bits > 0 && bits < 32 && (value >> (bits - 1U) & 1U) != 0)
                    value |= ~mask;
                cell(s.out + c)[l].set(value);
            });
        break;
    }
    default:
        vector_operation(s);
    }
}

/// Of sets, a sum of three terms and more remembers them: without `precise` it may take another order.
template <class R, int W> void Machine<R, W>::sum(const Step& s, bool subtracts) {
    if constexpr (has_sets<R>) {
        for (std::uint32_t c = 0; c < s.n; ++c) {
            const C a = *cell(s.a + c), b = *cell(s.b + c);
            C& out = *cell(s.out + c);
            const Real made = subtracts ? a.real() - b.real() : a.real() + b.real();
            if (r.is_precise()) {
                out.set(made);
                continue;
            }
            auto terms = std::make_shared<typename C::Terms>(a.terms ? *a.terms : typename C::Terms{a.real().set()});
            for (const Interval& term : b.terms ? *b.terms : typename C::Terms{b.real().set()})
                terms->push_back(subtracts ? interval::negate(term) : term);
            out.set(terms->size() > 2 ? r.in_any_order(made, *terms) : made);
            constexpr std::size_t most_terms = 64;
            if (terms->size() > most_terms)
                *terms = {out.real().set()};
            out.terms = std::move(terms);
        }
    } else if (subtracts) {
        real2(s, [](const Real& a, const Real& b) { return a - b; });
    } else {
        real2(s, [](const Real& a, const Real& b) { return a + b; });
    }
}

template <class R, int W> void Machine<R, W>::negate(const Step& s) {
    for (std::uint32_t c = 0; c < s.n; ++c) {
        C* const out = cell(s.out + c);
        const C* const a = cell(s.a + c);
        each([&](Lane l) {
            if constexpr (has_sets<R>) {
                const C of = a[l];
                out[l].set(-of.real());
                if (of.terms && !r.is_precise()) {
                    auto terms = std::make_shared<typename C::Terms>(*of.terms);
                    for (Interval& term : *terms)
                        term = interval::negate(term);
                    out[l].terms = std::move(terms);
                }
            } else {
                out[l].set(-a[l].real());
            }
        });
    }
}

template <class R, int W> void Machine<R, W>::operation(const Step& s) {
    switch (s.op) {
    case spv::OpFAdd:
        return sum(s, false);
    case spv::OpFSub:
        return sum(s, true);
    case spv::OpFMul:
        return real2(s, [](const Real& a, const Real& b) { return a * b; });
    case spv::OpFDiv:
        return real2(s, [&](const Real& a, const Real& b) { return r.divide(in_text, a, b); });
    case spv::OpFMod: // x - y floor(x / y) (GLSL 4.60, 8.3)
        return real2(s, [&](const Real& a, const Real& b) {
            const Real rest = a - b * r.floor(r.divide(in_text, a, b));
            if constexpr (has_sets<R>)
                return r.rest_of(rest, a, b);
            else
                return rest;
        });
    case spv::OpFNegate:
        return negate(s);
    case spv::OpFOrdEqual:
        return compare(s, [](const Real& a, const Real& b) { return a == b; });
    case spv::OpFOrdNotEqual:
    case spv::OpFUnordNotEqual:
        return compare(s, [](const Real& a, const Real& b) { return a != b; });
    case spv::OpFOrdLessThan:
        return compare(s, [](const Real& a, const Real& b) { return a < b; });
    case spv::OpFOrdGreaterThan:
        return compare(s, [](const Real& a, const Real& b) { return a > b; });
    case spv::OpFOrdLessThanEqual:
        return compare(s, [](const Real& a, const Real& b) { return a <= b; });
    case spv::OpFOrdGreaterThanEqual:
        return compare(s, [](const Real& a, const Real& b) { return a >= b; });
    case spv::OpFUnordLessThan:
        return compare(s, [](const Real& a, const Real& b) { return !(a >= b); });
    case spv::OpFUnordGreaterThan:
        return compare(s, [](const Real& a, const Real& b) { return !(a <= b); });
    case spv::OpFUnordLessThanEqual:
        return compare(s, [](const Real& a, const Real& b) { return !(a > b); });
    case spv::OpFUnordGreaterThanEqual:
        return compare(s, [](const Real& a, const Real& b) { return !(a < b); });
    case spv::OpConvertFToS:
    case spv::OpConvertFToU:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            C* const out = cell(s.out + c);
            const C* const a = cell(s.a + c);
            if (s.op == spv::OpConvertFToS)
                each([&](Lane l) { out[l].set(static_cast<std::uint32_t>(r.to_int(in_text, a[l].real()))); });
            else
                each([&](Lane l) { out[l].set(static_cast<std::uint32_t>(r.to_uint(in_text, a[l].real()))); });
        }
        break;
    case spv::OpConvertSToF:
    case spv::OpConvertUToF:
        for (std::uint32_t c = 0; c < s.n; ++c) {
            C* const out = cell(s.out + c);
            const C* const a = cell(s.a + c);
            const auto number = [&](std::uint32_t word) {
                return s.op == spv::OpConvertSToF ? r.real(static_cast<std::int32_t>(word)) : r.real(word);
            };
            each([&](Lane l) {
                if constexpr (has_sets<R>)
                    if (const WordRange of = a[l].range();
                        a[l].is_open() && (s.op == spv::OpConvertSToF ? of.is_signed() : of.is_unsigned()))
                        return out[l].set(r.between(interval::hull(number(of.first).set(), number(of.last()).set())));
                out[l].set(number(a[l].word()));
            });
        }
        break;
    case spv::OpIsNan:
    case spv::OpIsInf:
        for (std::uint32_t c = 0; c < s.n; ++c)
            active([&](Lane l) {
                const auto& a = cell(s.a + c)[l].real();
                if constexpr (has_sets<R>)
                    if (const Interval set = a.set();
                        !set.any && std::max(-set.low, set.high) <= std::numeric_limits<float>::max()) {
                        cell(s.out + c)[l].set(0U); // none of them is
                        return;
                    }
                const float x = number(a);
                cell(s.out + c)[l].set((s.op == spv::OpIsNan ? std::isnan(x) : std::isinf(x)) ? 1U : 0U);
            });
        break;
    default:
        integer_operation(s);
    }
}

} // namespace lockstep::text
