#pragma once
#include <cstddef>
#include <cstdint>

namespace lockstep::lifecycle {

/// The bitonic network (Batcher 1968): calls `visit(run, apart)` for each step that sorts a power of two of keys. In it
/// runs of `run` keys rise and fall in turn, and keys `apart` from each other are compared.
template <class Visit> void for_each_sort_step(std::size_t keys, const Visit& visit) {
    for (std::uint32_t run = 2; run <= keys; run *= 2)
        for (std::uint32_t apart = run / 2; apart > 0; apart /= 2)
            visit(run, apart);
}

} // namespace lockstep::lifecycle
