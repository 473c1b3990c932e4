#pragma once
#include <cmath>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/model/root_tables.hpp"

namespace lockstep {

/// The operations GLSL leaves open, as values: a pass is written once, as the listing reads, and is handed one of
/// these, `A fp`, whose operations may read what was measured of a driver. What is measured of drivers stands in the
/// spec, last section; every result is rounded where it is written, as the build's -ffp-contract=off guarantees.

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
/// inversesqrt, and normalize multiplies by inversesqrt. Refers to the tables.
class DriverRoots : public FusedChain {
  public:
    explicit DriverRoots(const RootTables& tables) : tables_(&tables) {}

    [[nodiscard]] float reciprocal(float a) const { return tables_->reciprocal_of(a); }
    [[nodiscard]] float divide(float a, float b) const { return a * reciprocal(b); }
    [[nodiscard]] float inverse_sqrt(float a) const { return tables_->inverse_sqrt_of(a); }
    [[nodiscard]] float sqrt(float a) const { return reciprocal(inverse_sqrt(a)); }
    [[nodiscard]] float length(glm::vec3 v) const { return sqrt(dot(v, v)); }
    [[nodiscard]] glm::vec3 normalize(glm::vec3 v) const { return scale(v, inverse_sqrt(dot(v, v))); }

  private:
    const RootTables* tables_;
};

} // namespace lockstep
