#pragma once
#include "reference/readings/site.hpp"

/// The sites of the collision step (collision_twin.hpp), in the order of the listing.
namespace lockstep::site {

// The state before, and the scene's constants.
inline constexpr Site position_before{"position before"};
inline constexpr Site direction_before{"direction before"};
inline constexpr Site speed_before{"speed before"};
inline constexpr Site collide_time_before{"collide time before"};
inline constexpr Site proj_view{"u_ProjView"};
inline constexpr Site client_size{"u_ClientWidth, u_ClientHeight"};
inline constexpr Site half{"half"};
inline constexpr Site texel_collide_range{"u_TexelCollideRange"};
inline constexpr Site collision_range{"u_CollisionRange"};
inline constexpr Site collision_time{"u_CollisionTime"};
inline constexpr Site speed_factor{"u_SpeedFactor"};
inline constexpr Site tick{"u_Tick"};
inline constexpr Site gravity{"u_Gravity"};
inline constexpr Site box_low{"u_CdtBoxMin"};
inline constexpr Site box_step{"u_CdtBoxStep"};

// Lines 2 to 4.
inline constexpr Site clip{"clip", "trace_clip"};
inline constexpr Site perspective_divide{"perspective divide"};
inline constexpr Site ndc{"clip / w", "trace_ndc"};
inline constexpr Site not_divided{"not divided", "trace_ndc"};
inline constexpr Site texture_coordinate{"texture coordinate", "trace_texture_coordinate"};
inline constexpr Site scale{"scale"};
inline constexpr Site image_position{"image position", "trace_image_position"};
inline constexpr Site base_by_floor{"base texel by floor"};
inline constexpr Site base_texel{"base texel", "trace_base_texel", "/256 texel", 256.0};

// Lines 5 to 19.
inline constexpr Site searches{"search", "trace_searches", "s"};
inline constexpr Site stands{"stands where it does not search"};
inline constexpr Site own_from_texel{"own position from texel"};
inline constexpr Site own_texel{"own texel"};
inline constexpr Site own_position{"own position", "trace_own_position"};
inline constexpr Site rows{"rows"};
inline constexpr Site columns{"columns"};
inline constexpr Site own_texel_skipped{"own texel skipped"};
inline constexpr Site neighbour{"neighbour", "trace_neighbour_texel"};
inline constexpr Site phantom{"empty texel is a particle"};
inline constexpr Site holds_particle{"holds a particle"};
inline constexpr Site stored{"stored code"};
inline constexpr Site scaled_to_box{"scaled to the box"};
inline constexpr Site stored_position{"stored position", "trace_neighbour_position"};
inline constexpr Site apart{"apart", "trace_neighbour_apart"};
inline constexpr Site distance{"distance", "trace_neighbour_distance"};
inline constexpr Site zero_distance_hits{"distance 0 is a hit"};
inline constexpr Site in_range{"collision range", {}, "world units"};
inline constexpr Site nearest{"nearest", "trace_neighbour_reached", "world units"};

// Lines 21 to 24.
inline constexpr Site away{"away", "trace_away"};
inline constexpr Site speed_at_hit{"speed at hit", "v_Speed"};
inline constexpr Site direction_at_hit{"direction at hit", "v_Dir"};
inline constexpr Site collide_time_at_hit{"collide time at hit", "v_CollideTime"};
inline constexpr Site moves_along{"moves along at hit"};
inline constexpr Site moves_by{"moves by at hit"};
inline constexpr Site step_by_tick{"tick in collision step"};
inline constexpr Site position_at_hit{"position at hit", "v_Position"};

// Lines 26 to 30.
inline constexpr Site fall{"fall"};
inline constexpr Site velocity_before{"velocity before"};
inline constexpr Site velocity{"velocity", "trace_velocity"};
inline constexpr Site direction{"direction", "v_Dir"};
inline constexpr Site speed{"speed", "v_Speed"};
inline constexpr Site counted{"counted"};
inline constexpr Site collide_time{"collide time", "v_CollideTime"};
inline constexpr Site step{"step"};
inline constexpr Site move{"move"};
inline constexpr Site position{"position", "v_Position"};

// Of a particle that does not search, where not_searching = stands.
inline constexpr Site position_kept{"position kept", "v_Position"};
inline constexpr Site direction_kept{"direction kept", "v_Dir"};
inline constexpr Site speed_kept{"speed kept", "v_Speed"};
inline constexpr Site collide_time_kept{"collide time kept", "v_CollideTime"};

} // namespace lockstep::site
