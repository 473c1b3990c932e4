#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "reference/arithmetic.hpp"
#include "reference/portable.hpp"
#include "reference/readings/number.hpp"
#include "reference/readings/site.hpp"
#include "reference/readings/values.hpp"
#include "reference/readings/vector.hpp"

namespace lockstep {

// Functions that take or return bare vectors are compiled into their callers: how these are handed over depends on what
// the caller is compiled for (vector_loops.hpp).
#define LOCKSTEP_INLINE [[gnu::always_inline]] inline
#pragma GCC diagnostic ignored "-Wpsabi"

/// Numbers of as many items as go through a twin together. A lane rounds like a scalar.
inline constexpr int lane_count = 8;
inline constexpr unsigned every_lane = (1U << lane_count) - 1; ///< a bit a lane
using FloatLanes [[gnu::vector_size(4 * lane_count)]] = float;
using IntLanes [[gnu::vector_size(4 * lane_count)]] = std::int32_t;

namespace lanes {

// Loops over arrays: GCC makes one instruction of such a loop, for whatever its caller is compiled. Shuffles and lists
// it splits before, for what this is compiled for by itself.
LOCKSTEP_INLINE FloatLanes all(float x) {
    std::array<float, lane_count> each;
    for (float& one : each)
        one = x;
    return std::bit_cast<FloatLanes>(each);
}
LOCKSTEP_INLINE IntLanes all(int i) {
    std::array<int, lane_count> each;
    for (int& one : each)
        one = i;
    return std::bit_cast<IntLanes>(each);
}
LOCKSTEP_INLINE IntLanes bits(const FloatLanes& v) { return std::bit_cast<IntLanes>(v); }
LOCKSTEP_INLINE FloatLanes floats(const IntLanes& v) { return std::bit_cast<FloatLanes>(v); }

/// As many numbers as there are lanes.
template <class Vector, class Number> LOCKSTEP_INLINE Vector loaded(const Number* from) {
    Vector v{};
    std::memcpy(&v, from, sizeof v);
    return v;
}

#if defined(__SSE2__)
// Shuffled, not copied: what is stored in halves and loaded whole has to wait.
LOCKSTEP_INLINE __m128 low_half(const FloatLanes& v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); }
LOCKSTEP_INLINE __m128 high_half(const FloatLanes& v) { return __builtin_shufflevector(v, v, 4, 5, 6, 7); }
#endif

/// One bit a lane of a mask, whose lanes are 0 or -1.
LOCKSTEP_INLINE unsigned set_of(const IntLanes& mask) {
#if defined(__SSE2__)
    const auto v = std::bit_cast<FloatLanes>(mask);
    return static_cast<unsigned>(_mm_movemask_ps(low_half(v))) | static_cast<unsigned>(_mm_movemask_ps(high_half(v)))
                                                                     << 4;
#else
    unsigned set = 0;
    for (int lane = 0; lane < lane_count; ++lane)
        set |= static_cast<unsigned>(mask[lane] & 1) << lane;
    return set;
#endif
}

LOCKSTEP_INLINE FloatLanes sqrt(const FloatLanes& v) {
    auto roots = std::bit_cast<std::array<float, lane_count>>(v);
    for (float& root : roots)
        root = std::sqrt(root);
    return std::bit_cast<FloatLanes>(roots);
}
LOCKSTEP_INLINE FloatLanes floor(const FloatLanes& v) {
    const IntLanes magnitude = bits(v) & 0x7fffffff, sign = bits(v) & std::numeric_limits<std::int32_t>::min();
    const IntLanes is_whole = magnitude >= std::bit_cast<std::int32_t>(0x1p23F); // or no number
    const FloatLanes inside = is_whole ? all(0.0F) : v;
    const FloatLanes cut = __builtin_convertvector(__builtin_convertvector(inside, IntLanes), FloatLanes);
    const FloatLanes down = cut > inside ? cut - 1.0F : cut;
    return is_whole ? v : floats(bits(down) | sign);
}
LOCKSTEP_INLINE FloatLanes abs(const FloatLanes& v) { return floats(bits(v) & 0x7fffffff); }

template <class Function> LOCKSTEP_INLINE FloatLanes each(const FloatLanes& v, const Function& f) {
    FloatLanes made = v;
    for (int lane = 0; lane < lane_count; ++lane)
        made[lane] = f(v[lane]);
    return made;
}

/// Vector i takes lane i of each.
LOCKSTEP_INLINE void transpose(std::array<FloatLanes, lane_count>& rows) {
    static_assert(lane_count == 8);
    // Blocks of four, two and one lane beside the diagonal change places.
    for (const std::size_t i : {0U, 1U, 2U, 3U}) {
        const FloatLanes a = rows[i], b = rows[i + 4];
        rows[i] = __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
        rows[i + 4] = __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
    }
    for (const std::size_t i : {0U, 1U, 4U, 5U}) {
        const FloatLanes a = rows[i], b = rows[i + 2];
        rows[i] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
        rows[i + 2] = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
    }
    for (const std::size_t i : {0U, 2U, 4U, 6U}) {
        const FloatLanes a = rows[i], b = rows[i + 1];
        rows[i] = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
        rows[i + 1] = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    }
}

} // namespace lanes

