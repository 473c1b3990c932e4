#pragma once
#include "reference/system/field_sites.hpp"

/// The places of the lifecycle passes' twins. What names a field is known to the shaders by that name.
namespace lockstep::lifecycle::site {

using namespace field_site;

// A particle, before and after; in packed layouts the codes.
inline constexpr Site position_before{"position before"}, velocity_before{"velocity before"};
inline constexpr Site acceleration_before{"acceleration before"}, remaining_before{"remaining before"};
inline constexpr Site position{"position", "position"}, velocity{"velocity", "velocity", "1/s"};
inline constexpr Site acceleration{"acceleration", "acceleration", "1/s2"};
inline constexpr Site lifetime{"lifetime", "initial_lifetime", "s"}, remaining{"remaining", "remain_lifetime", "s"};
inline constexpr Site spawn_time{"spawn time", "spawn_time", "s"},
    spawn_order{"order in frame", "spawn_order_in_frame"};
inline constexpr Site initial_size{"initial size", "initial_size"}, end_size{"end size", "end_size"};
inline constexpr Site initial_color{"initial colour", "initial_color"}, end_color{"end colour", "end_color"};
inline constexpr Site initial_opacity{"initial opacity", "initial_opacity"}, end_opacity{"end opacity", "end_opacity"};
inline constexpr Site position_code{"code of position"}, velocity_code{"code of velocity"};
inline constexpr Site acceleration_code{"code of acceleration"}, lifetime_code{"code of lifetime"};
inline constexpr Site remaining_code{"code of remaining"}, spawn_code{"code of spawn time"};
inline constexpr Site size_code{"code of size"}, color_code{"code of colour"};
inline constexpr Site half_source{"number that becomes a half"}, half{"code of a half"}, half_read{"half read"};
inline constexpr Site color_steps{"steps of a channel"}, half_step{"half a step"};
inline constexpr Site previous_code{"code of distance from previous"}, start_code{"code of distance from start"};
inline constexpr Site box_low{"u_BoxLow"}, box_scale{"u_BoxScale"}, box_step{"u_BoxStep"}, in_box{"is in the box"};

// Uniforms, by their names.
inline constexpr Site tick{"u_Tick"}, time{"u_Time"}, half_tick_squared{"u_HalfTickSquared"};
inline constexpr Site shape_low{"u_ShapeLow"}, shape_size{"u_ShapeSize"}, radius{"u_Radius"};
inline constexpr Site origin{"u_Origin"}, origin_velocity{"u_OriginVelocity"}, last_origin{"u_LastOrigin"},
    direction{"u_Direction"}, side{"u_Side"};
inline constexpr Site up{"u_Up"}, jitter{"u_Jitter"}, speed{"u_Speed"}, speed_jitter{"u_SpeedJitter"};
inline constexpr Site cone_depth{"u_ConeDepth"}, born_acceleration{"u_Acceleration"};
inline constexpr Site shortest{"u_Lifetime.x"}, longest{"u_Lifetime.y"};
inline constexpr Site request{"u_Request"}, capacity{"u_Capacity"}, window{"u_Window"}, corners{"u_Corners"};

// Emission.
inline constexpr Site is_new{"is a newborn"}, fits{"there is room"}, serial{"serial of the newborn"};
inline constexpr Site emitted{"emitted", "emitted"}, channel{"random channel"};
inline constexpr Site random{"random numbers"}, shape_place{"place in the shape"}, share{"share of the path"};
inline constexpr Site place_of_emitter{"place of the emitter"}, direction_of_birth{"direction of birth"};
inline constexpr Site speed_of_birth{"speed of birth"}, share_of_life{"share of the lifetimes"};
inline constexpr Site long_enough{"longer than the shortest"}, too_long{"longer than the longest"};
inline constexpr Site channel_of_life{"channel of the lifetime"}, random_of_life{"random numbers of the lifetime"};
inline constexpr Site sizes{"sizes"};
inline constexpr Site ticks_of_life{"ticks of the lifetime"};

// Destruction and order.
inline constexpr Site alive_before{"alive before"}, may_die_before{"may die"}, survivors_before{"survivors before"};
inline constexpr Site survives{"survives", {}, "s"}, is_in_range{"may die by its place"}, overflows{"must make room"};
inline constexpr Site block_sum{"sum of the block", "sum"}, rank{"rank", "survivor"}, source{"source slot"};
inline constexpr Site listed{"slot in the list"}, buried{"buried", "buried"}, dead_slot{"slot of the dead"};
inline constexpr Site particles_present{"particles present"}, dead_rank{"rank of the dead"},
    is_dead{"is one of the dead"}, given_place{"place in the list of the dead"};
inline constexpr Site current_list{"list", "list"}, is_padding{"is padding"}, sorts_before{"sorts before"};
inline constexpr Site is_rising{"rises"}, key_time_compared{"time compared"}, key_order_compared{"order compared"},
    key_slot_compared{"slot compared"};
inline constexpr Site key_time{"time of the key"}, key_order{"order of the key"}, key_slot{"slot of the key"};
inline constexpr Site list_place{"place in the list"}, rest{"slot of the rest"}, present{"particles there"};
inline constexpr Site is_survivor{"is one of the survivors"}, is_present{"is there after the destruction"};

// Counters, by their names.
inline constexpr Site alive{"alive", "alive"}, may_die{"may_die", "may_die"}, survivors{"survivors", "survivors"};
inline constexpr Site append{"append", "append"}, died{"died", "died"}, serial_count{"serial", "serial"};
inline constexpr Site dropped{"dropped", "dropped"}, dropped_total{"dropped_total", "dropped_total"};
inline constexpr Site young{"young", "young"}, ring_head{"ring_head", "ring_head"}, ring{"emission", "emission"};
inline constexpr Site leaving{"emission that leaves the ring"}, clamped{"clamped", "clamped"};
inline constexpr Site killed{"killed", "killed"}, distance_origin{"distance_origin", "distance_origin"};
inline constexpr Site destroy_groups{"destroy", "destroy"}, move_groups{"move", "move"};
inline constexpr Site simulate_groups{"simulate", "simulate"}, ribbon_groups{"ribbon", "ribbon"};
inline constexpr Site draw_sprite{"draw_sprite", "draw_sprite"}, draw_ribbon{"draw_ribbon", "draw_ribbon"};
inline constexpr Site draw_instances{"instances"}, draw_segments{"segments"};

// Simulation.
inline constexpr Site force{"force"}, faster{"velocity after the forces"}, braked{"velocity after drag"};
inline constexpr Site drag{"drag"}, drag_coefficient{"coefficient of drag"}, drag_factor{"factor of drag"},
    way{"way of the frame"}, drift{"drift"};
inline constexpr Site moving_velocity{"velocity that moves"}, aged{"tick of the age"}, not_below_zero{"has time left"};
inline constexpr Site is_killed{"is killed"};

// Ribbons.
inline constexpr Site is_point{"is a point of the ribbon"}, between_points{"way between points"};
inline constexpr Site way_to_point{"distance from previous", "distance_from_previous"};
inline constexpr Site way_from_start{"distance from start", "distance_from_start"};
inline constexpr Site units{"units of the distance"}, length_sum{"sum of distances"};
inline constexpr Site way_of_dead{"length of the dead"}, view{"u_View"}, seen_point{"point seen"};
inline constexpr Site segment_before{"segment before"}, segment_after{"segment after"}, tangent{"tangent"};
inline constexpr Site side_of_ribbon{"side of the ribbon"}, half_width{"half width"}, mitre{"mitre"};
inline constexpr Site is_mitred{"is mitred"}, left{"left", "left"}, right{"right", "right"};
inline constexpr Site uv_scale{"u_UvScale"}, first_u{"u at the start"}, last_u{"u at the end"};
inline constexpr Site has_length{"has a length"}, has_unit{"has a direction"}, unit{"direction"};
inline constexpr Site projection{"u_Projection"}, seen_corner{"corner seen"}, is_visible{"is not expired"};
inline constexpr Site clip{"clip", "clip"}, tint{"tint", "tint"}, drawn{"drawn", "drawn"};
inline constexpr Site corner_of_sprite{"corner of the sprite"};
inline constexpr Site texel_place{"texel_place", "texel_place"};
inline constexpr Site has_life{"has a lifetime"}, age{"age"}, size{"size"}, stretched{"share of the ribbon"};

} // namespace lockstep::lifecycle::site
