#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/model/box.hpp"
#include "reference/model/collision/particles.hpp"

namespace lockstep {

/// How an emitter's particles lie in its box.
enum class EmitterShape {
    box,     ///< anywhere, evenly
    lattice, ///< on a grid that fills the box, x first, then z, then y; its spacing follows from box and count
    shell,   ///< in a hollow ball that touches the box's six sides (an ellipsoid if the box is no cube)
};

/// Where particles start and how they move then.
struct Emitter {
    EmitterShape shape = EmitterShape::box;
    Box box;
    std::size_t count = 0;
    float thickness = 0.05F;                ///< shell: of its wall, as a fraction of the radius, 0 to 1
    glm::vec3 direction{0.0F, -1.0F, 0.0F}; ///< any length above 0
    float direction_jitter = 0.0F;          ///< each component of the unit direction is off by up to this, 0 to 0.5
    float speed = 0.0F;                     ///< world units a second
    float speed_jitter = 0.0F;              ///< the speed is off by up to this fraction of it, 0 to 1
    float collide_time = 0.0F;              ///< seconds; below 0 they search from frame 0 on
};

/// The particles of all emitters, one emitter after the other. Particle i is the same for the same
/// emitters and seed on every platform and thread count: integers, and doubles with + - * / and square root only,
/// rounded to float once.
Particles emit(std::span<const Emitter> emitters, std::uint64_t seed);

/// Changes the counts so that they sum to `total` and keep their proportions. The counts must not all be 0.
void scale_counts(std::vector<Emitter>& emitters, std::size_t total);

/// Makes each box `factor` (> 0) times as long along the axis that its direction is closest to, and leaves the side in
/// front where it is: with counts scaled alike, as dense as before.
void scale_lengths(std::vector<Emitter>& emitters, float factor);

} // namespace lockstep
