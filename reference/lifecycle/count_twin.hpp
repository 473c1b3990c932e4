#pragma once
#include "reference/lifecycle/counters.hpp"

/// What one invocation counts between the passes. Twins of shaders/lifecycle/post_destroy.comp, post_emit.comp and
/// indirect.comp.
namespace lockstep::lifecycle {

/// The emission counts enter the ring, and those of the frame before the window leave it.
template <class R> void count_emission(R& r, UintItem<R>& counters, const HostEmitter& of, const PassInput& in) {
    const std::uint32_t emitted = counters[counter::emitted];
    const std::uint32_t dropped = noted(r, site::request, of.request(in.frame)) - emitted;
    counters.set(site::serial_count, counter::serial, counters[counter::serial] + emitted);
    counters.set(site::dropped, counter::dropped, dropped);
    counters.set(site::dropped_total, counter::dropped_total, counters[counter::dropped_total] + dropped);
    if (of.window == 0)
        return;
    const std::uint32_t head = counters[counter::ring_head];
    const std::uint32_t leaving = noted(r, site::leaving, in.before.word({ring_buffer, 0}, of.first_in_ring + head));
    counters.set(site::young, counter::young, counters[counter::young] + emitted - leaving);
    counters.set(site::ring_head, counter::ring_head, head + 1 == of.window ? 0 : head + 1);
}

struct PostDestroyTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> counters(r, in.before, counter_buffer, item);
        if (item != of->number)
            return counters.record();
        const EmitterTwin<R> emitter(r, *host, *of, in);
        const std::uint32_t s = emitter.survivors(), died = emitter.may_die() - s;
        if (of->settings().draw == Emitter::Draw::ribbon)
            move_origin(r, counters, in, s);
        counters.set(site::alive, counter::alive, emitter.present() - died);
        counters.set(site::survivors, counter::survivors, s);
        counters.set(site::died, counter::died, died);
        if (host->lists())
            counters.set(site::current_list, counter::list, 1U - counters[counter::list]);
        if (host->switches().emit_when == EmitWhen::before_destroy)
            count_emission(r, counters, *of, in);
        return counters.record();
    }

  private:
    /// What dies at the tail takes its length with it: u stays where it was.
    template <class R> void move_origin(R& r, UintItem<R>& counters, const PassInput& in, std::uint32_t s) const {
        if (host->switches().distance_sum != DistanceSum::fixed || host->switches().uv_anchor != UvAnchor::fixed)
            return;
        const std::uint32_t n = counters[counter::alive];
        const std::uint32_t first = s > 0 ? in.before.word({survivor_buffer, 0}, of->base) : counters[counter::may_die];
        if (n == 0 || first == 0)
            return;
        const std::uint32_t last = first < n ? first : n - 1;
        const std::uint32_t way = noted(r, site::way_of_dead, in.before.word({length_buffer, 0}, of->base + last));
        counters.set(site::distance_origin, counter::distance_origin, counters[counter::distance_origin] + way);
    }
};

struct PostEmitTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> counters(r, in.before, counter_buffer, item);
        if (item != of->number)
            return counters.record();
        const std::uint32_t alive = noted(r, site::alive_before, counters[counter::alive]);
        counters.set(site::alive, counter::alive, alive + counters[counter::emitted]);
        count_emission(r, counters, *of, in);
        return counters.record();
    }
};

/// Reads the counters as they are once the head went on.
struct RingTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> count(r, in.before, ring_buffer, item);
        if (of->window == 0)
            return count.record();
        const std::size_t head = in.before.word({counter_buffer, counter::ring_head}, of->number);
        const std::size_t last = (head + of->window - 1) % of->window;
        if (item == of->first_in_ring + last)
            count.set(site::ring, 0, EmitterTwin<R>(r, *host, *of, in).emitted());
        return count.record();
    }
};

/// Reads the counters as post_destroy left them, and as post_emit did.
struct PostArgumentsTwin {
    HostPtr host;
    const HostEmitter* of;
    bool simulates; ///< of post_destroy

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> calls(r, in.before, argument_buffer, item);
        if (item != of->number)
            return calls.record();
        const std::uint32_t groups = groups_of(EmitterTwin<R>(r, *host, *of, in).alive());
        if (simulates)
            calls.set_groups(site::simulate_groups, argument::simulate, groups);
        calls.set_groups(site::ribbon_groups, argument::ribbon, groups);
        return calls.record();
    }
};

struct IndirectCountersTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> counters(r, in.before, counter_buffer, item);
        if (item != of->number)
            return counters.record();
        const std::uint32_t alive = noted(r, site::alive_before, counters[counter::alive]);
        std::uint32_t d = of->dies == Dies::none ? 0 : alive;
        if (of->dies == Dies::window) {
            d -= counters[counter::young];
            if (host->switches().emit_when == EmitWhen::before_destroy)
                d += noted(r, site::leaving,
                           in.before.word({ring_buffer, 0}, of->first_in_ring + counters[counter::ring_head]));
        }
        counters.set(site::may_die, counter::may_die, d);
        counters.set(site::append, counter::append, 0);
        if (host->lists())
            counters.set(site::buried, counter::buried, 0);
        return counters.record();
    }
};

struct IndirectTwin {
    HostPtr host;
    const HostEmitter* of;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> calls(r, in.before, argument_buffer, item);
        if (item != of->number)
            return calls.record();
        const EmitterTwin<R> emitter(r, *host, *of, in);
        const std::uint32_t alive = emitter.alive(), segments = alive == 0 ? 0 : alive - 1;
        const auto corners = static_cast<std::uint32_t>(host->sprite_corners().size());
        const bool points = host->settings().arithmetic == ArithmeticSwitch::exact;
        draw(calls, site::draw_sprite, 12, points ? alive : noted(r, site::corners, corners), points ? 1 : alive);
        draw(calls, site::draw_ribbon, 16, points ? segments : 4, points ? 1 : segments);
        calls.set_groups(site::destroy_groups, argument::destroy, emitter.destroy_groups(emitter.may_die()));
        if (host->switches().emit_when == EmitWhen::after_simulation)
            calls.set_groups(site::move_groups, argument::move, groups_of(alive));
        return calls.record();
    }

  private:
    template <class R>
    static void draw(UintItem<R>& calls, At place, std::size_t word, std::uint32_t count, std::uint32_t instances) {
        calls.set(place, word, count);
        calls.set(site::draw_instances, word + 1, instances);
        calls.set(place, word + 2, 0);
        calls.set(place, word + 3, 0);
    }
};

} // namespace lockstep::lifecycle
