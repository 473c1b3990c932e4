#pragma once
#include <optional>

#include "reference/lifecycle/counters.hpp"
#include "reference/lifecycle/lists.hpp"
#include "reference/lifecycle/simulation.hpp"

/// The ranks are closed, and a tick passes. Twins of shaders/lifecycle/move.comp and simulate.comp.
namespace lockstep::lifecycle {

/// The slot from which a particle is moved to `slot`; nothing beyond the last.
template <class R> std::optional<std::uint32_t> source_of(R& r, const EmitterTwin<R>& emitter, const HostEmitter& of,
                                                          const PassInput& in, std::uint32_t slot) {
    const std::uint32_t s = emitter.survivors(), d = emitter.may_die();
    if (!r.decide(site::is_present, slot < s + emitter.present() - d))
        return {};
    const bool listed = r.decide(site::is_survivor, slot < s);
    if (listed)
        return noted(r, site::source, in.before.word({survivor_buffer, 0}, of.base + slot));
    return noted(r, site::source, noted(r, site::rest, d + (slot - s)));
}

struct MoveTwin {
    FrameOf frame;

    [[nodiscard]] MoveTwin at(int number) const { return {frame_of(frame, number)}; }

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const Host& host = *frame.host;
        const EmitterTwin<R> emitter(r, host, *frame.of, in);
        if (!emitter.has(item))
            return kept(r, host, in, item);
        const auto from = source_of(r, emitter, *frame.of, in, emitter.slot(item));
        if (!from)
            return kept(r, host, in, item);
        Particle<R> particle(r, host, emitter.words_of(*from));
        particle.at(emitter.slot(item), in.frame);
        if (host.switches().fuse == Fuse::fused)
            simulate(r, frame, particle);
        return particle.record();
    }
};

struct SimulateTwin {
    FrameOf frame;

    [[nodiscard]] SimulateTwin at(int number) const { return {frame_of(frame, number)}; }

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const EmitterTwin<R> emitter(r, *frame.host, *frame.of, in);
        if (!emitter.has(item) || !r.decide(site::is_present, emitter.slot(item) < emitter.alive()))
            return kept(r, *frame.host, in, item);
        Particle<R> particle(r, *frame.host, emitter.words_of(emitter.slot(item)));
        particle.at(emitter.slot(item), in.frame);
        simulate(r, frame, particle);
        return particle.record();
    }
};

/// The same of those that are listed; they stay where they are.
struct SimulateListedTwin {
    FrameOf frame;
    std::vector<std::uint32_t> places = {}; ///< places_of_living

    [[nodiscard]] SimulateListedTwin at(const PassInput& in) const {
        return {frame_of(frame, in.frame), places_of_living(*frame.host, *frame.of, in)};
    }

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const EmitterTwin<R> emitter(r, *frame.host, *frame.of, in);
        if (!emitter.has(item) || places[emitter.slot(item)] == not_listed ||
            !r.decide(site::is_present, places[emitter.slot(item)] < emitter.present()))
            return kept(r, *frame.host, in, item);
        Particle<R> particle(r, *frame.host, emitter.words_of(emitter.slot(item)));
        particle.at(emitter.slot(item), in.frame);
        simulate(r, frame, particle);
        return particle.record();
    }
};

/// How many were killed, and how many places were clamped, in a pass that simulates.
struct SimulatedCountTwin {
    FrameOf frame;

    [[nodiscard]] SimulatedCountTwin at(int number) const { return {frame_of(frame, number)}; }

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        UintItem<R> counters(r, in.before, counter_buffer, item);
        if (item != frame.of->number)
            return counters.record();
        const EmitterTwin<R> emitter(r, *frame.host, *frame.of, in);
        const bool lists = frame.host->lists(), fused = !lists && frame.host->switches().fuse == Fuse::fused;
        const std::uint32_t n = lists ? emitter.present() : counters[counter::alive];
        std::uint32_t killed = 0, clamped = 0;
        for (std::uint32_t place = 0; place < frame.of->slots; ++place) {
            std::optional<std::uint32_t> from;
            if (fused)
                from = source_of(r, emitter, *frame.of, in, place);
            else if (place < n)
                from = emitter.slot_at(place);
            if (!from)
                break;
            Particle<R> particle(r, *frame.host, emitter.words_of(*from));
            particle.at(lists ? *from : place, in.frame);
            killed += simulate(r, frame, particle) ? 1U : 0U;
            clamped += particle.was_clamped() ? 1U : 0U;
        }
        counters.set(site::killed, counter::killed, counters[counter::killed] + killed);
        counters.set(site::clamped, counter::clamped, counters[counter::clamped] + clamped);
        return counters.record();
    }
};

} // namespace lockstep::lifecycle
