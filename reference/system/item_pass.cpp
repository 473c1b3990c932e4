#include "reference/system/item_pass.hpp"

#include <algorithm>
#include <cmath>

#include "reference/parallel_blocks.hpp"

namespace lockstep {

bool ItemOutcome::contains(std::span<const std::uint32_t> words, const Resource& about) const {
    std::size_t at = 0;
    for (const Component c : components(about)) {
        const Value value{about.fields[c.field].scalar, words[at]};
        const Interval& legal = values[at++];
        const bool fits = value.scalar == Scalar::float32
                              ? legal.contains(value.real())
                              : legal.any || (legal.low <= static_cast<double>(value.integer()) &&
                                              static_cast<double>(value.integer()) <= legal.high);
        if (!fits)
            return false;
    }
    return true;
}

void run_pass(const ItemPass& pass, const PassInput& in, const Profile& profile, const WritableView& after) {
    if (!pass.runs(in.frame))
        return;
    constexpr std::size_t block = 1024;
    const auto blocks = static_cast<std::ptrdiff_t>((after.count() + block - 1) / block);
    parallel_blocks(blocks, [&](std::ptrdiff_t b) {
        const std::size_t first = static_cast<std::size_t>(b) * block;
        pass.run(in, profile, first, std::min(first + block, after.count()), after);
    });
}

} // namespace lockstep
