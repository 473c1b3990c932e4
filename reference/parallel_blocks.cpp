#include "reference/parallel_blocks.hpp"

#include <atomic>
#include <exception>

namespace lockstep {

void parallel_blocks(std::ptrdiff_t count, const std::function<void(std::ptrdiff_t)>& work) {
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
