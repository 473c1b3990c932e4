#include "reference/lifecycle/destroy_fast.hpp"

#include <cstring>

#include "reference/arithmetic.hpp"
#include "reference/lifecycle/destroy_twin.hpp"
#include "reference/readings/values.hpp"

namespace lockstep::lifecycle {
namespace {

/// Calls `visit(rank, slot)` for the survivors from the block on that holds rank `first`, until it returns false.
template <class A, class Visit>
void walk(const Host& host, const HostEmitter& of, const PassInput& in, std::uint32_t first, const Visit& visit) {
    Values<A> r{A{}};
    const EmitterTwin<Values<A>> emitter(r, host, of, in);
    const std::uint32_t d = emitter.may_die();
    std::uint32_t slot = 0, rank = 0;
    if (host.switches().compaction == Compaction::scan && d > 0) {
        const std::uint32_t block = DestroyTwin{nullptr, &of}.block_of(in, first, blocks_of(d));
        slot = block * 1024U;
        rank = in.before.word(sum_of_block, of.first_block + block);
    }
    for (; slot < d; ++slot)
        if (emitter.survives(slot) && !visit(rank++, slot))
            return;
}

template <class Visit>
void walk_of(const Host& host, const HostEmitter& of, const PassInput& in, std::uint32_t first, const Visit& visit) {
    if (host.settings().arithmetic == ArithmeticSwitch::exact)
        walk<Portable>(host, of, in, first, visit);
    else
        walk<Strict>(host, of, in, first, visit);
}

} // namespace

void destroy_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first, std::size_t last,
                  const WritableView& after) {
    const View& before = in.before[survivor_buffer];
    std::memcpy(after.columns[0] + first * sizeof(std::uint32_t), before.columns[0] + first * sizeof(std::uint32_t),
                (last - first) * sizeof(std::uint32_t));
    const std::size_t from = std::max(first, of.base), to = std::min(last, of.base + of.slots);
    if (from >= to)
        return;
    walk_of(host, of, in, static_cast<std::uint32_t>(from - of.base), [&](std::uint32_t rank, std::uint32_t slot) {
        const std::size_t item = of.base + rank;
        if (item >= from && item < to)
            std::memcpy(after.columns[0] + item * sizeof slot, &slot, sizeof slot);
        return item + 1 < to;
    });
}

ItemRange survivors_of(const Host& host, const HostEmitter& of, const PassInput& in) {
    std::size_t count = 0;
    walk_of(host, of, in, 0, [&](std::uint32_t, std::uint32_t) {
        ++count;
        return true;
    });
    return {of.base, count};
}

} // namespace lockstep::lifecycle
