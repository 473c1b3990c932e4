#include "reference/model/state_hash.hpp"

#include <cstddef>
#include <cstring>

#include <fmt/format.h>

#include "reference/model/random.hpp"

namespace lockstep {
namespace {

std::uint32_t canonical_nan(std::uint32_t bits) { return (bits & 0x7fffffffU) > 0x7f800000U ? 0x7fc00000U : bits; }
std::uint32_t as_it_is(std::uint32_t bits) { return bits; }

template <class Canonical>
std::uint64_t hash_words(std::uint64_t seed, const std::byte* words, std::size_t count, Canonical canonical) {
    std::uint64_t sum = 0;
    const auto n = static_cast<std::ptrdiff_t>(count);
#pragma omp parallel for reduction(+ : sum) schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        std::uint32_t word = 0;
        std::memcpy(&word, words + static_cast<std::size_t>(i) * sizeof word, sizeof word);
        sum += splitmix64(seed + (static_cast<std::uint64_t>(i) << 32U | canonical(word)));
    }
    return splitmix64(sum ^ count);
}

std::uint64_t seed_of(std::size_t column) {
    const std::uint64_t k = column + 1;
    return k < 16 ? k << 60U : splitmix64(k);
}

} // namespace

std::uint64_t state_hash(const View& state) {
    std::uint64_t hash = 0;
    if (state.count() == 0)
        return hash;
    for (std::uint8_t f = 0; f < state.fields().size(); ++f) {
        const Field& field = state.fields()[f];
        const std::uint64_t seed = seed_of(state.schema->column({state.resource, f}));
        const std::size_t words = state.count() * static_cast<std::size_t>(field.components);
        hash += field.scalar == Scalar::float32 ? hash_words(seed, state.columns[f], words, canonical_nan)
                                                : hash_words(seed, state.columns[f], words, as_it_is);
    }
    return hash;
}

std::uint64_t combined_hash(std::uint64_t first, std::uint64_t second) { return splitmix64(first) + second; }

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

} // namespace lockstep
