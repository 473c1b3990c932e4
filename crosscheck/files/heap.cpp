#include "crosscheck/files/heap.hpp"

#include <cstdlib> // says whose library it is
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace lockstep {

void give_back_large_arrays() {
#ifdef M_MMAP_THRESHOLD
    constexpr int large = 16 << 20, kept = 64 << 20;
    mallopt(M_MMAP_THRESHOLD, large); // which glibc else raises to 32 MiB, as it sees fit
    mallopt(M_TRIM_THRESHOLD, kept);
#endif
}

} // namespace lockstep
