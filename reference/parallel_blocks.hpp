#pragma once
#include <algorithm>
#include <cstddef>
#include <functional>

namespace lockstep {

/// Calls `work(i)` for i from 0 to count - 1, on all threads and in any order. Of what is thrown, that of the least i
/// is thrown on, whatever the number of threads: an exception may not leave a parallel loop by itself.
void parallel_blocks(std::ptrdiff_t count, const std::function<void(std::ptrdiff_t)>& work);

/// Calls `work(first, last)` for ranges of 1024 that make up 0 to count, the last excluded, as parallel_blocks does.
template <class Work> void parallel_ranges(std::size_t count, const Work& work) {
    constexpr std::size_t block = 1024;
    parallel_blocks(static_cast<std::ptrdiff_t>((count + block - 1) / block), [&](std::ptrdiff_t b) {
        const std::size_t first = static_cast<std::size_t>(b) * block;
        work(first, std::min(first + block, count));
    });
}

} // namespace lockstep