/// The plain arithmetic of a driver without tables of roots: Strict, but for the order of sums.
struct PlainLanes {
    using Three = Vec3<FloatLanes>;
    DotOrder dot_order, length_order, normalize_order;

    LOCKSTEP_INLINE static FloatLanes flush(const FloatLanes& v) { return v; }
    LOCKSTEP_INLINE static FloatLanes divide(const FloatLanes& a, const FloatLanes& b) { return a / b; }
    LOCKSTEP_INLINE static FloatLanes sqrt(const FloatLanes& a) { return lanes::sqrt(a); }
    [[nodiscard]] LOCKSTEP_INLINE FloatLanes dot(const Three& a, const Three& b) const { return sum(dot_order, a, b); }
    [[nodiscard]] LOCKSTEP_INLINE FloatLanes length(const Three& v) const { return sqrt(sum(length_order, v, v)); }
    [[nodiscard]] LOCKSTEP_INLINE FloatLanes scaled(const FloatLanes& part, const Three& v) const {
        return part * (1.0F / sqrt(sum(normalize_order, v, v)));
    }

    LOCKSTEP_INLINE static FloatLanes sum(DotOrder order, const Three& a, const Three& b) {
        if (order == DotOrder::left_to_right)
            return (a.x * b.x + a.y * b.y) + a.z * b.z;
        if (order == DotOrder::right_to_left)
            return a.x * b.x + (a.y * b.y + a.z * b.z);
        FloatLanes made = a.x;
        for (int k = 0; k < lane_count; ++k)
            made[k] = dot_in(order, {a.x[k], a.y[k], a.z[k]}, {b.x[k], b.y[k], b.z[k]});
        return made;
    }
};

/// Portable, on lanes.
struct PortableLanes {
    using Three = Vec3<FloatLanes>;

    LOCKSTEP_INLINE static FloatLanes flush(const FloatLanes& v) {
        return lanes::floats(lanes::bits(v) & ((lanes::bits(v) & 0x7fffffff) > tiny));
    }
    LOCKSTEP_INLINE static FloatLanes divide(const FloatLanes& a, const FloatLanes& b) {
        return one_nan(flush(flush(a) / flush(b)));
    }
    LOCKSTEP_INLINE static FloatLanes sqrt(const FloatLanes& a) { return one_nan(lanes::sqrt(flush(a))); }
    LOCKSTEP_INLINE static FloatLanes dot(const Three& a, const Three& b) {
        return flush(flush(flush(a.x * b.x) + flush(a.y * b.y)) + flush(a.z * b.z));
    }
    LOCKSTEP_INLINE static FloatLanes length(const Three& v) { return sqrt(dot(v, v)); }
    LOCKSTEP_INLINE static FloatLanes scaled(const FloatLanes& part, const Three& v) {
        const FloatLanes squared = dot(v, v), scale = divide(lanes::all(1.0F), sqrt(squared));
        const IntLanes has_direction = (squared > 0.0F) & (squared < std::numeric_limits<float>::infinity());
        return has_direction ? flush(part * scale) : lanes::all(std::numeric_limits<float>::quiet_NaN());
    }

  private:
    static constexpr std::int32_t tiny = std::bit_cast<std::int32_t>(std::numeric_limits<float>::min());
    LOCKSTEP_INLINE static FloatLanes one_nan(const FloatLanes& v) {
        return v != v ? lanes::all(std::numeric_limits<float>::quiet_NaN()) : v;
    }
};

/// Lanes that are handed over by reference, whatever a caller is compiled for.
template <class Vector> struct HeldLanes {
    Vector v{};
    HeldLanes() = default;
    HeldLanes(const Vector& lanes_) : v(lanes_) {}  // NOLINT: lanes are themselves
    HeldLanes(const HeldLanes& from) : v(from.v) {} // NOLINT: not trivial
    HeldLanes& operator=(const HeldLanes& from) = default;
    ~HeldLanes() = default;
};

