#include "reference/system/item_pass.hpp"

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
    if (pass.run_all(in, profile, after))
        return;
    parallel_ranges(after.count(),
                    [&](std::size_t first, std::size_t last) { pass.run(in, profile, first, last, after); });
}

void run_pass(const ItemPass& pass, const SystemState& before, int frame, const Profile& profile, SystemState& after) {
    if (!pass.runs(frame))
        return;
    const std::uint8_t r = pass.resource();
    for (const std::uint8_t f : pass.keeps())
        after.share({r, f}, before);
    run_pass(pass, {before.view(), frame}, profile, after.all_but(pass.keeps(), r));
}

} // namespace lockstep
