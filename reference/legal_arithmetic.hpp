#pragma once
#include <array>
#include <initializer_list>
#include <type_traits>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "reference/arithmetic.hpp"
#include "reference/interval.hpp"
#include "reference/known_operations.hpp"
#include "reference/portable.hpp"

namespace lockstep {

using Interval3 = std::array<Interval, 3>;

/// What each operation of the listing may legally give, from GLSL 4.50.7, 4.7.1: division 2.5 ULP, inversesqrt 2 ULP,
/// sqrt as 1 / inversesqrt, length and normalize as the Vulkan environment derives them, sums in any order and fused or
/// not unless `precise`; subnormals flushed or not. Where an operation is known, its result is the point
/// that `A` (arithmetic.hpp) computes; where the driver sums in another order without `precise`, it is what both orders
/// give and what lies between. A function's result is a set of floats unless it says otherwise.
template <class A> class LegalArithmetic {
  public:
    LegalArithmetic(A fp, const KnownOperations& known, const OtherOrders& other_orders = {})
        : fp_(fp), known_(known), other_orders_(other_orders) {
        if constexpr (own_rules)
            known_ = KnownOperations::all();
    }

    [[nodiscard]] const KnownOperations& known() const { return known_; }

    /// A value as it is read: attributes, uniforms, texels.
    [[nodiscard]] Interval read(float value) const { return flushed(point(fp_.flush(value))); }
    [[nodiscard]] Interval3 read(glm::vec3 v) const { return {read(v.x), read(v.y), read(v.z)}; }

    [[nodiscard]] Interval sum(Interval a, Interval b) const {
        if (a.any || b.any)
            return Interval::anything();
        if (!known_.sums)
            return loose_sum({a, b});
        const auto add = [this](double x, double y) {
            return fp_.flush(static_cast<float>(x) + static_cast<float>(y));
        };
        return flushed(ends(add(a.low, b.low), add(a.high, b.high)));
    }
    /// Of two floats no order can give another result.
    [[nodiscard]] Interval difference(Interval a, Interval b) const {
        if (a.any || b.any)
            return Interval::anything();
        if (!known_.sums && !(a.is_point() && b.is_point()))
            return loose_sum({a, interval::negate(b)});
        const auto subtract = [this](double x, double y) {
            return fp_.flush(static_cast<float>(x) - static_cast<float>(y));
        };
        return flushed(ends(subtract(a.low, b.high), subtract(a.high, b.low)));
    }

    /// Unless `precise`, the real product, rounded or not: what a fused operation adds to.
    [[nodiscard]] Interval product(Interval a, Interval b) const {
        if (a.any || b.any)
            return Interval::anything();
        if (!known_.sums)
            return flushed(interval::widen(interval::multiply(a, b), loose));
        const auto multiply = [this](double x, double y) {
            return fp_.flush(fp_.flush(static_cast<float>(x)) * fp_.flush(static_cast<float>(y)));
        };
        if (a.is_point() && b.is_point())
            return flushed(point(multiply(a.low, b.low)));
        Interval result = flushed(ends(multiply(a.low, b.low), multiply(a.low, b.low)));
        for (const float end : {multiply(a.low, b.high), multiply(a.high, b.low), multiply(a.high, b.high)})
            result = interval::hull(result, flushed(ends(end, end)));
        return result;
    }

    /// A number's product with itself: of its size, and so never below 0.
    [[nodiscard]] Interval square(Interval v) const {
        const Interval size = interval::magnitude(v);
        return not_negative(product(size, size));
    }

    /// Where factors may be taken in another order: x * y of rounded products, against any other order of their
    /// factors, which has as many roundings. Each rounding is 2^-24; those of this product, of the other, and of the
    /// one within.
    [[nodiscard]] Interval product_of_products(Interval a, Interval b) const { return in_another_order(product(a, b)); }
    [[nodiscard]] Interval square_of_product(Interval v) const {
        const Interval size = interval::magnitude(v);
        return not_negative(product_of_products(size, size));
    }
    [[nodiscard]] Interval quotient_of_products(Interval a, Interval b) const { return in_another_order(divide(a, b)); }

    [[nodiscard]] Interval3 sum(const Interval3& a, const Interval3& b) const {
        return {sum(a[0], b[0]), sum(a[1], b[1]), sum(a[2], b[2])};
    }
    [[nodiscard]] Interval3 difference(const Interval3& a, const Interval3& b) const {
        return {difference(a[0], b[0]), difference(a[1], b[1]), difference(a[2], b[2])};
    }
    [[nodiscard]] Interval3 scale(const Interval3& v, Interval s) const {
        return {product(v[0], s), product(v[1], s), product(v[2], s)};
    }

    [[nodiscard]] Interval divide(Interval a, Interval b) const {
        if (a.any || b.any)
            return Interval::anything();
        const bool by_zero = b.is_point() && b.low == 0.0;
        if (a.is_point() && b.is_point() && (known_.divide || by_zero))
            return flushed(point(fp_.divide(a.as_float(), b.as_float())));
        constexpr double largest_divisor = 0x1p126;
        if (!known_.divide && !(b.high <= largest_divisor && b.low >= -largest_divisor))
            return Interval::anything();
        const double error = known_.divide ? 0.5 : 2.5;
        return interval::to_floats(flushed(interval::widen(interval::divide(a, b), error)));
    }

    [[nodiscard]] Interval square_root(Interval v) const {
        if (v.any || (v.is_point() && (known_.square_root || v.low == 0.0)))
            return v.any ? v : point(fp_.sqrt(v.as_float()));
        if (!(v.low >= 0.0))
            return Interval::anything();
        if (known_.square_root)
            return ends(fp_.sqrt(static_cast<float>(v.low)), fp_.sqrt(static_cast<float>(v.high)));
        const auto by_inverse = [](double x) {
            const Interval inverse = interval::widen(interval::divide(1.0F, interval::square_root({x, x})), 2.0);
            return interval::to_floats(interval::widen(interval::divide(1.0F, inverse), 2.5));
        };
        const double low = v.low == 0.0 ? 0.0 : by_inverse(v.low).low;
        return {low, by_inverse(v.high).high};
    }

    /// Of two vectors of floats, where dot is known.
    [[nodiscard]] Interval dot(glm::vec3 a, glm::vec3 b) const {
        Interval set = point(fp_.dot(a, b));
        for (const DotOrder order : other_orders_.dot)
            set = own_rules ? set : interval::hull(set, point(dot_in(order, a, b)));
        return set;
    }

    [[nodiscard]] Interval squared_length(const Interval3& v) const {
        if (known_.dot && are_points(v))
            return dot(as_floats(v), as_floats(v));
        return interval::to_floats(
            loose_sum({loose_square(v[0]), loose_square(v[1]), loose_square(v[2])}, Sign::not_negative));
    }

    [[nodiscard]] Interval length(const Interval3& v) const {
        if (known_.dot && known_.square_root && are_points(v))
            return with_others(point(fp_.length(as_floats(v))), other_orders_.length, v,
                               [this](float sum) { return fp_.length_of(sum); });
        return square_root(squared_length(v));
    }

    /// Anything where the length may be 0 (a direction then has no equation), except where the project's own
    /// arithmetic says NaN.
    [[nodiscard]] Interval3 normalize(const Interval3& v) const {
        if constexpr (own_rules)
            if (are_points(v)) {
                const glm::vec3 n = fp_.normalize(as_floats(v));
                return {Interval(n.x), Interval(n.y), Interval(n.z)};
            }
        const Interval squared = squared_length(v);
        if (squared.contains_zero())
            return {Interval::anything(), Interval::anything(), Interval::anything()};
        if (known_.normalize && are_points(v)) {
            const glm::vec3 n = fp_.normalize(as_floats(v));
            const auto component = [&](int c) {
                return with_others(point(n[c]), other_orders_.normalize, v,
                                   [this, c, v](float sum) { return fp_.direction_of(as_floats(v), sum)[c]; });
            };
            return {component(0), component(1), component(2)};
        }
        const Interval inverse = interval::to_floats(
            interval::widen(interval::divide(1.0F, interval::square_root(squared)), inverse_square_root));
        const auto component = [&](Interval x) {
            return interval::to_floats(flushed(interval::widen(interval::multiply(x, inverse), loose)));
        };
        return {component(v[0]), component(v[1]), component(v[2])};
    }

    /// matrix * vec4(v, 1)
    [[nodiscard]] std::array<Interval, 4> transform(const glm::mat4& m, const Interval3& v) const {
        const auto row = [&](int r) {
            const Interval x = product(read(m[0][r]), v[0]);
            const Interval y = product(read(m[1][r]), v[1]);
            const Interval z = product(read(m[2][r]), v[2]);
            const Interval w = read(m[3][r]);
            return known_.sums ? sum(sum(sum(x, y), z), w) : loose_sum({x, y, z, w});
        };
        return {row(0), row(1), row(2), row(3)};
    }

    static bool are_points(const Interval3& v) { return v[0].is_point() && v[1].is_point() && v[2].is_point(); }
    static glm::vec3 as_floats(const Interval3& v) { return {v[0].as_float(), v[1].as_float(), v[2].as_float()}; }

  private:
    enum class Sign { any, not_negative };

    /// The `exact` arithmetic leaves nothing to a driver, NaN included.
    static constexpr bool own_rules = std::is_same_v<A, Portable>;
    static constexpr double inverse_square_root = 2.0; ///< ULP
    /// ULP a + or * is given where its order and fusing are free: 1/2 for its own rounding and 1/2 for what another
    /// order of the same operations makes of the parts.
    static constexpr double loose = 1.0;

    static Interval point(float value) { return value != value && !own_rules ? Interval::anything() : Interval(value); }
    static Interval ends(float low, float high) {
        if (low != low || high != high)
            return own_rules ? Interval(low) : Interval::anything();
        return {double{low}, double{high}};
    }

    /// Roundings in a chain of factors that an order has and another has not, in ULP of the result.
    static constexpr double another_order = 3.0;
    [[nodiscard]] Interval in_another_order(Interval v) const {
        return v.any ? v : interval::to_floats(flushed(interval::widen(v, another_order)));
    }

    static Interval not_negative(Interval v) { return v.any || !(v.low < 0.0) ? v : Interval(0.0, v.high); }

    [[nodiscard]] Interval flushed(Interval v) const { return known_.subnormals ? v : interval::maybe_flushed(v); }

    [[nodiscard]] Interval loose_square(Interval v) const {
        return flushed(interval::widen(interval::square(v), loose));
    }

    /// The hull of what the operation gives in the driver's own order and in others of its sum of squares.
    template <class Finish> [[nodiscard]] Interval with_others(Interval own, const std::vector<DotOrder>& others,
                                                               const Interval3& v, const Finish& finish) const {
        if constexpr (!own_rules)
            for (const DotOrder order : others)
                own = interval::hull(own, point(finish(dot_in(order, as_floats(v), as_floats(v)))));
        return own;
    }

    /// A sum in any order: each of the additions may err by an ULP of the sum of magnitudes.
    template <class Terms = std::initializer_list<Interval>>
    [[nodiscard]] Interval loose_sum(const Terms& terms, Sign sign = Sign::any) const {
        Interval total(0.0F);
        double magnitude = 0.0;
        for (const Interval& term : terms) {
            if (term.any)
                return Interval::anything();
            total = interval::add(total, term);
            magnitude += std::max(std::abs(term.low), std::abs(term.high));
        }
        if (total.any)
            return total;
        const double error =
            magnitude == 0.0 ? 0.0 : loose * static_cast<double>(terms.size() - 1) * interval::ulp(magnitude);
        Interval result = flushed(interval::outward(total.low - error, total.high + error));
        if (sign == Sign::not_negative && !result.any)
            result.low = std::max(result.low, 0.0);
        return result;
    }

    A fp_;
    KnownOperations known_;
    OtherOrders other_orders_;
};

} // namespace lockstep
