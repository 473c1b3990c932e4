#pragma once
#include "reference/model/lights/settings.hpp"
#include "reference/model/schema.hpp"
#include "reference/model/system_state.hpp"

namespace lockstep::lights {

/// The state of a run with these switches: formats follow them. Lives as long as the program.
const Schema& schema(const Switches& switches);

/// A run's state before its first frame: the lights and the obstacles, all else 0. What the switches do not use has one
/// texel or item.
SystemState start(const Settings& settings);

// In the order in which they are compared.
inline constexpr std::uint8_t light_buffer = 0, accumulator_image = 1, cell_buffer = 2, sorted_buffer = 3,
                              colour_image = 4, direction_image = 5, position_image = 6, normal_image = 7,
                              albedo_image = 8, depth_image = 9, lit_image = 10, encoded_image = 11, corner_buffer = 12;

namespace field {
inline constexpr FieldId light_position{light_buffer, 0}, range{light_buffer, 1}, light_direction{light_buffer, 2},
    speed{light_buffer, 3}, light_colour{light_buffer, 4}, inv_range2{light_buffer, 5};
inline constexpr FieldId word{accumulator_image, 0}, cell_count{cell_buffer, 0}, cell_start{cell_buffer, 1},
    place{sorted_buffer, 0};
inline constexpr FieldId voxel_colour{colour_image, 0}, voxel_direction{direction_image, 0};
inline constexpr FieldId texel_position{position_image, 0}, texel_normal{normal_image, 0},
    texel_albedo{albedo_image, 0}, texel_depth{depth_image, 0}, pixel{lit_image, 0}, code{encoded_image, 0};
inline constexpr FieldId corner_position{corner_buffer, 0}, corner_albedo{corner_buffer, 1};
} // namespace field

/// Words that a voxel has in the accumulator, each behind the other along z: of r g b, x y z and W, then the count.
inline int channels(Accumulate accumulate) { return accumulate == Accumulate::fixed64 ? 15 : 8; }

} // namespace lockstep::lights
