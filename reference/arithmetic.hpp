#pragma once
#include <cmath>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/model/root_tables.hpp"

namespace lockstep {

/// The operations GLSL leaves open, as policy types: a pass is written once, as the listing reads, and takes one of
/// these as `A`. What is measured of drivers stands in the spec, last section; every result is rounded where it is
/// written, as the build's -ffp-contract=off guarantees.

/// Sums from left to right, every operation rounded: the reference on its own terms.
struct Strict {
    static float divide(float a, float b) { return a / b; }
    static float reciprocal(float a) { return 1.0F / a; }
    static float sqrt(float a) { return std::sqrt(a); }
    static float dot(glm::vec3 a, glm::vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
    static float length(glm::vec3 v) { return std::sqrt(dot(v, v)); }
    static glm::vec3 normalize(glm::vec3 v) { return scale(v, 1.0F / std::sqrt(dot(v, v))); }

    /// What becomes of the result of each + - * that a pass makes itself: here nothing, in Portable tiny values are 0.
    static float flush(float x) { return x; }
    static glm::vec3 flush(glm::vec3 v) { return v; }

    static glm::vec3 scale(glm::vec3 v, float s) { return {v.x * s, v.y * s, v.z * s}; }
    /// matrix * vec4(v, 1), columns summed from left to right: what `precise` gives on every driver measured.
    static glm::vec4 transform(const glm::mat4& m, glm::vec3 v) {
        const auto row = [&](int r) { return ((m[0][r] * v.x + m[1][r] * v.y) + m[2][r] * v.z) + m[3][r]; };
        return {row(0), row(1), row(2), row(3)};
    }
};

/// Mesa llvmpipe: dot sums from the right.
struct RightToLeft : Strict {
    static float dot(glm::vec3 a, glm::vec3 b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }
    static float length(glm::vec3 v) { return std::sqrt(dot(v, v)); }
    static glm::vec3 normalize(glm::vec3 v) { return scale(v, 1.0F / std::sqrt(dot(v, v))); }
};

/// NVIDIA: dot is a chain of fused operations.
struct FusedChain : Strict {
    static float dot(glm::vec3 a, glm::vec3 b) { return std::fma(a.z, b.z, std::fma(a.y, b.y, a.x * b.x)); }
    static float length(glm::vec3 v) { return std::sqrt(dot(v, v)); }
    static glm::vec3 normalize(glm::vec3 v) { return scale(v, 1.0F / std::sqrt(dot(v, v))); }
};

/// NVIDIA with its own tables: a / b is a times the driver's 1 / b, the square root the driver's 1 / x of its
/// inversesqrt, and normalize multiplies by inversesqrt. `tables` is set by with_arithmetic before a pass runs.
struct DriverRoots : FusedChain {
    static inline const RootTables* tables = nullptr;

    static float reciprocal(float a) { return tables->reciprocal_of(a); }
    static float divide(float a, float b) { return a * reciprocal(b); }
    static float inverse_sqrt(float a) { return tables->inverse_sqrt_of(a); }
    static float sqrt(float a) { return reciprocal(inverse_sqrt(a)); }
    static float length(glm::vec3 v) { return sqrt(dot(v, v)); }
    static glm::vec3 normalize(glm::vec3 v) { return scale(v, inverse_sqrt(dot(v, v))); }
};

} // namespace lockstep
