#pragma once
#include <optional>
#include <span>

#include "reference/model/dust/host.hpp"
#include "reference/readings/mistake.hpp"

namespace lockstep::dust {

/// What a host may hand the kernels instead of what is right: Mistake::part of Change::handed_over.
enum class Deviation {
    pose_late,            ///< the tool is where it was in the frame before
    angle_for_cosine,     ///< a cone's angle, not its cosine
    angle_for_tangent,    ///< the emitter's angle, not its tangent
    first_frame,          ///< its number is always 0
    impulses_of_frame,    ///< impulses last a frame
    spheres_padded,       ///< records of 144 bytes, as std430 lays a struct of two matrices and a vec3
    boxes_padded,         ///< likewise
    spheres_at_144_bytes, ///< the kernel takes records of 140 bytes to be of 144
    boxes_at_144_bytes,   ///< likewise
    spheres_at_140_bytes, ///< the kernel takes a sphere's four floats to be of 140 bytes
    boxes_unturned,       ///< in their places, but axis-aligned
    blast_at_the_tool     ///< not where the ball hit
};

inline Mistake handed_over(Deviation deviation) {
    return {.change = Change::handed_over, .part = static_cast<int>(deviation)};
}

/// A frame's values as a host hands them that makes these mistakes.
FrameValues handed(const Host& host, FrameValues values, std::span<const Mistake> made);

/// An explosion as it hands it over, of a frame's values; where it is null there is none.
std::optional<Explosion> handed_explosion(const Explosion* explosion, const FrameValues& values,
                                          std::span<const Mistake> made);

/// Its colliders; nothing where they are right.
std::optional<Colliders> handed_colliders(const Host& host, std::span<const Mistake> made);

} // namespace lockstep::dust
