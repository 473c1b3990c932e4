#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "reference/model/image.hpp"
#include "reference/model/particles.hpp"

namespace lockstep {

/// 64-bit hash of the bits of a state: equal states have equal hashes whatever the thread count, the platform or the
/// optimisation. Every NaN counts as the one quiet NaN 0x7fc00000; -0 and +0 differ.
///
/// Word i (32 bits) adds mix(seed + (i << 32 | word)) modulo 2^64, mix being splitmix64's finaliser. The words are
/// position x, y, z of every particle, then direction, speed, collide time, each field under a seed of its own.
std::uint64_t state_hash(const Particles& particles);

/// The same over the stored codes of a CDT, row by row.
std::uint64_t state_hash(const CollisionImage& image);

/// One hash of a frame: particles and CDT.
std::uint64_t state_hash(const Particles& particles, const CollisionImage& image);

/// 16 hex digits.
std::string hash_text(std::uint64_t hash);

} // namespace lockstep
