#pragma once
#include <array>
#include <span>

#include "reference/model/collision/scene.hpp"

/// What a constant must have been for an item to come out as it did (FormulaMistake::fit). An item's words are
/// position, direction, speed and collide time.
namespace lockstep::formulas {

using Words = std::span<const float>;

std::array<float, 3> speed_of(Words before, Words after, const Constants& constants);
std::array<float, 3> gravity_of(Words before, Words after, const Constants& constants);
std::array<float, 3> counted_of(Words before, Words after, const Constants& constants);
std::array<float, 3> moved_for(Words before, Words after, const Constants& constants);
std::array<float, 3> collide_time_of(Words before, Words after, const Constants& constants);
std::array<float, 3> factor_of(Words before, Words after, const Constants& constants);
template <int axis> std::array<float, 3> plane_of(Words before, Words after, const Constants& constants);

} // namespace lockstep::formulas
