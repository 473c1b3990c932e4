#pragma once
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include <GLSL.std.450.h>

#include "reference/text/machine.hpp"

/// What Machine looks for in a watched run: operands for which GLSL defines no result, and values of variables that
/// were never set, followed from cell to cell until something depends on them.
namespace lockstep::text {

inline constexpr std::string_view unset_rule = "use of a variable that was never set (GLSL 4.60, 5.8)";
inline constexpr std::string_view unset_shared_rule = "use of a shared variable that was never set (GLSL 4.60, 4.3.8)";

/// Operands of a step that lie in cells, and whether component c of the result needs component c of each alone.
struct StepOperands {
    std::array<std::pair<std::uint32_t, std::uint32_t>, 4> ranges{}; ///< first cell, and how many
    std::size_t count = 0;
    bool by_component = false; ///< else of all of them; a range of one cell is for every component

    void add(std::uint32_t first, std::uint32_t cells) { ranges[count++] = {first, cells}; }
    /// Of the k-th range, for component c of the result.
    [[nodiscard]] std::uint32_t cell(std::size_t k, std::uint32_t c) const {
        return ranges[k].first + (ranges[k].second == 1 ? 0 : c);
    }
};

/// Of operations and built-in functions.
inline StepOperands operands_of(const Step& s) {
    StepOperands all;
    const std::uint32_t n = s.n;
    if (s.op >= code::extended) {
        const auto function = s.op - code::extended;
        const auto is_in = [&](auto... one) { return ((function == static_cast<int>(one)) || ...); };
        const bool three =
            (function >= GLSLstd450FClamp && function <= GLSLstd450SmoothStep && !is_in(GLSLstd450Step)) ||
            is_in(GLSLstd450Fma, GLSLstd450FaceForward, GLSLstd450Refract);
        const bool two = three || (function >= GLSLstd450FMin && function <= GLSLstd450SMax) ||
                         is_in(GLSLstd450Atan2, GLSLstd450Pow, GLSLstd450Step, GLSLstd450Ldexp, GLSLstd450Distance,
                               GLSLstd450Cross, GLSLstd450Reflect);
        all.by_component = s.d == n && !(function >= GLSLstd450Length && function <= GLSLstd450Refract) &&
                           !is_in(GLSLstd450MatrixInverse);
        all.add(s.a, s.d);
        if (two)
            all.add(s.b, s.d);
        if (three)
            all.add(s.c, is_in(GLSLstd450Refract) ? 1 : s.d);
        return all;
    }
    switch (s.op) {
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
        all.by_component = true;
        all.add(s.a, n);
        all.add(s.b, 1);
        break;
    case spv::OpVectorTimesMatrix:
        all.add(s.a, s.d);
        all.add(s.b, s.c * s.d);
        break;
    case spv::OpMatrixTimesVector:
        all.add(s.a, s.c * s.d);
        all.add(s.b, s.c);
        break;
    case spv::OpMatrixTimesMatrix:
        all.add(s.a, s.c * s.d);
        all.add(s.b, s.c * (n / s.d));
        break;
    case spv::OpDot:
        all.add(s.a, s.d);
        all.add(s.b, s.d);
        break;
    case spv::OpAny:
    case spv::OpAll:
        all.add(s.a, s.d);
        break;
    case spv::OpTranspose:
        all.add(s.a, n);
        break;
    case spv::OpIAddCarry:
    case spv::OpISubBorrow:
    case spv::OpUMulExtended:
    case spv::OpSMulExtended:
        all.add(s.a, n / 2);
        all.add(s.b, n / 2);
        break;
    case spv::OpBitFieldInsert:
        all.add(s.a, n);
        all.add(s.b, n);
        all.add(s.c, 1);
        all.add(s.d, 1);
        break;
    case spv::OpBitFieldSExtract:
    case spv::OpBitFieldUExtract:
        all.add(s.a, n);
        all.add(s.b, 1);
        all.add(s.c, 1);
        break;
    default:
        all.by_component = true;
        all.add(s.a, n);
        const bool one = s.op <= spv::OpConvertUToF || s.op == spv::OpSNegate || s.op == spv::OpFNegate ||
                         s.op == spv::OpNot || s.op == spv::OpLogicalNot || s.op == spv::OpIsNan ||
                         s.op == spv::OpIsInf || s.op == spv::OpBitReverse || s.op == spv::OpBitCount;
        if (!one)
            all.add(s.b, n);
    }
    return all;
}

/// Of a square matrix.
inline double determinant(std::span<const double> m) {
    const auto size = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(m.size()))));
    if (size == 1)
        return m[0];
    double sum = 0.0;
    for (std::size_t left = 0; left < size; ++left) {
        std::vector<double> minor;
        for (std::size_t i = size; i < m.size(); ++i)
            if (i % size != left)
                minor.push_back(m[i]);
        sum += (left % 2 == 0 ? 1.0 : -1.0) * m[left] * determinant(minor);
    }
    return sum;
}

