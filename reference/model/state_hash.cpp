#include "reference/model/state_hash.hpp"

#include <bit>
#include <cstddef>

#include <fmt/format.h>

#include "reference/model/random.hpp"

namespace lockstep {
namespace {

std::uint32_t canonical(float value) { return value != value ? 0x7fc00000U : std::bit_cast<std::uint32_t>(value); }

std::uint64_t hash_floats(std::uint64_t seed, const float* values, std::size_t count) {
    std::uint64_t sum = 0;
    const auto n = static_cast<std::ptrdiff_t>(count);
#pragma omp parallel for reduction(+ : sum) schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i)
        sum += splitmix64(seed + (static_cast<std::uint64_t>(i) << 32U | canonical(values[i])));
    return splitmix64(sum ^ count);
}

} // namespace

std::uint64_t state_hash(const Particles& particles) {
    const std::size_t n = particles.size();
    if (n == 0)
        return 0;
    return hash_floats(0x1000000000000000U, &particles.position[0].x, 3 * n) +
           hash_floats(0x2000000000000000U, &particles.direction[0].x, 3 * n) +
           hash_floats(0x3000000000000000U, particles.speed.data(), n) +
           hash_floats(0x4000000000000000U, particles.collide_time.data(), n);
}

std::uint64_t state_hash(const CollisionImage& image) {
    if (image.texels.empty())
        return 0;
    return hash_floats(0x5000000000000000U, &image.texels[0].x, 4 * image.texels.size());
}

std::uint64_t state_hash(const Particles& particles, const CollisionImage& image) {
    return splitmix64(state_hash(particles)) + state_hash(image);
}

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

} // namespace lockstep