/// What a comparison gives: of each lane 0 or -1.
struct LaneMask : HeldLanes<IntLanes> {
    using HeldLanes::HeldLanes;
    friend LaneMask operator&&(const LaneMask& a, const LaneMask& b) { return {a.v & b.v}; }
    friend LaneMask operator||(const LaneMask& a, const LaneMask& b) { return {a.v | b.v}; }
    friend LaneMask operator&&(bool a, const LaneMask& b) { return {a ? b.v : lanes::all(0)}; }
    friend LaneMask operator&&(const LaneMask& a, bool b) { return b && a; }
    friend LaneMask operator||(bool a, const LaneMask& b) { return {a ? lanes::all(-1) : b.v}; }
    friend LaneMask operator!(const LaneMask& a) { return {~a.v}; }
};

inline bool everywhere(const LaneMask& decision) { return lanes::set_of(decision.v) == every_lane; }
inline bool nowhere(const LaneMask& decision) { return lanes::set_of(decision.v) == 0; }
template <class Number> Number choose(const LaneMask& decision, const Number& yes, const Number& no) {
    return Number(decision.v ? yes.v : no.v);
}
template <class T> Vec3<T> choose(const LaneMask& decision, const Vec3<T>& yes, const Vec3<T>& no) {
    return {choose(decision, yes.x, no.x), choose(decision, yes.y, no.y), choose(decision, yes.z, no.z)};
}

/// A number a lane. The operands of a product have been flushed, as all results are.
template <class F> struct LaneReal : HeldLanes<FloatLanes> {
    using HeldLanes::HeldLanes;
    LaneReal(float x) : HeldLanes(lanes::all(x)) {} // NOLINT: a float is one, as it stands
    friend LaneReal operator+(const LaneReal& a, const LaneReal& b) { return F::flush(a.v + b.v); }
    friend LaneReal operator-(const LaneReal& a, const LaneReal& b) { return F::flush(a.v - b.v); }
    friend LaneReal operator*(const LaneReal& a, const LaneReal& b) { return F::flush(a.v * b.v); }
    friend LaneReal operator-(const LaneReal& a) { return F::flush(-a.v); }
    friend LaneMask operator<(const LaneReal& a, const LaneReal& b) { return {a.v < b.v}; }
    friend LaneMask operator>(const LaneReal& a, const LaneReal& b) { return {a.v > b.v}; }
    friend LaneMask operator<=(const LaneReal& a, const LaneReal& b) { return {a.v <= b.v}; }
    friend LaneMask operator>=(const LaneReal& a, const LaneReal& b) { return {a.v >= b.v}; }
    friend LaneMask operator==(const LaneReal& a, const LaneReal& b) { return {a.v == b.v}; }
    friend LaneMask operator!=(const LaneReal& a, const LaneReal& b) { return {a.v != b.v}; }
};

/// An integer a lane.
struct LaneInt : HeldLanes<IntLanes> {
    using HeldLanes::HeldLanes;
    LaneInt(int i) : HeldLanes(lanes::all(i)) {} // NOLINT: an int is one
    friend LaneInt operator+(const LaneInt& a, const LaneInt& b) { return {a.v + b.v}; }
    friend LaneInt operator-(const LaneInt& a, const LaneInt& b) { return {a.v - b.v}; }
    friend LaneInt operator*(const LaneInt& a, const LaneInt& b) { return {a.v * b.v}; }
    friend LaneMask operator==(const LaneInt& a, const LaneInt& b) { return {a.v == b.v}; }
    [[nodiscard]] LaneInt clamped(int low, int high) const {
        const IntLanes least = v < low ? lanes::all(low) : v;
        return {least > high ? lanes::all(high) : least};
    }
};

