#pragma once
#include "reference/model/fluid/settings.hpp"
#include "reference/model/schema.hpp"
#include "reference/model/system_state.hpp"

namespace lockstep::fluid {

/// The state of a run with these switches: formats follow them. Lives as long as the program.
const Schema& schema(const Switches& switches);

/// A run's state before its first frame: the particles and the obstacles, all else 0. What the switches do not use has
/// one texel; without obstacles there is one triangle of no area.
SystemState start(const Settings& settings);

// In the order in which they are compared.
inline constexpr std::uint8_t particle_buffer = 0, scene_image = 1, scene_depth_image = 2, depth_image = 3,
                              smooth_depth_image = 4, normal_image = 5, thickness_image = 6, lit_image = 7,
                              encoded_image = 8, corner_buffer = 9;

namespace field {
inline constexpr FieldId position{particle_buffer, 0};
inline constexpr FieldId scene{scene_image, 0}, scene_depth{scene_depth_image, 0}, depth{depth_image, 0},
    smooth_depth{smooth_depth_image, 0}, normal{normal_image, 0}, thickness{thickness_image, 0}, lit{lit_image, 0},
    code{encoded_image, 0};
inline constexpr FieldId corner_position{corner_buffer, 0};
} // namespace field

} // namespace lockstep::fluid
