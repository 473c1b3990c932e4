#pragma once
#include <glm/mat4x4.hpp>

#include "gpu/probe/inputs.hpp"
#include "gpu/probe/vertex_stage.hpp"

namespace lockstep::probing {

/// GLSL's operations as the driver computes them in the vertex stage (shaders/probe/arithmetic.vert), as functions on
/// arrays. What one returns may go into the next, so that a sequence can be followed with the driver's own parts.
class DriverArithmetic {
  public:
    /// `precise`: with the qualifier on every result.
    explicit DriverArithmetic(bool precise);

    [[nodiscard]] Floats dot(const Vectors& a, const Vectors& b) const;
    [[nodiscard]] Floats cross(const Vectors& a, const Vectors& b) const;               ///< three floats each
    [[nodiscard]] Floats multiply_add(const Vectors& v) const;                          ///< x * y + z
    [[nodiscard]] Floats fma(const Vectors& v) const;                                   ///< fma(x, y, z)
    [[nodiscard]] Floats common_factor(const Vectors& v) const;                         ///< x * y + x * z
    [[nodiscard]] Floats squares(const Vectors& v) const;                               ///< x * x + y * y + z * z
    [[nodiscard]] Floats transform(const glm::mat4& m, const Vectors& v) const;         ///< m * vec4(v, 1)
    [[nodiscard]] Floats transform_written(const glm::mat4& m, const Vectors& v) const; ///< the same, written out
    [[nodiscard]] Floats divide(const Floats& a, const Floats& b) const;
    [[nodiscard]] Floats by_constants(const Floats& a) const; ///< fours by probing::constant_divisors
    [[nodiscard]] Floats reciprocal(const Floats& x) const;
    [[nodiscard]] Floats sqrt(const Floats& x) const;
    [[nodiscard]] Floats inverse_sqrt(const Floats& x) const;
    [[nodiscard]] Floats length(const Vectors& v) const;
    [[nodiscard]] Floats normalize(const Vectors& v) const;      ///< three floats each
    [[nodiscard]] Floats transcendental(const Vectors& v) const; ///< sin(x), exp2(y), pow(z, 2.2)
    [[nodiscard]] Floats copy(const Floats& x) const;
    [[nodiscard]] Floats positive(const Floats& x) const; ///< x > 0 ? 1 : 0

  private:
    [[nodiscard]] Floats of_vectors(std::string_view attribute, const Vectors& v, std::string_view output) const;
    [[nodiscard]] Floats root(int component, const Floats& x, std::string_view output) const;

    VertexStage stage_;
};

} // namespace lockstep::probing
