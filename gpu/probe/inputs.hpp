#pragma once
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include "gpu/probe/judge.hpp"

namespace lockstep::probing {

using Vectors = std::vector<glm::vec3>;

/// Random floats: magnitudes from 2^low to 2^high, evenly spread over their exponents, all 23 bits random; the same
/// for the same seed.
struct Range {
    int low = -4;
    int high = 4;
    bool negative = true; ///< half of them
};

Floats random_floats(std::size_t count, std::uint64_t seed, Range range);
Vectors random_vectors(std::size_t count, std::uint64_t seed, Range range);

/// The components one after the other.
Floats flat(const Vectors& vectors);

} // namespace lockstep::probing
