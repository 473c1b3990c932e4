#pragma once
#include <cstddef>
#include <string>

#include "crosscheck/command/verb.hpp"

namespace lockstep {

/// One of the parts that a run is shared out into, by an engine that has many machines or cores.
struct Shard {
    std::size_t part = 1, of = 1; ///< part counts from 1
    std::string asked = {};       ///< by what: "--shard 2/8", "TEST_SHARD_INDEX=1"; empty: nothing is shared

    [[nodiscard]] bool is_asked() const { return !asked.empty(); }
    /// Every N-th item, so that what is slow side by side is spread over all parts.
    [[nodiscard]] bool has(std::size_t index) const { return index % of == part - 1; }
    /// Of items that belong one after the other: the first of the part, and the one after its last.
    [[nodiscard]] std::size_t first(std::size_t count) const {
        return count / of * (part - 1) + count % of * (part - 1) / of;
    }
    [[nodiscard]] std::size_t end(std::size_t count) const { return count / of * part + count % of * part / of; }
};

/// "--shard K/N", K from 1 to N.
Option shard_option(Shard& target);

/// What the environment asks for: TEST_SHARD_INDEX, from 0, and TEST_TOTAL_SHARDS, as GoogleTest and Bazel set them;
/// else what Open MPI sets, OMPI_COMM_WORLD_RANK and OMPI_COMM_WORLD_SIZE. Throws Error where one of two is missing, or
/// they are no numbers that go together.
Shard shard_of_environment();

} // namespace lockstep
