#pragma once
#include <cstdint>

namespace lockstep {

/// One step of splitmix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014): adds the
/// golden gamma and finalises. Integers only, so the same on every platform.
constexpr std::uint64_t splitmix64(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
}

/// The random numbers of one particle: splitmix64 from a state that the seed and the particle's index give, so that
/// no particle's numbers depend on another's, nor on the order in which they are made.
class Random {
  public:
    constexpr Random(std::uint64_t seed, std::uint64_t index) : state_(splitmix64(splitmix64(seed) ^ index)) {}

    constexpr std::uint64_t next() {
        const std::uint64_t value = splitmix64(state_);
        state_ += 0x9e3779b97f4a7c15U;
        return value;
    }

    /// In [0, 1): the top 24 bits times 2^-24, so exact in a float too.
    constexpr double unit() { return static_cast<double>(next() >> 40U) * 0x1p-24; }

    /// In [-1, 1).
    constexpr double symmetric() { return 2.0 * unit() - 1.0; }

  private:
    std::uint64_t state_;
};

} // namespace lockstep
