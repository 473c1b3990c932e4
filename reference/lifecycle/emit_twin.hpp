#pragma once
#include "reference/lifecycle/counters.hpp"
#include "reference/lifecycle/emission.hpp"

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

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const EmitterTwin<R> emitter(r, *host, *of, in);
        if (!emitter.has(item))
            return kept(r, *host, in, item);
        const std::uint32_t slot = emitter.slot(item), alive = emitter.alive();
        const std::uint32_t emitted = emitted_of(r, *host, *of, alive, in.frame);
        if (!r.decide(site::is_new, slot >= alive && slot - alive < emitted))
            return kept(r, *host, in, item);
        const std::uint32_t first = count_before(r, site::serial, in, *of, counter::serial);
        return Emission<R>(r, *host, *of, in.frame).particle(slot, first + (slot - alive), slot - alive, emitted);
    }
};

struct EmitCountersTwin {
    HostPtr host;
    const HostEmitter* of;

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
            const Emission<R> births(r, *host, *of, in.frame);
            for (std::uint32_t k = 0; k < emitted; ++k)
                clamped += births.clamps(alive + k, counters[counter::serial] + k, k, emitted) ? 1U : 0U;
            counters.set(site::clamped, counter::clamped, clamped);
        }
        return counters.record();
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
        const std::uint32_t n = emitter.present();
        calls.set_groups(site::move_groups, argument::move, groups_of(n));
        if (of->dies == Dies::all)
            calls.set_groups(site::destroy_groups, argument::destroy, emitter.destroy_groups(n));
        return calls.record();
    }
};

} // namespace lockstep::lifecycle
