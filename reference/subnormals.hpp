#pragma once
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif
#include <cstdint>

namespace lockstep {

/// While it lives, this thread treats subnormal operands as zero and flushes subnormal results to zero, as every GL
/// driver measured does, or keeps them, as plain C++ does, whatever held before. Each thread of a parallel loop needs
/// its own: a thread starts as the one that made it was just then.
class FlushSubnormals {
  public:
    explicit FlushSubnormals(bool flush) : FlushSubnormals(flush, flush) {}
    /// Where the processor cannot tell the two apart (aarch64), both are as `operands` says.
    FlushSubnormals(bool operands, bool results) : saved_(read()) {
        const std::uint64_t bits = (operands ? operand_bits : 0U) | (results ? result_bits : 0U);
        write((saved_ & ~(operand_bits | result_bits)) | bits);
    }
    ~FlushSubnormals() { write(saved_); }
    FlushSubnormals(const FlushSubnormals&) = delete;
    FlushSubnormals& operator=(const FlushSubnormals&) = delete;

  private:
#if defined(__SSE2__)
    static constexpr std::uint64_t operand_bits = 0x40;  // MXCSR: denormals are zero
    static constexpr std::uint64_t result_bits = 0x8000; // MXCSR: flush to zero
    static std::uint64_t read() { return _mm_getcsr(); }
    static void write(std::uint64_t value) { _mm_setcsr(static_cast<unsigned>(value)); }
#elif defined(__aarch64__)
    static constexpr std::uint64_t operand_bits = std::uint64_t{1} << 24U; // FPCR.FZ
    static constexpr std::uint64_t result_bits = 0;
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
