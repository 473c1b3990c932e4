#pragma once
#include <span>
#include <string_view>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "gpu/probe/inputs.hpp"

namespace lockstep::probing {

/// Ways to compute a sum of products in float, each named as it is written; x, y, z, w stand for the products.
struct DotSequence {
    std::string_view name;
    float (*value)(glm::vec3 a, glm::vec3 b);
};
struct RowSequence {
    std::string_view name;
    float (*value)(glm::vec4 row, glm::vec3 v); ///< row times (v, 1)
};
struct TripleSequence {
    std::string_view name;
    float (*value)(float x, float y, float z);
};

std::span<const DotSequence> dot_sequences();
std::span<const RowSequence> row_sequences();
std::span<const TripleSequence> multiply_add_sequences();  ///< x * y + z
std::span<const TripleSequence> common_factor_sequences(); ///< x * y + x * z
std::span<const TripleSequence> fma_sequences();           ///< the same as multiply_add's, by their roundings

/// One row per sequence.
std::vector<Prediction<float>> predict(std::span<const DotSequence> sequences, const Vectors& a, const Vectors& b);
std::vector<Prediction<float>> predict(std::span<const TripleSequence> sequences, const Vectors& v);

} // namespace lockstep::probing
