#pragma once
#include "reference/model/lifecycle/switches.hpp"
#include "reference/model/schema.hpp"

namespace lockstep::lifecycle {

/// The particles in one of the layouts, and what the passes keep beside them. `switches` says what packed fields hold.
const Schema& schema(const Switches& switches);

inline constexpr std::uint8_t particle_buffer = 0, counter_buffer = 1, survivor_buffer = 2, sum_buffer = 3,
                              ring_buffer = 4, argument_buffer = 5, length_buffer = 6, block_length_buffer = 7,
                              point_buffer = 8;
// With management=index_lists: of each emitter the slots that nobody has, and its points in the order of birth.
inline constexpr std::uint8_t dead_buffer = 9, key_buffer = 10;

/// Of an emitter, by their place among its words.
namespace counter {
inline constexpr std::uint8_t alive = 0, emitted = 1, may_die = 2, survivors = 3, append = 4, died = 5, serial = 6,
                              dropped = 7, dropped_total = 8, young = 9, ring_head = 10, distance_origin = 11,
                              clamped = 12, killed = 13, buried = 14, list = 15, count = 16;
} // namespace counter

/// Group counts and draw calls of an emitter.
namespace argument {
inline constexpr std::uint8_t destroy = 0, move = 1, simulate = 2, ribbon = 3, draw_sprite = 4, draw_ribbon = 5;
} // namespace argument

} // namespace lockstep::lifecycle
