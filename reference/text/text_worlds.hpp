#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>

#include "reference/plain_arithmetic.hpp"
#include "reference/readings/any_order.hpp"
#include "reference/readings/worlds.hpp"
#include "reference/text/cell.hpp"
#include "reference/text/function_precision.hpp"

namespace lockstep::text {

/// The reading of legal sets, with the words that a text has and twins have not. An operation of the text without
/// `precise` may be fused with others and take another order.
class TextWorlds : public Worlds<PlainArithmetic> {
  public:
    TextWorlds(const Profile& profile, const KnownOperations& known)
        : Worlds<PlainArithmetic>(PlainArithmetic(profile), known, profile.other_orders),
          of_orders_(PlainArithmetic(profile), {.sums = true, .subnormals = known.subnormals}) {}

    /// The operations from here on are those of a line of the text.
    void set_place(const Site& line, bool is_precise) {
        place_ = &line;
        is_precise_ = is_precise;
        set_free(!is_precise);
    }
    [[nodiscard]] bool is_precise() const { return is_precise_; }
    /// A sum whose terms may be taken in another order; a port of more digits may have the sum itself. Terms that are
    /// products may have a factor taken out, which rounds the result, and not what cancels.
    Real in_any_order(Real sum, std::span<const Interval> terms) {
        Interval all = of_all_orders(terms);
        if (!all.any && !all.is_point())
            all = interval::to_floats(interval::widen(all, static_cast<double>(terms.size() - 1)));
        if (constants_are_wide_ && !all.any)
            all = interval::hull(
                all, interval::to_floats(std::accumulate(terms.begin(), terms.end(), Interval(0.0F), interval::add)));
        return make({sum}, [&](const auto&) { return all; });
    }
    /// What is left of `a` by `divisor`, which lies between 0 and that, but for what the division rounds.
    Real rest_of(Real rest, Real a, Real divisor) {
        const Interval left = rest.set(), x = a.set(), y = divisor.set();
        if (left.any || x.any || y.any || !std::isfinite(x.low) || !std::isfinite(x.high) || y.contains_zero())
            return rest;
        const double margin =
            y.is_point() && y.low == 1.0 ? 0.0 : 2.0 * interval::ulp(std::max(std::abs(x.low), std::abs(x.high)));
        const double low = std::max(left.low, std::min(y.low, 0.0) - margin),
                     high = std::min(left.high, std::max(y.high, 0.0) + margin);
        if (low > high || (low == left.low && high == left.high))
            return rest;
        return make({rest}, [&](const auto&) { return Interval(low, high); });
    }
    using Worlds<PlainArithmetic>::end;
    using Worlds<PlainArithmetic>::set_free;
    /// Constants stand for the real numbers that they were rounded from.
    void take_constants_as_written() { constants_are_wide_ = true; }
    [[nodiscard]] bool has_wide_constants() const { return constants_are_wide_; }
    /// What a float may have been before it was rounded: few digits are taken to be all.
    Real before_rounding(float x) {
        constexpr std::uint32_t last_digits = 0xfffU;
        if ((std::bit_cast<std::uint32_t>(x) & last_digits) == 0 || !std::isfinite(x))
            return x;
        const double half = 0.5 * interval::ulp(x);
        return between(Interval(double{x} - half, double{x} + half));
    }
    template <class Condition> bool decide(At, const Condition& condition) {
        return Worlds<PlainArithmetic>::decide(*place_, condition);
    }
    int choose(int first, int last) { return Worlds<PlainArithmetic>::choose(*place_, first, last, 0.0); }

    /// A compiler may multiply by a constant's reciprocal: what is divided by one number is as open as without
    /// `precise`.
    void open_constant_divisors() { constant_divisors_open_ = true; }
    Real divide(At p, Real a, Real b) {
        if (constant_divisors_open_ && b.set().is_point())
            set_free(true);
        return Worlds<PlainArithmetic>::divide(p, a, b);
    }
    Real inverse_sqrt(At p, Real a) {
        const Interval x = a.set();
        if (x.is_point() && known().square_root && known().divide)
            return divide(p, Real(1.0F), sqrt(p, a));
        return make({a}, [x](const auto&) {
            if (x.any || !(x.low > 0.0))
                return Interval::anything();
            return interval::to_floats(
                interval::widen(interval::divide(1.0F, interval::square_root(x)), inverse_square_root_ulps));
        });
    }
    /// A component of normalize, of a vector whose dot product with itself is known.
    Real part_of_unit(At p, Real component, Real squared) { return component * inverse_sqrt(p, squared); }
    /// In one rounding, or in two.
    Real fma(At, Real a, Real b, Real c) {
        const Interval x = a.set(), y = b.set(), z = c.set();
        set_free(true);
        if (!x.is_point() || !y.is_point() || !z.is_point())
            return a * b + c;
        return make({a, b, c}, [&](const auto&) {
            const float p = x.as_float(), q = y.as_float(), s = z.as_float();
            const float one = std::fma(p, q, s), two = p * q + s;
            if (std::isnan(one) || std::isnan(two))
                return Interval::anything();
            return interval::maybe_flushed(Interval(double{std::min(one, two)}, double{std::max(one, two)}));
        });
    }
    /// No order of these was measured: they are free.
    [[nodiscard]] static DotOrder dot_order() { return DotOrder::left_to_right; }
    [[nodiscard]] static DotOrder length_order() { return DotOrder::left_to_right; }
    [[nodiscard]] static DotOrder normalize_order() { return DotOrder::left_to_right; }

