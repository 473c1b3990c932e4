#pragma once
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif
#include <cstdint>

namespace lockstep {

/// While it lives, this thread treats subnormal operands as zero and flushes subnormal results to zero, as every GL
/// driver measured does; plain C++ keeps them. Each thread of a parallel loop needs its own.
class FlushSubnormals {
  public:
    explicit FlushSubnormals(bool flush) : saved_(read()) {
        if (flush)
            write(saved_ | flush_bits);
    }
    ~FlushSubnormals() { write(saved_); }
    FlushSubnormals(const FlushSubnormals&) = delete;
    FlushSubnormals& operator=(const FlushSubnormals&) = delete;

  private:
#if defined(__SSE2__)
    static constexpr std::uint64_t flush_bits = 0x8040; // MXCSR: flush to zero, denormals are zero
    static std::uint64_t read() { return _mm_getcsr(); }
    static void write(std::uint64_t value) { _mm_setcsr(static_cast<unsigned>(value)); }
#elif defined(__aarch64__)
    static constexpr std::uint64_t flush_bits = std::uint64_t{1} << 24U; // FPCR.FZ
    static std::uint64_t read() {
        std::uint64_t value;
        asm volatile("mrs %0, fpcr" : "=r"(value));
        return value;
    }
    static void write(std::uint64_t value) { asm volatile("msr fpcr, %0" ::"r"(value)); }
#else
#error "lockstep needs to know how this processor flushes subnormals"
#endif
    std::uint64_t saved_;
};

} // namespace lockstep
