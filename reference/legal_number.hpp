#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/mat4x4.hpp>

#include "reference/legal_arithmetic.hpp"
#include "reference/numbers.hpp"
#include "reference/readings/vector.hpp"

namespace lockstep {

/// What is known of a condition: it may hold, it may not.
struct Truth {
    bool yes = false, no = false;

    [[nodiscard]] bool sure() const { return !no; }
    friend Truth operator&(Truth a, Truth b) { return {a.yes && b.yes, a.no || b.no}; }
};

/// A number of which the set of floats that it may be is known; `open`: GL leaves open what it is, or what it came of.
/// Refers to the arithmetic.
template <class A> class LegalNumber {
  public:
    LegalNumber() = default;
    LegalNumber(float x) : set_(x) {} // NOLINT: a float is one, as it stands
    LegalNumber(const LegalArithmetic<A>& arithmetic, Interval set, bool open = false)
        : arithmetic_(&arithmetic), set_(set), open_(open || set.any) {}

    [[nodiscard]] Interval set() const { return set_; }
    [[nodiscard]] bool open() const { return open_; }

    friend LegalNumber operator+(LegalNumber a, LegalNumber b) {
        return of(a, b, [](const auto& fp, Interval x, Interval y) { return fp.sum(x, y); });
    }
    friend LegalNumber operator-(LegalNumber a, LegalNumber b) {
        return of(a, b, [](const auto& fp, Interval x, Interval y) { return fp.difference(x, y); });
    }
    friend LegalNumber operator*(LegalNumber a, LegalNumber b) {
        return of(a, b, [](const auto& fp, Interval x, Interval y) { return fp.product(x, y); });
    }
    friend LegalNumber operator-(LegalNumber a) { return a.with(interval::negate(a.set_)); }
    friend LegalNumber abs(LegalNumber a) { return a.with(interval::magnitude(a.set_)); }
    /// clamp_to of triangle_interpolation.hpp.
    friend LegalNumber clamp_to(LegalNumber a, float high) {
        const double most = high;
        if (a.set_.any)
            return a.with({0.0, most});
        return a.with({std::clamp(a.set_.low, 0.0, most), std::clamp(a.set_.high, 0.0, most)});
    }

    /// Where the condition is open, and holds.
    friend LegalNumber where(Truth holds, LegalNumber x, float most) {
        if (!holds.yes || !holds.no)
            return x;
        const double end = most;
        return x.with(x.set_.any ? x.set_ : Interval(std::min(x.set_.low, end), std::min(x.set_.high, end)));
    }

    friend Truth operator<=(LegalNumber a, LegalNumber b) {
        if (a.set_.any || b.set_.any)
            return {true, true};
        return {a.set_.low <= b.set_.high, a.set_.high > b.set_.low};
    }
    friend Truth operator<(LegalNumber a, LegalNumber b) {
        if (a.set_.any || b.set_.any)
            return {true, true};
        return {a.set_.low < b.set_.high, a.set_.high >= b.set_.low};
    }
    friend Truth operator>=(LegalNumber a, LegalNumber b) { return b <= a; }
    friend Truth operator>(LegalNumber a, LegalNumber b) { return b < a; }

    friend LegalNumber choose(Truth condition, LegalNumber yes, LegalNumber no) {
        if (!condition.no || !condition.yes)
            return condition.yes ? yes : no;
        LegalNumber either = yes.arithmetic_ != nullptr ? yes : no;
        either.open_ = yes.open_ || no.open_;
        return either.with(interval::hull(yes.set_, no.set_));
    }

  private:
    [[nodiscard]] LegalNumber with(Interval set) const {
        LegalNumber other = *this;
        other.set_ = set;
        other.open_ = open_ || set.any;
        return other;
    }
    template <class Operation> static LegalNumber of(LegalNumber a, LegalNumber b, const Operation& operation) {
        if (a.arithmetic_ == nullptr && b.arithmetic_ == nullptr) // a compiler may compute it, exactly
            return LegalNumber(operation(LegalArithmetic<Strict>({}, KnownOperations()), a.set_, b.set_).as_float());
        const LegalArithmetic<A>* arithmetic = a.arithmetic_ != nullptr ? a.arithmetic_ : b.arithmetic_;
        return {*arithmetic, operation(*arithmetic, a.set_, b.set_), a.open_ || b.open_};
    }

    const LegalArithmetic<A>* arithmetic_ = nullptr; ///< null: a constant
    Interval set_{0.0F};
    bool open_ = false;
};

template <class A>
Vec3<LegalNumber<A>> choose(Truth condition, const Vec3<LegalNumber<A>>& yes, const Vec3<LegalNumber<A>>& no) {
    return {choose(condition, yes.x, no.x), choose(condition, yes.y, no.y), choose(condition, yes.z, no.z)};
}

/// What a pass is handed as its arithmetic (arithmetic.hpp) to learn what its numbers may legally be. Refers to
/// `arithmetic`.
template <class A> class LegalOperations {
  public:
    using Real = LegalNumber<A>;
    using Bool = Truth;
    using Vec2 = lockstep::Vec2<Real>;
    using Vec3 = lockstep::Vec3<Real>;
    using Vec4 = lockstep::Vec4<Real>;

    explicit LegalOperations(const LegalArithmetic<A>& arithmetic) : arithmetic_(&arithmetic) {}

    [[nodiscard]] Real read(float x) const { return {*arithmetic_, arithmetic_->read(x)}; }
    [[nodiscard]] Vec3 read(glm::vec3 v) const { return {read(v.x), read(v.y), read(v.z)}; }
    [[nodiscard]] Real divide(Real a, Real b) const {
        return {*arithmetic_, arithmetic_->divide(a.set(), b.set()), a.open() || b.open()};
    }
    [[nodiscard]] Real sqrt(Real a) const { return {*arithmetic_, arithmetic_->square_root(a.set()), a.open()}; }
    /// Part of every operation here.
    template <class T> static T flush(const T& value) { return value; }
    [[nodiscard]] static Vec3 scale(const Vec3& v, Real s) { return v * s; }
    [[nodiscard]] Vec4 transform(const glm::mat4& m, const Vec3& v) const {
        const auto clip = arithmetic_->transform(m, {v.x.set(), v.y.set(), v.z.set()});
        const bool open = v.x.open() || v.y.open() || v.z.open();
        const auto number = [&](std::size_t i) { return Real(*arithmetic_, clip[i], open); };
        return {number(0), number(1), number(2), number(3)};
    }
    /// The same numbers, in the arithmetic of another stage.
    [[nodiscard]] Vec3 taken(const Vec3& v) const { return {taken(v.x), taken(v.y), taken(v.z)}; }
    [[nodiscard]] Vec2 taken(const Vec2& v) const { return {taken(v.x), taken(v.y)}; }
    [[nodiscard]] Real taken(Real x) const { return {*arithmetic_, x.set(), x.open()}; }

  private:
    const LegalArithmetic<A>* arithmetic_;
};

} // namespace lockstep
