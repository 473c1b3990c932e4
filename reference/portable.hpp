#pragma once
#include <cmath>
#include <limits>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace lockstep {

/// Arithmetic with the same bits everywhere, whether subnormals are flushed or not: twin of shaders/portable.glsl,
/// policy type like those of reference/arithmetic.hpp.
///
/// The shader builds division and square root from simpler operations so that they are correctly rounded; here IEEE 754
/// promises that of `/` and std::sqrt. What is left is the rule for tiny values: a magnitude of 2^-126 or less counts
/// as +0, as an operand and as a result, and no function returns -0. Every NaN is the same value, with the bits of
/// std::numeric_limits<float>::quiet_NaN() where a function makes one.
///
/// divide, reciprocal, sqrt, inverse_sqrt, multiply, dot, length, normalize, scale and transform take any bits; the
/// operands of add, and of a caller's own + - *, have been through `flush`, and so must the caller's results.
struct Portable {
    static float flush(float x) { return std::abs(x) <= std::numeric_limits<float>::min() ? 0.0F : x; }
    static glm::vec3 flush(glm::vec3 v) { return {flush(v.x), flush(v.y), flush(v.z)}; }

    static float add(float a, float b) { return flush(a + b); }
    static float multiply(float a, float b) { return flush(flush(a) * flush(b)); }

    /// 0.5 ULP. a / 0 is infinite with the sign of a; 0 / 0 and inf / inf are NaN.
    static float divide(float a, float b) { return one_nan(flush(flush(a) / flush(b))); }
    /// 0.5 ULP.
    static float reciprocal(float a) { return divide(1.0F, a); }
    /// 0.5 ULP. NaN of a negative number, +0 of -0.
    static float sqrt(float a) { return one_nan(std::sqrt(flush(a))); }
    /// Two roundings: 1.5 ULP.
    static float inverse_sqrt(float a) { return divide(1.0F, sqrt(a)); }

    /// (x + y) + z, each operation rounded.
    static float dot(glm::vec3 a, glm::vec3 b) {
        return add(add(multiply(a.x, b.x), multiply(a.y, b.y)), multiply(a.z, b.z));
    }
    /// 2 ULP for lengths from 2^-48, under which squares are lost as tiny, to 2^63.
    static float length(glm::vec3 v) { return length_of(dot(v, v)); }
    /// 4 ULP a component, for the same lengths. All NaN where the length is 0, infinite or NaN.
    static glm::vec3 normalize(glm::vec3 v) { return direction_of(v, dot(v, v)); }

    /// length and normalize of a vector whose dot product with itself is known.
    static float length_of(float squared) { return sqrt(squared); }
    static glm::vec3 direction_of(glm::vec3 v, float squared) {
        const float s = inverse_sqrt(squared);
        if (!(squared > 0.0F) || std::isinf(squared))
            return glm::vec3(std::numeric_limits<float>::quiet_NaN());
        return scale(v, s);
    }

    static glm::vec3 scale(glm::vec3 v, float s) { return {multiply(v.x, s), multiply(v.y, s), multiply(v.z, s)}; }
    /// m * vec4(v, 1): ((x + y) + z) + w, each operation rounded.
    static glm::vec4 transform(const glm::mat4& m, glm::vec3 v) {
        const auto row = [&](int r) {
            const float xy = add(multiply(m[0][r], v.x), multiply(m[1][r], v.y));
            return add(add(xy, multiply(m[2][r], v.z)), flush(m[3][r]));
        };
        return {row(0), row(1), row(2), row(3)};
    }

  private:
    static float one_nan(float x) { return std::isnan(x) ? std::numeric_limits<float>::quiet_NaN() : x; }
};

} // namespace lockstep
