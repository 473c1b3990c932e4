#pragma once
#include <algorithm>
#include <array>
#include <bit>

#include "reference/lifecycle/counters.hpp"

/// The points of a ribbon in the order of birth, where particles stay in their slots. Twins of
/// shaders/lifecycle/pre_sort.comp and sort.comp.
namespace lockstep::lifecycle {

/// Time of birth, order in its frame, slot: no two are alike but for padding.
using Key = std::array<std::uint32_t, 3>;

inline Key key_at(const PassInput& in, std::size_t item) {
    return {in.before.word({key_buffer, 0}, item), in.before.word({key_buffer, 1}, item),
            in.before.word({key_buffer, 2}, item)};
}

/// Where a particle stands among the sorted keys; beyond the last where it does not.
inline std::uint32_t place_of_point(const Host& host, const HostEmitter& of, const PassInput& in, std::size_t item) {
    if (!host.lists())
        return static_cast<std::uint32_t>(item - of.base);
    if (item < of.base || item - of.base >= of.slots)
        return 0xffffffffU;
    const LayoutPlan& plan = plan_of(host.switches().layout);
    const RawWords raw = raw_words(in.before, particle_buffer, item);
    const Key own{raw[static_cast<std::size_t>(plan.spawn_time)], raw[static_cast<std::size_t>(plan.order)],
                  static_cast<std::uint32_t>(item - of.base)};
    std::uint32_t low = 0, high = in.before.word({counter_buffer, counter::alive}, of.number);
    while (low < high) {
        const std::uint32_t middle = low + (high - low) / 2;
        const Key key = key_at(in, of.first_key + middle);
        if (key == own)
            return middle;
        if (key < own)
            low = middle + 1;
        else
            high = middle;
    }
    return 0xffffffffU;
}

struct PreSortTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> key(r, in.before, key_buffer, item);
        if (item < of->first_key || item - of->first_key >= of->keys)
            return key.record();
        const EmitterTwin<R> emitter(r, *host, *of, in);
        const auto place = static_cast<std::uint32_t>(item - of->first_key);
        Key made{0xffffffffU, 0xffffffffU, 0xffffffffU};
        if (!r.decide(site::is_padding, place >= emitter.alive())) {
            const std::uint32_t slot = emitter.slot_at(place);
            const LayoutPlan& plan = plan_of(host->switches().layout);
            const RawWords raw = emitter.words_of(slot);
            made = {raw[static_cast<std::size_t>(plan.spawn_time)], raw[static_cast<std::size_t>(plan.order)], slot};
        }
        key.set(site::key_time, 0, made[0]);
        key.set(site::key_order, 1, made[1]);
        key.set(site::key_slot, 2, made[2]);
        return key.record();
    }
};

/// One step of the bitonic network: runs of `run` keys rise and fall in turn, keys `apart` from each other are
/// compared.
struct SortTwin {
    HostPtr host;
    const HostEmitter* of;
    std::uint32_t run, apart;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> key(r, in.before, key_buffer, item);
        if (item < of->first_key || item - of->first_key >= of->keys)
            return key.record();
        const auto place = static_cast<std::uint32_t>(item - of->first_key);
        const std::uint32_t low = place & ~apart, high = place | apart;
        const bool rises = r.decide(site::is_rising, (low & run) == 0);
        const Key first = key_at(in, of->first_key + low), second = key_at(in, of->first_key + high);
        const bool swaps = before(r, second, first) == rises;
        const Key& kept = (place == low) == swaps ? second : first;
        for (std::size_t w = 0; w < kept.size(); ++w)
            key.set(w == 0 ? site::key_time : w == 1 ? site::key_order : site::key_slot, w, kept[w]);
        return key.record();
    }

  private:
    template <class R> static bool before(R& r, const Key& a, const Key& b) {
        const auto differ = [&](At place, std::size_t w) { return noted(r, place, a[w] == b[w] ? 0U : 1U) != 0; };
        const std::size_t by = differ(site::key_time_compared, 0) ? 0 : differ(site::key_order_compared, 1) ? 1 : 2;
        return r.decide(site::sorts_before, a[by] < b[by]);
    }
};

} // namespace lockstep::lifecycle
