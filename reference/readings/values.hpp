#pragma once
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/model/image.hpp"
#include "reference/readings/exact_floats.hpp"
#include "reference/readings/number.hpp"
#include "reference/readings/site.hpp"
#include "reference/readings/vector.hpp"

namespace lockstep {

/// The integers from first to last, both included; none where first > last.
template <class Int> struct IntRange {
    int first, last, step = 1;
    struct Iterator {
        int i, step;
        Int operator*() const { return i; }
        Iterator& operator++() { return i += step, *this; }
        bool operator!=(const Iterator& end) const { return i != end.i; }
    };
    [[nodiscard]] Iterator begin() const { return {first, step}; }
    [[nodiscard]] Iterator end() const { return {step * (last - first) >= 0 ? last + step : first, step}; }
};

/// A twin is a pass's step written once, over a *reading*: a template over `R& r` that computes with `R::Real`,
/// `R::Int` and the vectors of them, says what it does in the words below, and returns a struct with `fields()`. What
/// comes of it is up to the reading. This one computes, with the arithmetic handed in, and does nothing else.
///
/// Steps and conditions are pure: a reading may run them any number of times, and both sides of `&&` are evaluated.
template <class A> class Values {
  public:
    using Real = NumberOf<A>;
    using Int = int;
    using Vec2 = lockstep::Vec2<Real>;
    using Vec3 = lockstep::Vec3<Real>;
    using Vec4 = lockstep::Vec4<Real>;
    using IVec2 = lockstep::Vec2<int>;

    explicit Values(A arithmetic) : fp_(arithmetic) {}

    /// An attribute or a texel: read as the arithmetic reads.
    Real read(At, float x) const { return fp_.flush(x); }
    Vec3 read(At, glm::vec3 v) const { return vector(fp_.flush(v)); }
    /// A uniform or a constant of the program: as it stands.
    static Real uniform(At, float x) { return x; }
    static Vec3 uniform(At, glm::vec3 v) { return vector(v); }
    static int uniform(At, int i) { return i; }
    static IVec2 uniform(At, glm::ivec2 v) { return {v.x, v.y}; }
    static const glm::mat4& uniform(At, const glm::mat4& m) { return m; }
    /// A choice of the scene, not of the data.
    static bool setting(At, bool on) { return on; }

    /// Every value with a name: what is told, judged or spoiled.
    template <class T> static T note(At, T value) { return value; }
    /// Every `if` on data.
    static bool decide(At, bool condition) { return condition; }
    /// A loop's bounds, both included.
    static IntRange<int> range(At, int first, int last) { return {first, last}; }
    /// A texel of the image, which the shader takes to be of this size; null outside.
    template <class Texel>
    static const Texel* fetch(At, const Image<Texel>& image, const IVec2& size, const IVec2& at) {
        const bool inside = at.x >= 0 && at.y >= 0 && at.x < size.x && at.y < size.y;
        return inside ? &image.at(at.x, at.y) : nullptr;
    }

    static Real real(int i) { return static_cast<float>(i); }
    static Real real(std::uint32_t i) { return static_cast<float>(i); }
    /// Towards zero. The value fits.
    static int to_int(At, Real x) { return static_cast<int>(static_cast<float>(x)); }
    Real divide(At, Real a, Real b) const { return fp_.divide(static_cast<float>(a), static_cast<float>(b)); }
    Real sqrt(At, Real a) const { return fp_.sqrt(static_cast<float>(a)); }
    // Exact, as GLSL writes them; of NaN GL leaves them open.
    static Real min(Real a, Real b) { return b < a ? b : a; }
    static Real max(Real a, Real b) { return a < b ? b : a; }
    static Real abs(Real a) { return std::abs(static_cast<float>(a)); }
    /// A function that never falls where its argument rises: rounding to a storage format.
    template <class Function> static Real monotone(Real a, const Function& f) { return f(static_cast<float>(a)); }
    /// What GLSL gives no precision to, sin and its like: the reference's own value, and what it may legally be, lowest
    /// to highest.
    static Real unspecified(At, Real value, float /*lowest*/, float /*highest*/) { return value; }
    static Real floor(Real a) { return std::floor(static_cast<float>(a)); }
    /// Terms added to 0 one after another in an order that nothing fixes: the reference takes theirs (any_order.hpp).
    static Real any_order_sum(At, std::span<const Real> terms) {
        Real sum(0.0F);
        for (const Real& term : terms)
            sum = sum + term;
        return sum;
    }
    Real dot(At, const Vec3& a, const Vec3& b) const { return fp_.dot(floats(a), floats(b)); }
    Real length(At, const Vec3& v) const { return fp_.length(floats(v)); }
    Vec3 normalize(At, const Vec3& v) const { return vector(fp_.normalize(floats(v))); }
    /// m * vec4(v, 1)
    Vec4 transform(At, const glm::mat4& m, const Vec3& v) const {
        const glm::vec4 t = fp_.transform(m, floats(v));
        return {t.x, t.y, t.z, t.w};
    }

    /// The first of the least of what is offered on a condition; see least() below.
    template <class Payload> class Least {
      public:
        Least(const Values&, At, float first) : least_(first) {}
        void offer(At, bool condition, Real key, const Payload& payload) { offered(condition, key, payload); }
        [[nodiscard]] const std::optional<Payload>& take() const { return found_; }

      protected:
        /// Whether it is the best so far.
        bool offered(bool condition, Real key, const Payload& payload) {
            if (!(condition && key < least_))
                return false;
            least_ = key;
            found_ = payload;
            return true;
        }

      private:
        Real least_;
        std::optional<Payload> found_;
    };

  protected:
    static Vec3 vector(glm::vec3 v) { return {v.x, v.y, v.z}; }
    A fp_;
};

/// A choice among many: of what is offered where its condition holds, that with the least key below `first`, and of
/// equals the first offered. One choice, however many are as good as equal.
template <class Payload, class R> auto least(R& r, At place, float first) {
    return typename R::template Least<Payload>(r, place, first);
}

} // namespace lockstep
