#pragma once
#include <cstdint>
#include <vector>

#include "reference/lifecycle/counters.hpp"

/// Where the slots of an emitter stand in its lists. Twin of shaders/lifecycle/lists.glsl.
namespace lockstep::lifecycle {

inline constexpr std::uint32_t not_listed = 0xffffffffU;

/// The place of each slot among `count` items of a list, or not_listed.
inline std::vector<std::uint32_t> places_in(const HostEmitter& of, const PassInput& in, FieldId list, std::size_t first,
                                            std::uint32_t count) {
    std::vector<std::uint32_t> places(of.slots, not_listed);
    for (std::uint32_t place = 0; place < count && place < of.slots; ++place)
        if (const std::uint32_t slot = in.before.word(list, first + place); slot < of.slots)
            places[slot] = place;
    return places;
}

/// Of those that are there at the start of the destroy pass.
inline std::vector<std::uint32_t> places_of_living(const Host& host, const HostEmitter& of, const PassInput& in) {
    const auto counted = [&](std::uint8_t word) { return in.before.word({counter_buffer, word}, of.number); };
    const bool before = host.switches().emit_when == EmitWhen::before_destroy;
    return places_in(of, in, {survivor_buffer, 0}, 2 * of.base + (counted(counter::list) & 1U) * of.slots,
                     counted(counter::alive) + (before ? counted(counter::emitted) : 0));
}

/// Of those that nobody has.
inline std::vector<std::uint32_t> places_of_dead(const HostEmitter& of, const PassInput& in) {
    const std::uint32_t alive = in.before.word({counter_buffer, counter::alive}, of.number);
    return places_in(of, in, {dead_buffer, 0}, of.base, static_cast<std::uint32_t>(of.slots) - alive);
}

} // namespace lockstep::lifecycle
