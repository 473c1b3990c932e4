#pragma once
#include <cstdint>
#include <string>

#include "reference/model/state_view.hpp"

namespace lockstep {

/// 64-bit hash of the bits of a buffer or image: equal ones have equal hashes whatever the thread count, the platform
/// or the optimisation. Every NaN counts as the one quiet NaN 0x7fc00000; -0 and +0 differ.
///
/// Of a field, word i (32 bits) adds mix(seed + (i << 32 | word)) modulo 2^64, mix being splitmix64's finaliser. The
/// hash is the sum over fields, each under a seed of its own: k << 60 for the k-th of the schema, counted from 1; from
/// the 16th on mix(k). Without items it is 0.
std::uint64_t state_hash(const View& state);

/// Of a state held by a type that has a view.
template <class State> std::uint64_t state_hash(const State& state) requires requires { view(state); }
{ return state_hash(view(state)); }

/// One hash of several, in order.
std::uint64_t combined_hash(std::uint64_t first, std::uint64_t second);
template <class First, class Second> std::uint64_t state_hash(const First& first, const Second& second) {
    return combined_hash(state_hash(first), state_hash(second));
}

/// 16 hex digits.
std::string hash_text(std::uint64_t hash);

} // namespace lockstep