/// A finding: something depends on what has no value.
template <class R, int W> void Machine<R, W>::depend(const Unset& from, Place at, Lane l) {
    if (from.result != 0) {
        const ResultWithoutValue& made = results_without_value_[from.result - 1];
        memory_.findings().add(made.rule, {made.line, at.invocation}, [&] { return made.what[l]; });
        return;
    }
    memory_.findings().add(unset_rule, {from.line != 0 ? from.line : at.line, at.invocation},
                           [&] { return p_.variable_at(from.cell - 1); });
}

/// What an operation makes that has no result, in one lane.
template <class R, int W> template <class What>
auto Machine<R, W>::without_value(std::string_view rule, Place at, Lane l, const What& what) -> Unset {
    std::uint32_t k = 0;
    while (k < results_without_value_.size() &&
           (results_without_value_[k].line != at.line || results_without_value_[k].rule != rule))
        ++k;
    if (k == results_without_value_.size())
        results_without_value_.push_back({.rule = rule, .line = at.line});
    results_without_value_[k].what[l] = what();
    return {.cell = 1, .line = at.line, .result = k + 1};
}

/// Something depends on n cells from `first`.
template <class R, int W> void Machine<R, W>::need(const Step& s, std::uint32_t first, std::uint32_t n) {
    active([&](Lane l) {
        for (std::uint32_t c = 0; c < n; ++c)
            if (const Unset from = unset(first + c)[l]; from.cell != 0)
                return depend(from, place(s, l), l);
    });
}

template <class R, int W> void Machine<R, W>::need_shared(const Step& s, std::uint32_t word, Lane l) {
    memory_.findings().add(unset_shared_rule, place(s, l),
                           [&] { return fmt::format("shared {}", p_.shared_at(word)); });
}

