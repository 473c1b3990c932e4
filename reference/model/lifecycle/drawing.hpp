#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>

#include "reference/model/lifecycle/host.hpp"
#include "reference/model/system_state.hpp"

namespace lockstep::lifecycle {

/// What drawing starts from and makes: a quad a slot, a particle and, where it is a ribbon's point, the segment that
/// begins there; the corners of each, as the vertex stage puts them out; and the texture, where sprites have one.
const Schema& drawn_schema(const Host& host);

inline constexpr std::uint8_t quad_buffer = 0, corner_buffer = 1, texture_image = 2;

/// How many corners each has: of a sprite's polygon, or four of a segment. Those that one has too many are its last
/// again.
std::size_t corners_each(const Host& host);
/// Which corners make its triangles: a strip of a quad, a fan of a polygon.
std::vector<std::uint32_t> triangles_each(const Host& host);
/// Which of a segment's corners is the `corner`-th: 0 left, 1 right, 2 left and 3 right at the next point.
std::size_t segment_corner(const Host& host, std::size_t corner);

/// Where a quad has what it has besides its particle.
struct DrawnFields {
    FieldId kind;                                  ///< 0: nothing, 1: a sprite, 2: a segment
    FieldId left, right, next_left, next_right, u; ///< where there are ribbons
};
DrawnFields drawn_fields(const Switches& switches);

/// The quads of a state: of the living, and of segments where they have a next point.
SystemState quads_of(const Host& host, const SystemState& state);

/// The emitters in the order in which they are drawn: the opaque ones first.
std::vector<const HostEmitter*> drawing_order(const Host& host);

/// What the host hands the vertex stage. Made in double, rounded once.
struct Drawing {
    glm::mat4 view{1.0F}, projection{1.0F};
    float time = 0.0F; ///< of the frame, s
};
Drawing drawing(const Host& host, float aspect, int frame);

} // namespace lockstep::lifecycle
