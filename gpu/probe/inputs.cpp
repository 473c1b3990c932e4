#include "gpu/probe/inputs.hpp"

#include <bit>

#include "reference/model/random.hpp"

namespace lockstep::probing {
namespace {

float random_float(Random& random, Range range) {
    const std::uint64_t bits = random.next();
    const auto exponent = static_cast<std::uint32_t>(
        range.low + static_cast<int>((bits >> 32U) % static_cast<std::uint32_t>(range.high - range.low)) + 127);
    const auto sign = range.negative ? static_cast<std::uint32_t>(bits >> 31U) & 1U : 0U;
    return std::bit_cast<float>(sign << 31U | exponent << 23U | (static_cast<std::uint32_t>(bits) & 0x7fffffU));
}

} // namespace

Floats random_floats(std::size_t count, std::uint64_t seed, Range range) {
    Random random(seed, 0);
    Floats values(count);
    for (float& value : values)
        value = random_float(random, range);
    return values;
}

Vectors random_vectors(std::size_t count, std::uint64_t seed, Range range) {
    Random random(seed, 1);
    Vectors values(count);
    for (glm::vec3& v : values)
        for (int i = 0; i < 3; ++i)
            v[i] = random_float(random, range);
    return values;
}

Floats flat(const Vectors& vectors) {
    Floats values;
    values.reserve(vectors.size() * 3);
    for (const glm::vec3& v : vectors)
        values.insert(values.end(), {v.x, v.y, v.z});
    return values;
}

} // namespace lockstep::probing