/// A twin read for as many items at once as there are lanes (values.hpp says what a twin is), with the bits that Values
/// gives: F is PlainLanes or PortableLanes. At a decision the run goes the first active lane's way, and those that
/// would go the other drop out: they are to be run again (lane_items.hpp). What is chosen by choose() (decided.hpp)
/// drops nobody.
template <class F> class Lanes {
  public:
    using Real = LaneReal<F>;
    using Mask = LaneMask;
    using Index = LaneInt;
    using Vec2 = lockstep::Vec2<Real>;
    using Vec3 = lockstep::Vec3<Real>;
    using Vec4 = lockstep::Vec4<Real>;
    using IVec2 = lockstep::Vec2<int>;

    /// An integer of numbers: one for all where it is used as an int.
    class Int {
      public:
        Int(Lanes& of, const IntLanes& lanes_) : v(lanes_), of_(&of) {}
        explicit operator int() const { return of_->same(v); }
        IntLanes v;

      private:
        Lanes* of_;
    };

    /// `active`: a bit a lane, not 0.
    Lanes(F arithmetic, unsigned active) : fp_(arithmetic), active_(active) {}
    [[nodiscard]] unsigned active() const { return active_; }
    [[nodiscard]] const F& arithmetic() const { return fp_; }

    Real read(At, float x) const { return fp_.flush(lanes::all(x)); }
    Real read(At, const FloatLanes& v) const { return fp_.flush(v); }
    Vec3 read(At at, glm::vec3 v) const { return {read(at, v.x), read(at, v.y), read(at, v.z)}; }
    /// A tiny one would need products that flush it: nobody is active then.
    Real uniform(At, float x) {
        if (std::is_same_v<F, PortableLanes> && x != 0.0F && Portable::flush(x) == 0.0F)
            active_ = 0;
        return x;
    }
    Vec3 uniform(At at, glm::vec3 v) { return {uniform(at, v.x), uniform(at, v.y), uniform(at, v.z)}; }
    static int uniform(At, int i) { return i; }
    static IVec2 uniform(At, glm::ivec2 v) { return {v.x, v.y}; }
    static const glm::mat4& uniform(At, const glm::mat4& m) { return m; }
    static bool setting(At, bool on) { return on; }

    template <class T> static T note(At, const T& value) { return value; }
    static bool decide(At, bool condition) { return condition; }
    bool decide(At, const Mask& condition) { return follow_first(lanes::set_of(condition.v)); }
    static IntRange<int> range(At, int first, int last) { return {first, last}; }

    static Real real(int i) { return static_cast<float>(i); }
    static Real real(const Index& i) { return __builtin_convertvector(i.v, FloatLanes); }
    Int to_int(At, const Real& x) { return {*this, __builtin_convertvector(x.v, IntLanes)}; }
    Real divide(At, const Real& a, const Real& b) const { return fp_.divide(a.v, b.v); }
    Real sqrt(At, const Real& a) const { return fp_.sqrt(a.v); }
    static Real min(const Real& a, const Real& b) { return b.v < a.v ? b.v : a.v; }
    static Real max(const Real& a, const Real& b) { return a.v < b.v ? b.v : a.v; }
    static Real abs(const Real& a) { return lanes::abs(a.v); }
    static Real floor(const Real& a) { return lanes::floor(a.v); }
    template <class Function> static Real monotone(const Real& a, const Function& f) { return lanes::each(a.v, f); }
    Real dot(At, const Vec3& a, const Vec3& b) const { return fp_.dot(three(a), three(b)); }
    Real length(At, const Vec3& v) const { return fp_.length(three(v)); }
    Vec3 normalize(At, const Vec3& v) const {
        const auto all = three(v);
        return {fp_.scaled(v.x.v, all), fp_.scaled(v.y.v, all), fp_.scaled(v.z.v, all)};
    }
    Vec4 transform(At, const glm::mat4& m, const Vec3& v) const {
        const auto of = [&](int column, int r) { return Real(fp_.flush(lanes::all(m[column][r]))); };
        const auto row = [&](int r) { return ((of(0, r) * v.x + of(1, r) * v.y) + of(2, r) * v.z) + of(3, r); };
        return {row(0), row(1), row(2), row(3)};
    }

    template <class Payload> class Least {
      public:
        Least(Lanes& of, At, float first) : of_(of), least_(first) {}
        void offer(At place, const Mask& condition, const Real& key, const Payload& payload) {
            if (!of_.decide(place, condition && key < least_))
                return;
            least_ = key;
            found_ = payload;
        }
        [[nodiscard]] const std::optional<Payload>& take() const { return found_; }

      private:
        Lanes& of_;
        Real least_;
        std::optional<Payload> found_;
    };

  private:
    static lockstep::Vec3<FloatLanes> three(const Vec3& v) { return {v.x.v, v.y.v, v.z.v}; }
    /// The first active lane's way; who would go the other drops out.
    bool follow_first(unsigned yes) {
        const bool way = (yes & active_ & (~active_ + 1)) != 0;
        active_ &= way ? yes : ~yes;
        return way;
    }
    /// The first active lane's number; who has another drops out.
    int same(const IntLanes& v) {
        const int first = v[std::countr_zero(active_ | 1U << (lane_count - 1))];
        active_ &= lanes::set_of(v == first);
        return first;
    }

    F fp_;
    unsigned active_;
};

} // namespace lockstep
