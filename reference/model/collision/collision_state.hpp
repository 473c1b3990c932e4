#pragma once
#include "reference/model/collision/particles.hpp"
#include "reference/model/image.hpp"
#include "reference/model/schema.hpp"
#include "reference/model/state_view.hpp"

namespace lockstep {

/// The state of the collision system: particles, and the CDT that the next frame searches.
const Schema& collision_schema();

/// Places in it.
namespace collision {
inline constexpr std::uint8_t particles = 0;
inline constexpr std::uint8_t cdt = 1;
inline constexpr FieldId position{particles, 0};
inline constexpr FieldId direction{particles, 1};
inline constexpr FieldId speed{particles, 2};
inline constexpr FieldId collide_time{particles, 3};
inline constexpr FieldId texel{cdt, 0};
} // namespace collision

View view(const Particles& particles);
WritableView view(Particles& particles);
View view(const ParticleState& particle); ///< of one
WritableView view(ParticleState& particle);
View view(const CollisionImage& cdt);

} // namespace lockstep
