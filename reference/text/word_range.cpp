#include "reference/text/word_range.hpp"

#include <bit>
#include <cmath>

#include <spirv.hpp>

namespace lockstep::text::word_range {
namespace {

using Result = std::optional<WordRange>;
constexpr std::uint32_t most_words = 1U << 31U;

std::int32_t number(std::uint32_t word) { return static_cast<std::int32_t>(word); }
bool is_single(const WordRange& a) { return a.more == 0; }

Result between(std::uint32_t first, std::uint32_t last) {
    return last - first < most_words ? Result(WordRange{first, last - first}) : std::nullopt;
}
Result sum(const WordRange& a, const WordRange& b) {
    if (a.more >= most_words || b.more >= most_words - a.more)
        return {};
    return WordRange{a.first + b.first, a.more + b.more};
}
WordRange negative(const WordRange& a) { return {0U - a.last(), a.more}; }

/// The words between multiples are taken, too.
Result product(const WordRange& a, std::uint32_t by) {
    const bool is_negative = number(by) < 0;
    const std::uint32_t times = is_negative ? 0U - by : by;
    if (std::uint64_t{a.more} * times >= most_words)
        return is_single(a) ? Result(WordRange{a.first * by, 0}) : std::nullopt;
    const WordRange made{a.first * times, a.more * times};
    return is_negative ? negative(made) : made;
}

/// f grows with its operand, in the order that it is taken in.
template <class F> Result growing(const WordRange& a, bool has_order, const F& f) {
    return has_order ? between(static_cast<std::uint32_t>(f(a.first)), static_cast<std::uint32_t>(f(a.last())))
                     : std::nullopt;
}

/// f is bit by bit, of the one word that the other operand is.
template <class F> Result bit_by_bit(const WordRange& a, std::uint32_t with, const F& f) {
    if (!a.is_unsigned())
        return {};
    const int open = std::bit_width(a.first ^ a.last()); // the bits above are the same in all of them
    const std::uint32_t low = open == 32 ? ~0U : (1U << static_cast<unsigned>(open)) - 1U;
    const auto of = [&](std::uint32_t word) { return static_cast<std::uint32_t>(f(word, with)); };
    const std::uint32_t of_zeros = of(a.first & ~low) & low, of_ones = of(a.first | low) & low;
    if (of_zeros == 0 && of_ones == low) // the open bits stay
        return between(of(a.first), of(a.last()));
    if (of_zeros == low && of_ones == 0) // each is turned
        return between(of(a.last()), of(a.first));
    const std::uint32_t above = of(a.first) & ~low;
    return between(above | (of_zeros & of_ones), above | of_zeros | of_ones);
}
/// Of operations for which the order of operands does not matter.
template <class F> Result either_bit_by_bit(const WordRange& a, const WordRange& b, const F& f) {
    if (is_single(b))
        return bit_by_bit(a, b.first, f);
    return is_single(a) ? bit_by_bit(b, a.first, f) : std::nullopt;
}

Result truth(bool can_hold, bool can_fail) {
    return WordRange{can_hold && !can_fail ? 1U : 0U, can_hold && can_fail ? 1U : 0U};
}
/// a < b, or a <= b.
Result is_less(const WordRange& a, const WordRange& b, bool or_equal, bool is_signed) {
    const auto less = [&](std::uint32_t x, std::uint32_t y) {
        return x == y ? or_equal : is_signed ? number(x) < number(y) : x < y;
    };
    const bool has_order = is_signed ? a.is_signed() && b.is_signed() : a.is_unsigned() && b.is_unsigned();
    return has_order ? truth(less(a.first, b.last()), !less(a.last(), b.first)) : truth(true, true);
}
bool have_common(const WordRange& a, const WordRange& b) { return a.contains(b.first) || b.contains(a.first); }

} // namespace

Result of(std::uint32_t operation, const WordRange& a, const WordRange& b) {
    const std::uint32_t by = b.first & 31U;
    switch (operation) {
    case spv::OpSNegate:
        return negative(a);
    case spv::OpNot:
        return WordRange{~a.last(), a.more};
    case spv::OpIAdd:
        return sum(a, b);
    case spv::OpISub:
        return sum(a, negative(b));
    case spv::OpIMul:
        return is_single(b) ? product(a, b.first) : is_single(a) ? product(b, a.first) : std::nullopt;
    case spv::OpUDiv:
        if (is_single(b) && b.first == 0)
            return WordRange{~0U, 0};
        return growing(a, is_single(b) && a.is_unsigned(), [&](std::uint32_t x) { return x / b.first; });
    case spv::OpSDiv:
        if (is_single(b) && b.first == 0)
            return WordRange{~0U, 0};
        if (is_single(b) && number(b.first) < 0)
            return is_single(a) ? Result(WordRange{b.first == ~0U
                                                       ? 0U - a.first
                                                       : static_cast<std::uint32_t>(number(a.first) / number(b.first)),
                                                   0})
                                : std::nullopt;
        return growing(a, is_single(b) && a.is_signed(), [&](std::uint32_t x) { return number(x) / number(b.first); });
    case spv::OpIEqual:
        return truth(have_common(a, b), !is_single(a) || !is_single(b) || a.first != b.first);
    case spv::OpINotEqual:
        return truth(!is_single(a) || !is_single(b) || a.first != b.first, have_common(a, b));
    case spv::OpULessThan:
        return is_less(a, b, false, false);
    case spv::OpSLessThan:
        return is_less(a, b, false, true);
    case spv::OpULessThanEqual:
        return is_less(a, b, true, false);
    case spv::OpSLessThanEqual:
        return is_less(a, b, true, true);
    case spv::OpUGreaterThan:
        return is_less(b, a, false, false);
    case spv::OpSGreaterThan:
        return is_less(b, a, false, true);
    case spv::OpUGreaterThanEqual:
        return is_less(b, a, true, false);
    case spv::OpSGreaterThanEqual:
        return is_less(b, a, true, true);
    case spv::OpShiftRightLogical:
        return growing(a, is_single(b) && a.is_unsigned(), [&](std::uint32_t x) { return x >> by; });
    case spv::OpShiftRightArithmetic:
        return growing(a, is_single(b) && a.is_signed(), [&](std::uint32_t x) { return number(x) >> by; });
    case spv::OpShiftLeftLogical:
        return is_single(b) ? product(a, 1U << by) : std::nullopt;
    case spv::OpBitwiseOr:
        return either_bit_by_bit(a, b, [](std::uint32_t x, std::uint32_t y) { return x | y; });
    case spv::OpBitwiseXor:
        return either_bit_by_bit(a, b, [](std::uint32_t x, std::uint32_t y) { return x ^ y; });
    case spv::OpBitwiseAnd:
        return either_bit_by_bit(a, b, [](std::uint32_t x, std::uint32_t y) { return x & y; });
    default:
        return {};
    }
}

bool is_known(std::uint32_t operation) { return of(operation, {}, {}).has_value(); }

std::optional<WordRange> of_atomic(std::uint32_t operation, const WordRange& a, const WordRange& b) {
    const bool is_signed = operation == spv::OpAtomicSMin || operation == spv::OpAtomicSMax;
    const auto is_less = [&](std::uint32_t x, std::uint32_t y) { return is_signed ? number(x) < number(y) : x < y; };
    const auto least = [&](std::uint32_t x, std::uint32_t y) { return is_less(y, x) ? y : x; };
    const auto most = [&](std::uint32_t x, std::uint32_t y) { return is_less(x, y) ? y : x; };
    const bool has_order = is_signed ? a.is_signed() && b.is_signed() : a.is_unsigned() && b.is_unsigned();
    switch (operation) {
    case spv::OpAtomicIAdd:
        return sum(a, b);
    case spv::OpAtomicSMin:
    case spv::OpAtomicUMin:
        return has_order ? between(least(a.first, b.first), least(a.last(), b.last())) : std::nullopt;
    case spv::OpAtomicSMax:
    case spv::OpAtomicUMax:
        return has_order ? between(most(a.first, b.first), most(a.last(), b.last())) : std::nullopt;
    default:
        return {};
    }
}

std::optional<Interval> floats(const WordRange& a) {
    const float first = std::bit_cast<float>(a.first), last = std::bit_cast<float>(a.last());
    if (!a.is_unsigned() || a.first >> 31U != a.last() >> 31U || std::isnan(first) || std::isnan(last))
        return {};
    return a.first >> 31U == 0 ? Interval(double{first}, double{last}) : Interval(double{last}, double{first});
}

Result bits(const Interval& set) {
    const auto of = [](double x) { return std::bit_cast<std::uint32_t>(static_cast<float>(x)); };
    if (set.any || !(set.low >= 0.0 || set.high <= 0.0))
        return {};
    if (set.low >= 0.0)
        return between(of(set.low == 0.0 ? 0.0 : set.low), of(set.high));
    return between(of(set.high == 0.0 ? -0.0 : set.high), of(set.low));
}

} // namespace lockstep::text::word_range