/// Follows unset values through a step that is about to run.
template <class R, int W> void Machine<R, W>::follow(const Step& s) {
    const auto read = [&](Unset from, Lane l) { // the line of the first operation that used it
        if (from.cell != 0 && from.line == 0)
            from.line = place(s, l).line;
        return from;
    };
    const auto forget = [&](std::uint32_t n) {
        active([&](Lane l) {
            for (std::uint32_t c = 0; c < n; ++c)
                unset(s.out + c)[l] = {};
        });
    };
    if (is_subgroup_operation(s.op))
        return follow_subgroup(s);
    switch (s.op) {
    case code::copy:
    case code::real_bits:
    case code::bits_as_real:
        if (p_.is_counted(s.out))
            need(s, s.a, s.n);
        active([&](Lane l) {
            for (std::uint32_t c = 0; c < s.n; ++c)
                unset(s.out + c)[l] = s.out + c < p_.output_cells ? read(unset(s.a + c)[l], l) : unset(s.a + c)[l];
        });
        return;
    case code::load_variable:
        active([&](Lane l) {
            for (std::uint32_t c = 0; c < s.n; ++c)
                unset(s.out + c)[l] = unset(s.a + cell(s.b)[l].word() + c)[l];
        });
        return;
    case code::store_variable:
        if (p_.is_counted(s.a))
            need(s, s.c, s.n);
        active([&](Lane l) {
            for (std::uint32_t c = 0; c < s.n; ++c)
                unset(s.a + cell(s.b)[l].word() + c)[l] = unset(s.c + c)[l];
        });
        return;
    case code::address:
        for (std::uint32_t k = 0; k < s.n; ++k)
            need(s, p_.operands[s.d + 3 * k], 1);
        return forget(1);
    case code::load_shared:
        active([&](Lane l) {
            for (std::uint32_t c = 0; c < s.n; ++c)
                if (const std::uint32_t word = cell(s.b)[l].word() + c; memory_.is_unset(word))
                    need_shared(s, word, l);
        });
        return forget(s.n);
    case code::store_shared:
    case code::store_block:
        return need(s, s.c, s.n);
    case code::load_block:
        return forget(s.n);
    case code::atomic_shared:
    case code::atomic_block:
    case code::atomic_texel:
        if (s.n != spv::OpAtomicLoad && s.n != spv::OpAtomicIIncrement && s.n != spv::OpAtomicIDecrement)
            need(s, s.c, 1);
        if (s.op == code::atomic_texel)
            need(s, s.b, p_.images[cell(s.a)[active_[0]].word()].shape.axes());
        return forget(s.out != no_cell ? 1 : 0);
    case code::load_texel:
    case code::fetch_texel:
    case code::sample_texel:
        need(s, s.b, s.c);
        return forget(s.n);
    case code::store_texel:
        need(s, s.b, s.d);
        active([&](Lane l) {
            const std::uint32_t stored = memory_.image(cell(s.a)[l].word()).components;
            need(s, s.c, std::min<std::uint32_t>(stored, s.n));
        });
        return;
    case code::array_length:
    case code::image_size:
    case code::query_levels:
        return forget(s.n);
    case code::differ_x:
    case code::differ_y:
    case code::differ_both:
        need(s, s.a, s.n);
        return forget(s.n);
    case code::branch:
    case code::choose:
        return need(s, s.a, 1);
    case spv::OpSelect:
        need(s, s.a, s.d != 0 ? s.n : 1);
        active([&](Lane l) {
            for (std::uint32_t c = 0; c < s.n; ++c)
                unset(s.out + c)[l] = unset((cell(s.d != 0 ? s.a + c : s.a)[l].word() != 0 ? s.b : s.c) + c)[l];
        });
        return;
    case spv::OpLogicalAnd:
    case spv::OpLogicalOr: // as && and || do: the second counts where the first does not decide
        active([&](Lane l) {
            for (std::uint32_t c = 0; c < s.n; ++c) {
                const Unset first = read(unset(s.a + c)[l], l);
                const bool decides = (cell(s.a + c)[l].word() != 0) == (s.op == spv::OpLogicalOr);
                unset(s.out + c)[l] = first.cell != 0 || decides ? first : read(unset(s.b + c)[l], l);
            }
        });
        return;
    case spv::OpVectorExtractDynamic:
        need(s, s.b, 1);
        active([&](Lane l) {
            const std::uint32_t index = cell(s.b)[l].word();
            unset(s.out)[l] = index < s.d ? unset(s.a + index)[l] : Unset{};
        });
        return;
    case spv::OpVectorInsertDynamic:
        need(s, s.c, 1);
        active([&](Lane l) {
            for (std::uint32_t c = 0; c < s.n; ++c)
                unset(s.out + c)[l] = unset(cell(s.c)[l].word() == c ? s.b : s.a + c)[l];
        });
        return;
    default:
        break;
    }
    if (s.op >= code::own)
        return;
    const StepOperands operands = operands_of(s);
    active([&](Lane l) {
        Unset any;
        const auto take = [&](std::uint32_t number) {
            if (any.cell == 0)
                any = read(unset(number)[l], l);
        };
        if (operands.by_component) {
            for (std::uint32_t c = 0; c < s.n; ++c) {
                any = {};
                for (std::size_t k = 0; k < operands.count; ++k)
                    take(operands.cell(k, c));
                unset(s.out + c)[l] = any;
            }
            return;
        }
        for (std::size_t k = 0; k < operands.count; ++k)
            for (std::uint32_t c = 0; c < operands.ranges[k].second; ++c)
                take(operands.ranges[k].first + c);
        for (std::uint32_t c = 0; c < s.n; ++c)
            unset(s.out + c)[l] = any;
    });
}

