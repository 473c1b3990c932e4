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

/// function(x) of each.
template <class Function> Floats each(const Floats& x, Function function) {
    Floats values(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        values[i] = function(x[i]);
    return values;
}

template <class Function> Floats each(const Floats& x, const Floats& y, Function function) {
    Floats values(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        values[i] = function(x[i], y[i]);
    return values;
}

/// Each vector times its own factor, or what else is done to a component with it.
template <class Function> Floats each(const Vectors& v, const Floats& s, Function function) {
    Floats values;
    values.reserve(v.size() * 3);
    for (std::size_t i = 0; i < v.size(); ++i)
        for (int c = 0; c < 3; ++c)
            values.push_back(function(v[i][c], s[i]));
    return values;
}

} // namespace lockstep::probing
