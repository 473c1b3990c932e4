#include "reference/lifecycle/destroy_fast.hpp"

#include <cstring>

#include "reference/arithmetic.hpp"
#include "reference/lifecycle/destroy_twin.hpp"
#include "reference/readings/values.hpp"

namespace lockstep::lifecycle {
namespace {

/// Calls `visit(rank, slot)` for the survivors from the block on that holds rank `first`, or for all dead, until it
/// returns false.
template <class A, class Visit> void walk(const Host& host, const HostEmitter& of, const PassInput& in, bool living,
                                          std::uint32_t first, const Visit& visit) {
    Values<A> r{A{}};
    const EmitterTwin<Values<A>> emitter(r, host, of, in);
    const std::uint32_t d = emitter.may_die();
    std::uint32_t place = 0, rank = 0;
    if (living && host.switches().compaction == Compaction::scan && d > 0) {
        const std::uint32_t block = DestroyTwin{nullptr, &of}.block_of(in, first, blocks_of(d));
        place = block * 1024U;
        rank = in.before.word(sum_of_block, of.first_block + block);
    }
    for (; place < d; ++place)
        if (emitter.survives(place) == living && !visit(rank++, emitter.slot_at(place)))
            return;
}

template <class Visit> void walk_of(const Host& host, const HostEmitter& of, const PassInput& in, bool living,
                                    std::uint32_t first, const Visit& visit) {
    if (host.settings().arithmetic == ArithmeticSwitch::exact)
        walk<Portable>(host, of, in, living, first, visit);
    else
        walk<Strict>(host, of, in, living, first, visit);
}

/// Where the survivors are listed, or the dead, in their buffer.
std::size_t begin_of(const Host& host, const HostEmitter& of, const PassInput& in, bool living) {
    if (living && host.lists())
        return 2 * of.base + (1U - (in.before.word({counter_buffer, counter::list}, of.number) & 1U)) * of.slots;
    if (living)
        return of.base;
    return of.base + of.slots - in.before.word({counter_buffer, counter::may_die}, of.number);
}

void list_fast(const Host& host, const HostEmitter& of, const PassInput& in, bool living, std::size_t first,
               std::size_t last, const WritableView& after) {
    const View& before = in.before[living ? survivor_buffer : dead_buffer];
    std::memcpy(after.columns[0] + first * sizeof(std::uint32_t), before.columns[0] + first * sizeof(std::uint32_t),
                (last - first) * sizeof(std::uint32_t));
    const std::size_t begin = begin_of(host, of, in, living);
    const std::size_t from = std::max(first, begin), to = std::min(last, begin + of.slots);
    if (from >= to)
        return;
    walk_of(host, of, in, living, static_cast<std::uint32_t>(from - begin),
            [&](std::uint32_t rank, std::uint32_t slot) {
                const std::size_t item = begin + rank;
                if (item >= from && item < to)
                    std::memcpy(after.columns[0] + item * sizeof slot, &slot, sizeof slot);
                return item + 1 < to;
            });
}

ItemRange listed(const Host& host, const HostEmitter& of, const PassInput& in, bool living) {
    std::size_t count = 0;
    walk_of(host, of, in, living, 0, [&](std::uint32_t, std::uint32_t) {
        ++count;
        return true;
    });
    return {begin_of(host, of, in, living), count};
}

} // namespace

void destroy_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first, std::size_t last,
                  const WritableView& after) {
    list_fast(host, of, in, true, first, last, after);
}

ItemRange survivors_of(const Host& host, const HostEmitter& of, const PassInput& in) {
    return listed(host, of, in, true);
}

void bury_fast(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t first, std::size_t last,
               const WritableView& after) {
    list_fast(host, of, in, false, first, last, after);
}

ItemRange dead_of(const Host& host, const HostEmitter& of, const PassInput& in) { return listed(host, of, in, false); }

} // namespace lockstep::lifecycle
