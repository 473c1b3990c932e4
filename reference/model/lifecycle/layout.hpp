#pragma once
#include <cstddef>

#include "reference/model/lifecycle/switches.hpp"

namespace lockstep::lifecycle {

/// Where a layout has what, in words of 32 bits from a particle's start; -1: it has it elsewhere or in another form.
/// Position, Velocity, Acceleration, both lifetimes and SpawnTime are floats (from `position` on, each at its place) or
/// halves, which fill words 0 to 5 as those of the 40-byte struct.
struct LayoutPlan {
    std::size_t words;
    bool floats;       ///< of the simulation fields
    bool half_sizes;   ///< InitialSize and EndSize are the halves of one word
    bool half_lengths; ///< likewise both distances
    bool float_colors;
    int position, velocity, lifetime, remaining, acceleration, spawn_time, order;
    int size, end_size;  ///< or the word of both
    int previous, start; ///< distances; or the word of both
    int color, opacity, end_color, end_opacity;

    /// Whether a word is a float as it stands.
    [[nodiscard]] bool is_float(std::size_t word) const;
};

const LayoutPlan& plan_of(Layout layout);

} // namespace lockstep::lifecycle
