#pragma once
#include <atomic>
#include <cstddef>
#include <exception>

namespace lockstep {

/// Calls `work(i)` for i from 0 to count - 1, on all threads and in any order. Of what is thrown, that of the least i
/// is thrown on, whatever the number of threads: an exception may not leave a parallel loop by itself.
template <class Work> void parallel_blocks(std::ptrdiff_t count, const Work& work) {
    std::atomic<std::ptrdiff_t> failed{count};
    std::exception_ptr error;
#pragma omp parallel for schedule(dynamic) if (count > 1)
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        if (i > failed)
            continue;
        try {
            work(i);
        } catch (...) {
#pragma omp critical(lockstep_parallel_blocks)
            if (i < failed) {
                failed = i;
                error = std::current_exception();
            }
        }
    }
    if (error)
        std::rethrow_exception(error);
}

} // namespace lockstep