/// Marks what a step that is about to run makes of operands for which GLSL defines no result. Of operands without a
/// value it is a mere consequence.
template <class R, int W> void Machine<R, W>::check(const Step& s) {
    const auto x = [&](std::uint32_t first, std::uint32_t c, Lane l) {
        return static_cast<float>(cell(first + c)[l].real());
    };
    const auto i = [&](std::uint32_t first, std::uint32_t c, Lane l) {
        return static_cast<std::int32_t>(cell(first + c)[l].word());
    };
    /// For each component: is(l, c) says whether it has no result, what(l, c) what it is of.
    const auto each_component = [&](std::string_view rule, const auto& is, const auto& what) {
        active([&](Lane l) {
            for (std::uint32_t c = 0; c < s.n; ++c)
                if (unset(s.out + c)[l].cell == 0 && is(l, c))
                    unset(s.out + c)[l] = without_value(rule, place(s, l), l, [&] { return what(l, c); });
        });
    };
    const auto whole = [&](Lane l, std::string_view rule, std::string_view what) {
        for (std::uint32_t c = 0; c < s.n; ++c)
            if (unset(s.out + c)[l].cell == 0)
                unset(s.out + c)[l] = without_value(rule, place(s, l), l, [&] { return std::string(what); });
    };
    const auto of_one = [&](std::string_view name, std::string_view rule, const auto& is) {
        each_component(
            rule, [&](Lane l, std::uint32_t c) { return is(x(s.a, c, l)); },
            [&](Lane l, std::uint32_t c) { return fmt::format("{}({})", name, x(s.a, c, l)); });
    };
    const auto of_two = [&](std::string_view name, std::string_view rule, const auto& is) {
        each_component(
            rule, [&](Lane l, std::uint32_t c) { return is(x(s.a, c, l), x(s.b, c, l)); },
            [&](Lane l, std::uint32_t c) { return fmt::format("{}({}, {})", name, x(s.a, c, l), x(s.b, c, l)); });
    };
    const auto of_whole = [&](std::string_view sign, std::string_view rule, const auto& is) {
        each_component(
            rule, [&](Lane l, std::uint32_t c) { return is(i(s.a, c, l), i(s.b, c, l)); },
            [&](Lane l, std::uint32_t c) { return fmt::format("{} {} {}", i(s.a, c, l), sign, i(s.b, c, l)); });
    };
    const auto is_nan = [](float a, float b) { return std::isnan(a) || std::isnan(b); };
    constexpr std::string_view division = "division of integers by 0 (GLSL 4.60, 5.9)",
                               remainder = "% of a negative operand, or by 0 (GLSL 4.60, 5.9)",
                               shift = "shift by a negative count, or by 32 or more (GLSL 4.60, 5.9)",
                               bit_field = "bit field beyond 32 bits (GLSL 4.60, 8.8)",
                               nan = "min, max or clamp of NaN (GLSL 4.60, 8.3)",
                               reversed = "clamp with a minimum above its maximum (GLSL 4.60, 8.3)",
                               conversion =
                                   "conversion of a float that the integer type does not have (GLSL 4.60, 5.4.1)";
    switch (s.op) {
    case spv::OpUDiv:
        return of_whole("/", division, [](auto, auto b) { return b == 0; });
    case spv::OpSDiv:
        of_whole("/", "division of the least int by -1 (GLSL 4.60, 4.1.3)",
                 [](auto a, auto b) { return a == std::numeric_limits<std::int32_t>::min() && b == -1; });
        return of_whole("/", division, [](auto, auto b) { return b == 0; });
    case spv::OpUMod:
        return of_whole("%", remainder, [](auto, auto b) { return b == 0; });
    case spv::OpSRem:
    case spv::OpSMod:
        return of_whole("%", remainder, [](auto a, auto b) { return a < 0 || b <= 0; });
    case spv::OpFMod:
        return of_two("mod", "mod by 0 (GLSL 4.60, 8.3)", [](float, float b) { return b == 0.0F; });
    case spv::OpShiftLeftLogical:
        return of_whole("<<", shift, [](auto, auto b) { return b < 0 || b > 31; });
    case spv::OpShiftRightLogical:
    case spv::OpShiftRightArithmetic:
        return of_whole(">>", shift, [](auto, auto b) { return b < 0 || b > 31; });
    case spv::OpBitFieldInsert:
    case spv::OpBitFieldSExtract:
    case spv::OpBitFieldUExtract: {
        const std::uint32_t offset = s.op == spv::OpBitFieldInsert ? s.c : s.b,
                            bits = s.op == spv::OpBitFieldInsert ? s.d : s.c;
        return each_component(
            bit_field,
            [&](Lane l, std::uint32_t) {
                const std::int64_t from = i(offset, 0, l), count = i(bits, 0, l);
                return from < 0 || count < 0 || from + count > 32;
            },
            [&](Lane l, std::uint32_t) { return fmt::format("{} bits from bit {}", i(bits, 0, l), i(offset, 0, l)); });
    }
    case spv::OpConvertFToS:
        return of_one("int", conversion, [](float a) { return !(a > -2147483904.0F && a < 2147483648.0F); });
    case spv::OpConvertFToU:
        return of_one("uint", conversion, [](float a) { return !(a >= 0.0F && a < 4294967296.0F); });
    case code::extended + GLSLstd450Pow:
        return of_two("pow", "pow of a negative base, or of 0 to no positive power (GLSL 4.60, 8.2)",
                      [](float a, float b) { return a < 0.0F || (a == 0.0F && b <= 0.0F); });
    case code::extended + GLSLstd450Log:
    case code::extended + GLSLstd450Log2:
        return of_one(s.op == code::extended + GLSLstd450Log ? "log" : "log2", "log of 0 or less (GLSL 4.60, 8.2)",
                      [](float a) { return a <= 0.0F; });
    case code::extended + GLSLstd450Sqrt:
        return of_one("sqrt", "sqrt of a negative number (GLSL 4.60, 8.2)", [](float a) { return a < 0.0F; });
    case code::extended + GLSLstd450InverseSqrt:
        return of_one("inversesqrt", "inversesqrt of 0 or less (GLSL 4.60, 8.2)", [](float a) { return a <= 0.0F; });
    case code::extended + GLSLstd450Asin:
    case code::extended + GLSLstd450Acos:
        return of_one(s.op == code::extended + GLSLstd450Asin ? "asin" : "acos",
                      "asin or acos beyond 1 (GLSL 4.60, 8.1)", [](float a) { return std::abs(a) > 1.0F; });
    case code::extended + GLSLstd450Acosh:
        return of_one("acosh", "acosh below 1 (GLSL 4.60, 8.1)", [](float a) { return a < 1.0F; });
    case code::extended + GLSLstd450Atanh:
        return of_one("atanh", "atanh of 1 or beyond (GLSL 4.60, 8.1)", [](float a) { return std::abs(a) >= 1.0F; });
    case code::extended + GLSLstd450Atan2:
        return of_two("atan", "atan(0, 0) (GLSL 4.60, 8.1)", [](float a, float b) { return a == 0.0F && b == 0.0F; });
    case code::extended + GLSLstd450FMin:
        return of_two("min", nan, is_nan);
    case code::extended + GLSLstd450FMax:
        return of_two("max", nan, is_nan);
    case code::extended + GLSLstd450FClamp: {
        const auto what = [&](Lane l, std::uint32_t c) {
            return fmt::format("clamp({}, {}, {})", x(s.a, c, l), x(s.b, c, l), x(s.c, c, l));
        };
        each_component(
            reversed, [&](Lane l, std::uint32_t c) { return x(s.b, c, l) > x(s.c, c, l); }, what);
        return each_component(
            nan,
            [&](Lane l, std::uint32_t c) { return is_nan(x(s.a, c, l), x(s.b, c, l)) || std::isnan(x(s.c, c, l)); },
            what);
    }
    case code::extended + GLSLstd450UClamp:
    case code::extended + GLSLstd450SClamp:
        return each_component(
            reversed,
            [&](Lane l, std::uint32_t c) {
                return s.op == code::extended + GLSLstd450SClamp ? i(s.b, c, l) > i(s.c, c, l)
                                                                 : cell(s.b + c)[l].word() > cell(s.c + c)[l].word();
            },
            [&](Lane l, std::uint32_t c) {
                return fmt::format("clamp({}, {}, {})", i(s.a, c, l), i(s.b, c, l), i(s.c, c, l));
            });
    case code::extended + GLSLstd450SmoothStep:
        return of_two("smoothstep", "smoothstep whose edges are equal or reversed (GLSL 4.60, 8.3)",
                      [](float low, float high) { return low >= high; });
    case code::extended + GLSLstd450Ldexp:
        return each_component(
            "ldexp beyond what a float can be (GLSL 4.60, 8.3)",
            [&](Lane l, std::uint32_t c) {
                const float a = x(s.a, c, l);
                return i(s.b, c, l) > 128 || (std::isfinite(a) && std::isinf(std::ldexp(a, i(s.b, c, l))));
            },
            [&](Lane l, std::uint32_t c) { return fmt::format("ldexp({}, {})", x(s.a, c, l), i(s.b, c, l)); });
    case code::extended + GLSLstd450FrexpStruct:
        return each_component( // first the numbers, then their exponents
            "frexp of infinity or NaN (GLSL 4.60, 8.3)",
            [&](Lane l, std::uint32_t c) { return !std::isfinite(x(s.a, c % s.d, l)); },
            [&](Lane l, std::uint32_t c) { return fmt::format("frexp({})", x(s.a, c % s.d, l)); });
    case code::extended + GLSLstd450MatrixInverse:
        active([&](Lane l) {
            std::vector<double> m;
            for (std::uint32_t c = 0; c < s.n; ++c)
                m.push_back(x(s.a, c, l));
            if (determinant(m) == 0.0)
                whole(l, "inverse of a singular matrix (GLSL 4.60, 8.6)", "determinant 0");
        });
        return;
    case code::extended + GLSLstd450Normalize:
        active([&](Lane l) {
            bool is_zero = true;
            for (std::uint32_t c = 0; c < s.d; ++c)
                is_zero = is_zero && x(s.a, c, l) == 0.0F;
            if (is_zero)
                whole(l, "normalize of a vector of length 0 (GLSL 4.60, 8.5)", "normalize(0)");
        });
        return;
    default:
        return;
    }
}

} // namespace lockstep::text
