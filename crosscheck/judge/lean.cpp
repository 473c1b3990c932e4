#include "crosscheck/judge/lean.hpp"

#include <cmath>
#include <cstddef>

namespace lockstep {
namespace {

/// log2 of the probability that a fair coin shows a side `least` times or more in `n` throws.
double log2_tail(std::uint64_t least, std::uint64_t n) {
    const auto of = [](std::uint64_t x) { return std::lgamma(static_cast<double>(x) + 1.0); };
    double sum = 0.0;
    for (std::uint64_t k = least; k <= n; ++k)
        sum += std::exp(of(n) - of(k) - of(n - k) - (of(n) - of(least) - of(n - least)));
    return (of(n) - of(least) - of(n - least)) / std::log(2.0) - static_cast<double>(n) + std::log2(sum);
}

Leans::Direction opposite(Leans::Direction d) { return static_cast<Leans::Direction>(d ^ 1U); }

} // namespace

void Leans::add(const Lean& lean) {
    constexpr std::size_t enough = 1U << 20U; // to say what the others would say too
    if (seen_.size() >= enough || !seen_.insert(lean.place).second)
        return;
    counted_.push_back(lean);
    const auto note = [&](int sign, Direction less, Direction more, bool half) {
        if (sign == 0)
            return;
        const Direction d = sign < 0 ? less : more;
        ++count_[d][half ? 1 : 0];
        beyond_[d][half ? 1 : 0] += lean.beyond_rounding ? 1 : 0;
    };
    note(lean.direction.x, left, right, lean.right_half);
    note(lean.direction.y, down, up, lean.upper_half);
}

bool Leans::one_sided(Direction d) const {
    for (std::size_t half = 0; half < 2; ++half) {
        const std::uint64_t these = beyond_[d][half];
        const std::uint64_t others = beyond_[opposite(d)][half];
        if (these <= others || !(log2_tail(these, these + others) < -64.0))
            return false;
    }
    return true;
}

bool Leans::all_this_way(Direction d) const {
    return beyond_[d][0] > 0 && beyond_[d][1] > 0 && beyond_rounding(opposite(d)) == 0;
}

} // namespace lockstep
