#pragma once
#include <array>
#include <cstdint>

#include <glm/mat4x4.hpp>

#include "reference/model/lifecycle/host.hpp"
#include "reference/model/system_state.hpp"

namespace lockstep::lifecycle {

/// What drawing starts from and makes: a quad a slot, a particle and, where it is a ribbon's point, the segment that
/// begins there; and the four corners of each, as the vertex stage puts them out.
const Schema& drawn_schema(const Switches& switches);

inline constexpr std::uint8_t quad_buffer = 0, corner_buffer = 1;
inline constexpr std::array<std::uint32_t, 6> quad_triangles{0, 1, 2, 2, 1, 3};

/// Where a quad has what it has besides its particle.
struct DrawnFields {
    FieldId kind; ///< 0: nothing, 1: a sprite, 2: a segment
    FieldId left, right, next_left, next_right, u;
};
DrawnFields drawn_fields(const Switches& switches);

/// The quads of a state: of the living, and of segments where they have a next point.
SystemState quads_of(const Host& host, const SystemState& state);

/// What the host hands the vertex stage. Made in double, rounded once.
struct Drawing {
    glm::mat4 view{1.0F}, projection{1.0F};
    float time = 0.0F; ///< of the frame, s
};
Drawing drawing(const Host& host, float aspect, int frame);

} // namespace lockstep::lifecycle
