#pragma once
#include <cmath>
#include <cstdint>

namespace lockstep::lifecycle {

/// Particles a frame of a rate, in Q32.32: what does not make a whole particle is kept.
class RateCounter {
  public:
    /// `rate` a second, frames of `tick` seconds; rate * tick is below 2^24.
    RateCounter(double rate, double tick)
        : increment_(static_cast<std::uint64_t>(std::floor(rate * tick * 0x1p32 + 0.5))) {}

    /// How many frame `frame` has, counted from 0.
    [[nodiscard]] std::uint32_t count(int frame) const {
        const std::uint64_t whole = increment_ >> 32U, part = increment_ & 0xffffffffU;
        const auto f = static_cast<std::uint64_t>(frame);
        return static_cast<std::uint32_t>(whole + ((part * (f + 1)) >> 32U) - ((part * f) >> 32U));
    }

  private:
    std::uint64_t increment_;
};

} // namespace lockstep::lifecycle
