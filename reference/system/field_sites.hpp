#pragma once
#include "reference/readings/site.hpp"

/// The places of what any twin may be made of: turns, noise and forces.
namespace lockstep::field_site {

inline constexpr Site turns{"turns"}, quarter{"quarter of the turn"}, circle{"radius on the sphere"};
inline constexpr Site centre{"centre of the force"}, axis{"axis"}, strength{"strength"}, reach{"radius of the force"};
inline constexpr Site pull{"pull"}, exponent{"falloff"}, softening{"softening"}, to_centre{"way to the centre"};
inline constexpr Site across{"way from the axis"}, along_axis{"along the axis"}, distance{"distance to the force"};
inline constexpr Site is_off_axis{"is off the axis"}, is_off_centre{"is off the centre"};
inline constexpr Site left_of_force{"force left"}, is_in_reach{"is in reach"};
inline constexpr Site swirl{"swirl"}, sink{"sink"}, attraction{"attraction"}, spread{"softened distance"};
inline constexpr Site noise_place{"place in the noise"}, frequency{"frequency"}, offset{"offset of the noise"};
inline constexpr Site is_in_noise{"is in the noise"}, cell{"cell"}, curl{"curl"}, noise{"noise"}, fade{"fade"};

} // namespace lockstep::field_site
