#pragma once
#include <cmath>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/model/profile.hpp"
#include "reference/model/root_tables.hpp"

namespace lockstep {

/// a . b, summed and fused in that order.
inline float dot_in(DotOrder order, glm::vec3 a, glm::vec3 b) {
    const auto fused = [](float u, float v, float sum) { return std::fma(u, v, sum); };
    switch (order) {
    case DotOrder::left_to_right:
        return (a.x * b.x + a.y * b.y) + a.z * b.z;
    case DotOrder::right_to_left:
        return a.x * b.x + (a.y * b.y + a.z * b.z);
    case DotOrder::fused_chain:
        return fused(a.z, b.z, fused(a.y, b.y, a.x * b.x));
    case DotOrder::middle_last:
        return (a.x * b.x + a.z * b.z) + a.y * b.y;
    case DotOrder::fused_from_z:
        return fused(a.x, b.x, fused(a.y, b.y, a.z * b.z));
    case DotOrder::fused_y_x_z:
        return fused(a.z, b.z, fused(a.x, b.x, a.y * b.y));
    case DotOrder::fused_y_z_x:
        return fused(a.x, b.x, fused(a.z, b.z, a.y * b.y));
    case DotOrder::sum_then_fused_z:
        return fused(a.z, b.z, a.x * b.x + a.y * b.y);
    case DotOrder::sum_then_fused_x:
        return fused(a.x, b.x, a.y * b.y + a.z * b.z);
    case DotOrder::fused_then_plus_z:
        return fused(a.y, b.y, a.x * b.x) + a.z * b.z;
    case DotOrder::x_plus_fused:
        return a.x * b.x + fused(a.y, b.y, a.z * b.z);
    }
    return 0.0F;
}

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

    /// length and normalize of a vector whose dot product with itself is known.
    static float length_of(float squared) { return std::sqrt(squared); }
    static glm::vec3 direction_of(glm::vec3 v, float squared) { return scale(v, 1.0F / std::sqrt(squared)); }

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
    [[nodiscard]] float length(glm::vec3 v) const { return length_of(dot(v, v)); }
    [[nodiscard]] glm::vec3 normalize(glm::vec3 v) const { return direction_of(v, dot(v, v)); }
    [[nodiscard]] float length_of(float squared) const { return sqrt(squared); }
    [[nodiscard]] glm::vec3 direction_of(glm::vec3 v, float squared) const { return scale(v, inverse_sqrt(squared)); }

  private:
    const RootTables* tables_;
};

/// Each operation in an order of its own, as a driver was measured; `roots` null: rounded correctly. Slower than those
/// above, which have one order for all. Refers to the profile's tables.
class OwnOrders : public Strict {
  public:
    OwnOrders(DotOrder dot, DotOrder length, DotOrder normalize, const RootTables* roots)
        : dot_(dot), length_(length), normalize_(normalize), roots_(roots) {}
    explicit OwnOrders(const Profile& profile)
        : dot_(profile.dot), length_(profile.length_order()), normalize_(profile.normalize_order()),
          roots_(profile.roots.get()), normalize_divides_(profile.normalize_divides) {}

    [[nodiscard]] bool has_tables() const { return roots_ != nullptr; } ///< else division and roots are IEEE 754's
    [[nodiscard]] DotOrder dot_order() const { return dot_; }

    [[nodiscard]] float reciprocal(float a) const { return roots_ != nullptr ? roots_->reciprocal_of(a) : 1.0F / a; }
    [[nodiscard]] float divide(float a, float b) const { return roots_ != nullptr ? a * reciprocal(b) : a / b; }
    [[nodiscard]] float sqrt(float a) const { return roots_ != nullptr ? reciprocal(inverse_sqrt(a)) : std::sqrt(a); }
    [[nodiscard]] float inverse_sqrt(float a) const {
        return roots_ != nullptr ? roots_->inverse_sqrt_of(a) : 1.0F / std::sqrt(a);
    }
    [[nodiscard]] float dot(glm::vec3 a, glm::vec3 b) const { return dot_in(dot_, a, b); }
    [[nodiscard]] float length(glm::vec3 v) const { return length_of(dot_in(length_, v, v)); }
    [[nodiscard]] glm::vec3 normalize(glm::vec3 v) const { return direction_of(v, dot_in(normalize_, v, v)); }
    [[nodiscard]] float length_of(float squared) const { return sqrt(squared); }
    [[nodiscard]] glm::vec3 direction_of(glm::vec3 v, float squared) const {
        if (!normalize_divides_)
            return scale(v, inverse_sqrt(squared));
        const float length = sqrt(squared);
        return {divide(v.x, length), divide(v.y, length), divide(v.z, length)};
    }

  private:
    DotOrder dot_, length_, normalize_;
    const RootTables* roots_;
    bool normalize_divides_ = false;
};

} // namespace lockstep
