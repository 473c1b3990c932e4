#pragma once
#include "reference/lifecycle/counters.hpp"
#include "reference/lifecycle/emission.hpp"
#include "reference/lifecycle/lists.hpp"

/// This frame's newborns behind the particles that are there. Twins of shaders/lifecycle/emit.comp.
namespace lockstep::lifecycle {

template <class R>
std::uint32_t emitted_of(R& r, const Host& host, const HostEmitter& of, std::uint32_t alive, int frame) {
    const std::uint32_t request = noted(r, site::request, of.request(frame));
    if (host.switches().overflow == Overflow::replace_oldest)
        return request;
    const std::uint32_t room = noted(r, site::capacity, static_cast<std::uint32_t>(of.settings().capacity)) - alive;
    return r.decide(site::fits, request < room) ? request : room;
}

struct EmitTwin {
    HostPtr host;
    const HostEmitter* of;
    StageGraph graph = stage_graph(of->settings().emission);

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const EmitterTwin<R> emitter(r, *host, *of, in);
        if (!emitter.has(item))
            return kept(r, *host, in, item);
        const std::uint32_t slot = emitter.slot(item), alive = emitter.alive();
        const std::uint32_t emitted = emitted_of(r, *host, *of, alive, in.frame);
        if (!r.decide(site::is_new, slot >= alive && slot - alive < emitted))
            return kept(r, *host, in, item);
        const std::uint32_t first = count_before(r, site::serial, in, *of, counter::serial);
        return Emission<R>(r, *host, *of, graph, in.frame)
            .particle(slot, first + (slot - alive), slot - alive, emitted);
    }
};

/// The same where slots are given: the last of the dead first.
struct EmitListedTwin {
    HostPtr host;
    const HostEmitter* of;
    StageGraph graph = stage_graph(of->settings().emission);
    std::vector<std::uint32_t> places = {}; ///< places_of_dead

    [[nodiscard]] EmitListedTwin at(const PassInput& in) const { return {host, of, graph, places_of_dead(*of, in)}; }

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const EmitterTwin<R> emitter(r, *host, *of, in);
        if (!emitter.has(item) || places[emitter.slot(item)] == not_listed)
            return kept(r, *host, in, item);
        const std::uint32_t slot = emitter.slot(item), alive = emitter.alive();
        const std::uint32_t emitted = emitted_of(r, *host, *of, alive, in.frame);
        const std::uint32_t k = emitter.capacity() - alive - 1 - noted(r, site::given_place, places[slot]);
        if (!r.decide(site::is_new, k < emitted))
            return kept(r, *host, in, item);
        const std::uint32_t first = count_before(r, site::serial, in, *of, counter::serial);
        return Emission<R>(r, *host, *of, graph, in.frame).particle(slot, first + k, k, emitted);
    }
};

/// The newborns' slots behind the list of the living.
struct EmitListTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> listed(r, in.before, survivor_buffer, item);
        const EmitterTwin<R> emitter(r, *host, *of, in);
        if (item < emitter.living_list() || item - emitter.living_list() >= of->slots)
            return listed.record();
        const std::uint32_t alive = emitter.alive();
        const std::uint32_t k = static_cast<std::uint32_t>(item - emitter.living_list()) - alive;
        if (!r.decide(site::is_new, k < emitted_of(r, *host, *of, alive, in.frame)))
            return listed.record();
        const std::uint32_t place = noted(r, site::given_place, emitter.capacity() - alive - 1 - k);
        listed.set(site::rank, 0, in.before.word({dead_buffer, 0}, of->base + place));
        return listed.record();
    }
};

struct EmitCountersTwin {
    HostPtr host;
    const HostEmitter* of;
    StageGraph graph = stage_graph(of->settings().emission);

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> counters(r, in.before, counter_buffer, item);
        if (item != of->number)
            return counters.record();
        const std::uint32_t alive = counters[counter::alive];
        const std::uint32_t emitted = emitted_of(r, *host, *of, alive, in.frame);
        counters.set(site::emitted, counter::emitted, emitted);
        if (host->switches().emit_when == EmitWhen::before_destroy && of->dies == Dies::all)
            counters.set(site::may_die, counter::may_die, alive + emitted);
        if (host->switches().position_code == PositionCode::box16 && !plan_of(host->switches().layout).floats) {
            std::uint32_t clamped = counters[counter::clamped];
            const Emission<R> births(r, *host, *of, graph, in.frame);
            for (std::uint32_t k = 0; k < emitted; ++k)
                clamped += births.clamps(born_slot(in, alive, k), counters[counter::serial] + k, k, emitted) ? 1U : 0U;
            counters.set(site::clamped, counter::clamped, clamped);
        }
        return counters.record();
    }

  private:
    [[nodiscard]] std::uint32_t born_slot(const PassInput& in, std::uint32_t alive, std::uint32_t k) const {
        return host->lists() ? in.before.word({dead_buffer, 0}, of->base + of->slots - alive - 1 - k) : alive + k;
    }
};

struct EmitArgumentsTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> calls(r, in.before, argument_buffer, item);
        if (item != of->number)
            return calls.record();
        const EmitterTwin<R> emitter(r, *host, *of, in);
        const std::uint32_t n = noted(r, site::present, emitter.present());
        calls.set_groups(site::move_groups, argument::move, groups_of(n));
        if (of->dies == Dies::all)
            calls.set_groups(site::destroy_groups, argument::destroy, emitter.destroy_groups(n));
        return calls.record();
    }
};

} // namespace lockstep::lifecycle
