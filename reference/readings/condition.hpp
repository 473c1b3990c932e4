#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace lockstep {

enum class CompareOp : std::uint8_t { less, less_equal, equal, always, never };

/// A comparison that has not been answered: its operands, so that a reading can ask it of sets, or ask it wrongly.
template <class Real> struct OpenComparison {
    using Op = CompareOp;
    Real a{}, b{};
    Op op = Op::never;
    bool negated = false;

    static OpenComparison known(bool answer) { return {.op = answer ? Op::always : Op::never}; }
    OpenComparison operator!() const { return {a, b, op, !negated}; }
};

/// OpenComparisons that must all hold, or any of them. The two do not mix; ask twice.
template <class Real, bool all, std::size_t count> struct OpenComparisons {
    std::array<OpenComparison<Real>, count> part;

    auto begin() const { return part.begin(); }
    auto end() const { return part.end(); }
    OpenComparisons<Real, !all, count> operator!() const {
        OpenComparisons<Real, !all, count> opposite;
        for (std::size_t i = 0; i < count; ++i)
            opposite.part[i] = !part[i];
        return opposite;
    }
};

template <bool all, class Real, std::size_t n, std::size_t m> OpenComparisons<Real, all, n + m>
joined(const std::array<OpenComparison<Real>, n>& a, const std::array<OpenComparison<Real>, m>& b) {
    OpenComparisons<Real, all, n + m> both;
    std::copy(b.begin(), b.end(), std::copy(a.begin(), a.end(), both.part.begin()));
    return both;
}
template <class Real> auto operator&&(const OpenComparison<Real>& a, const OpenComparison<Real>& b) {
    return joined<true>(std::array{a}, std::array{b});
}
template <class Real, std::size_t n>
auto operator&&(const OpenComparisons<Real, true, n>& a, const OpenComparison<Real>& b) {
    return joined<true>(a.part, std::array{b});
}
template <class Real, std::size_t n, std::size_t m>
auto operator&&(const OpenComparisons<Real, true, n>& a, const OpenComparisons<Real, true, m>& b) {
    return joined<true>(a.part, b.part);
}
template <class Real> auto operator||(const OpenComparison<Real>& a, const OpenComparison<Real>& b) {
    return joined<false>(std::array{a}, std::array{b});
}
template <class Real, std::size_t n>
auto operator||(const OpenComparisons<Real, false, n>& a, const OpenComparison<Real>& b) {
    return joined<false>(a.part, std::array{b});
}
/// Beside a setting, a comparison stays one.
template <class Real> OpenComparison<Real> operator&&(bool a, const OpenComparison<Real>& b) {
    return a ? b : OpenComparison<Real>::known(false);
}
template <class Real> OpenComparison<Real> operator||(bool a, const OpenComparison<Real>& b) {
    return a ? OpenComparison<Real>::known(true) : b;
}

/// The comparisons of a number type, as hidden friends of a class that derives from this.
template <class Real> struct Compared {
    using Op = CompareOp;
    friend OpenComparison<Real> operator<(const Real& a, const Real& b) { return {a, b, Op::less}; }
    friend OpenComparison<Real> operator>(const Real& a, const Real& b) { return {b, a, Op::less}; }
    friend OpenComparison<Real> operator<=(const Real& a, const Real& b) { return {a, b, Op::less_equal}; }
    friend OpenComparison<Real> operator>=(const Real& a, const Real& b) { return {b, a, Op::less_equal}; }
    friend OpenComparison<Real> operator==(const Real& a, const Real& b) { return {a, b, Op::equal}; }
    friend OpenComparison<Real> operator!=(const Real& a, const Real& b) { return {a, b, Op::equal, true}; }
};

} // namespace lockstep