    /// A way for each integer that a set lies on both sides of.
    Real floor(Real a) {
        const Interval x = a.set();
        if (x.any || !(std::abs(x.low) < 0x1p30 && std::abs(x.high) < 0x1p30) ||
            std::floor(x.high) - std::floor(x.low) > 3.0)
            return Worlds<PlainArithmetic>::floor(a);
        float down = static_cast<float>(std::floor(x.low));
        const auto last = static_cast<float>(std::floor(x.high));
        for (; down < last; down += 1.0F)
            if (decide(*place_, a < Real(down + 1.0F)))
                break;
        return uniform(*place_, down);
    }
    /// An integer that some monotone function gives of a set: from least(lowest) to most(highest), a way for each.
    template <class Least, class Most> Real whole_of(Real a, const Least& least, const Most& most) {
        const Interval x = a.set();
        if (x.any || !(std::abs(x.low) < 0x1p23 && std::abs(x.high) < 0x1p23))
            return monotone(a, most); // beyond, floats are integers
        const auto first = static_cast<int>(least(x.as_float())),
                   last = static_cast<int>(most(static_cast<float>(x.high)));
        if (last - first > most_integers)
            return make({a}, [&](const auto&) { return Interval(double(first), double(last)); });
        return uniform(*place_, static_cast<float>(choose(first, last)));
    }
    std::uint32_t to_int(At p, Real a) { return to_whole(p, a); }
    std::uint32_t to_uint(At p, Real a) { return to_whole(p, a); }

    Real function(GLSLstd450 f, Real a) {
        const Interval x = a.set();
        return make({a}, [&](const auto&) { return legal_function(f, x); });
    }
    Real function(GLSLstd450 f, Real a, Real b) {
        const Interval x = a.set(), y = b.set();
        return make({a, b}, [&](const auto&) { return legal_function(f, x, y); });
    }
    Real between(Interval set) {
        return make({}, [&](const auto&) { return set; });
    }
    Real anything(Undefined why) {
        return make(
            {}, [](const auto&) { return Interval::anything(); }, why);
    }
    /// Which of a word and the `more` after it: of a few, each is a way.
    std::uint32_t one_of(std::uint32_t more) {
        if (more > most_floats)
            end(Undefined::undecided);
        return static_cast<std::uint32_t>(choose(0, static_cast<int>(more)));
    }
    /// The float that it is; of a few, each is a way.
    float one_of(Real a) {
        const Interval x = a.set();
        if (x.any)
            end(a.why() == Undefined::none ? Undefined::not_a_number : a.why());
        if (x.is_point())
            return x.as_float();
        const std::int64_t low = number_of(x.as_float()), high = number_of(static_cast<float>(x.high));
        if (high - low > most_floats)
            end(Undefined::undecided);
        return float_of(low + choose(0, static_cast<int>(high - low)));
    }

  private:
    static constexpr double inverse_square_root_ulps = 2.0;
    static constexpr std::int64_t most_floats = 15;
    static constexpr int most_integers = 3;

    /// The ways that an invocation may go share most of their sums.
    Interval of_all_orders(std::span<const Interval> terms) {
        constexpr std::size_t most_kept = 1U << 16U;
        std::string key;
        for (const Interval& term : terms)
            for (const double end : {term.low, term.high, term.any ? 1.0 : 0.0})
                key.append(reinterpret_cast<const char*>(&end), sizeof end);
        if (sums_.size() >= most_kept)
            sums_.clear();
        const auto [kept, is_new] = sums_.try_emplace(std::move(key));
        if (is_new)
            kept->second = lockstep::any_order_sum(of_orders_, terms);
        return kept->second;
    }
    std::uint32_t to_whole(At p, Real a) {
        const Interval x = a.set();
        return x.is_point() ? TextValues::to_int(p, x.as_float())
                            : static_cast<std::uint32_t>(Worlds<PlainArithmetic>::to_int(*place_, a));
    }
    /// Floats in their order, 0 for both zeros.
    static std::int64_t number_of(float x) {
        const auto bits = std::bit_cast<std::uint32_t>(x);
        const auto magnitude = static_cast<std::int64_t>(bits & 0x7fffffffU);
        return (bits >> 31U) != 0 ? -magnitude : magnitude;
    }
    static float float_of(std::int64_t number) {
        return std::bit_cast<float>(number < 0 ? static_cast<std::uint32_t>(-number) | 0x80000000U
                                               : static_cast<std::uint32_t>(number));
    }

    static constexpr Site nowhere{"text"};
    const Site* place_ = &nowhere;
    bool is_precise_ = false;
    LegalArithmetic<PlainArithmetic> of_orders_;
    std::unordered_map<std::string, Interval> sums_; ///< of_all_orders
    bool constant_divisors_open_ = false, constants_are_wide_ = false;
};

} // namespace lockstep::text
