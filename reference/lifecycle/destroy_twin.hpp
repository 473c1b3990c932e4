#pragma once
#include <algorithm>

#include "reference/lifecycle/counters.hpp"
#include "reference/lifecycle/destroy_fast.hpp"

/// The survivors among those that may die. Twins of shaders/lifecycle/destroy_reduce.comp, destroy_scan.comp and
/// destroy.comp.
namespace lockstep::lifecycle {

inline constexpr FieldId sum_of_block{sum_buffer, 0}, survivor{survivor_buffer, 0};

/// How many survive in each block of 1,024.
struct DestroyReduceTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> sum(r, in.before, sum_buffer, item);
        const EmitterTwin<R> emitter(r, *host, *of, in);
        const std::uint32_t d = emitter.may_die();
        if (item < of->first_block || item - of->first_block >= blocks_of(d))
            return sum.record();
        const auto first = static_cast<std::uint32_t>(item - of->first_block) * 1024U;
        std::uint32_t alive = 0;
        for (std::uint32_t slot = first; slot < std::min(first + 1024U, d); ++slot)
            alive += emitter.survives(slot) ? 1U : 0U;
        sum.set(site::block_sum, 0, alive);
        return sum.record();
    }
};

/// Of the blocks' sums, before each block and of all. Any correct algorithm has the same bits.
struct DestroyScanTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> sum(r, in.before, sum_buffer, item);
        const std::uint32_t blocks = blocks_of(EmitterTwin<R>(r, *host, *of, in).may_die());
        if (item < of->first_block || item - of->first_block >= blocks)
            return sum.record();
        sum.set(site::block_sum, 0, before(in, item));
        return sum.record();
    }
    [[nodiscard]] std::uint32_t before(const PassInput& in, std::size_t end) const {
        std::uint32_t sum = 0;
        for (std::size_t b = of->first_block; b < end; ++b)
            sum += in.before.word(sum_of_block, b);
        return sum;
    }
};

struct SurvivorCountTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> counters(r, in.before, counter_buffer, item);
        if (item != of->number)
            return counters.record();
        const std::uint32_t blocks = blocks_of(counters[counter::may_die]);
        counters.set(site::survivors, counter::survivors,
                     DestroyScanTwin{host, of}.before(in, of->first_block + blocks));
        return counters.record();
    }
};

/// The survivors in order: in a block, by the sums before it, and on from there.
struct DestroyTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> listed(r, in.before, survivor_buffer, item);
        const EmitterTwin<R> emitter(r, *host, *of, in);
        if (!emitter.may_list(item))
            return listed.record();
        const std::uint32_t rank = noted(r, site::list_place, emitter.list_place(item)), d = emitter.may_die();
        if (!r.decide(site::is_survivor, rank < emitter.survivors()))
            return listed.record();
        const std::uint32_t block = block_of(in, rank, blocks_of(d));
        const std::uint32_t seen = in.before.word(sum_of_block, of->first_block + block);
        if (const auto slot = emitter.survivor(rank, d, block * 1024U, seen))
            listed.set(site::rank, 0, *slot);
        return listed.record();
    }

    /// The last block before which no more than `rank` survive.
    [[nodiscard]] std::uint32_t block_of(const PassInput& in, std::uint32_t rank, std::uint32_t blocks) const {
        std::uint32_t low = 0, high = blocks;
        while (high - low > 1) {
            const std::uint32_t middle = (low + high) / 2;
            (in.before.word(sum_of_block, of->first_block + middle) <= rank ? low : high) = middle;
        }
        return low;
    }
};

/// The survivors in the order of their slots: one of those in which invocations may append them.
struct AppendTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> listed(r, in.before, survivor_buffer, item);
        const EmitterTwin<R> emitter(r, *host, *of, in);
        if (!emitter.may_list(item))
            return listed.record();
        if (const auto slot = emitter.survivor(emitter.list_place(item), emitter.may_die()))
            listed.set(site::rank, 0, *slot);
        return listed.record();
    }
    /// In one walk: no sums say where another could begin.
    template <class R> bool all(R&, const PassInput& in, const WritableView& after) const {
        destroy_fast(*host, *of, in, 0, after.count(), after);
        return true;
    }
};

/// The slots of those that died, behind those that are free already; with atomics in any order.
struct DeadTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> dead(r, in.before, dead_buffer, item);
        const EmitterTwin<R> emitter(r, *host, *of, in);
        if (!emitter.has(item))
            return dead.record();
        const std::uint32_t d = emitter.may_die();
        const std::uint32_t rank = noted(r, site::dead_rank, emitter.slot(item) - (emitter.capacity() - d));
        if (!r.decide(site::is_dead, rank < d))
            return dead.record();
        std::uint32_t seen = 0;
        for (std::uint32_t place = 0; place < d && seen <= rank; ++place)
            if (!emitter.survives(place) && seen++ == rank)
                dead.set(site::dead_slot, 0, emitter.slot_at(place));
        return dead.record();
    }
    template <class R> bool all(R&, const PassInput& in, const WritableView& after) const {
        bury_fast(*host, *of, in, 0, after.count(), after);
        return true;
    }
};

/// How many an atomic counter counts.
struct AppendCountTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> counters(r, in.before, counter_buffer, item);
        if (item != of->number)
            return counters.record();
        const EmitterTwin<R> emitter(r, *host, *of, in);
        std::uint32_t appended = counters[counter::append];
        std::uint32_t buried = counters[counter::buried];
        for (std::uint32_t place = 0; place < counters[counter::may_die]; ++place)
            ++(emitter.survives(place) ? appended : buried);
        counters.set(site::append, counter::append, appended);
        if (host->lists())
            counters.set(site::buried, counter::buried, buried);
        return counters.record();
    }
};

} // namespace lockstep::lifecycle
