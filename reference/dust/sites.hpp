#pragma once
#include "reference/readings/site.hpp"

/// The places of the dust kernels' twins. What names a field is known to the shaders by that name.
namespace lockstep::dust::site {

// A grain, before and after.
inline constexpr Site before{"position before"}, speed{"velocity before"}, alive_before{"alive before"};
inline constexpr Site colour_before{"colour before"}, is_alive{"grain is alive"}, index{"grain's index"};
inline constexpr Site position{"position", "position", "m"}, velocity{"velocity", "velocity", "m/s"};
inline constexpr Site alive{"alive", "alive"}, colour{"colour", "colour"};

// Uniforms, by their names.
inline constexpr Site radius{"radius"}, dt{"deltaTime"}, time{"time"}, gravity{"gravity"};
inline constexpr Site air_resistance{"airResistance"}, mass{"mass"}, elasticity{"elasticity"};
inline constexpr Site spawn_min{"spawnBoundsMin"}, spawn_max{"spawnBoundsMax"};
inline constexpr Site world_min{"worldBoundsMin"}, world_max{"worldBoundsMax"};
inline constexpr Site controller_pos{"controllerPos"}, controller_forward{"controllerForward"};
inline constexpr Site controller_matrix{"controllerMatrix"};
inline constexpr Site cleaner_sqr_force{"cleanerSqrForce"}, cleaner_sqr_dist{"cleanerSqrDist"};
inline constexpr Site cleaner_threshold{"cleanerDotThreshold"}, cleaner_sqr_death{"cleanerSqrDeathRange"};
inline constexpr Site cleaner_force{"cleanerForce"};
inline constexpr Site emitter_force{"emitterForce"}, emitter_dist{"emitterDist"}, emitter_angle{"emitterAngleRad"};
inline constexpr Site emitter_tangent{"emitterTangent"};
inline constexpr Site blower_sqr_force{"blowerSqrForce"}, blower_sqr_dist{"blowerSqrDist"};
inline constexpr Site blower_threshold{"blowerDotThreshold"};
inline constexpr Site explosion_position{"explosionPosition"}, explosion_sqr_range{"explosionSqrRange"};
inline constexpr Site explosion_force{"explosionForce"}, impulse_dt{"impulseDeltaTime"};
inline constexpr Site colour_a{"dustColorA"}, colour_b{"dustColorB"};

// Remedies.
inline constexpr Site no_direction{"has no direction"}, starts_inside{"started in the sphere", {}, "m2"};
inline constexpr Site outward{"direction out"}, speed_outward{"speed outward"}, moves_inward{"moves inward"};

// Drawing.
inline constexpr Site corner_x{"corner's x"}, corner_y{"corner's y"}, corner_z{"corner's z"};
inline constexpr Site right{"cameraRight"}, up{"cameraUp"}, back{"cameraBack"}, scale{"scale"};
inline constexpr Site view_projection{"viewProjection"}, turned{"corner, turned"}, world_corner{"corner in the world"};
inline constexpr Site clip{"clip", "clip"}, tint{"tint", "tint"}, drawn{"drawn", "drawn"};
inline constexpr Site texel_place{"texel_place", "texel_place"};

// Random numbers.
inline constexpr Site phase{"sine's argument"}, octant{"sine's octant"}, sine{"sine"}, cosine{"cosine"};
inline constexpr Site below_zero{"sine's argument is negative"}, random{"random number"}, tangent{"tangent"};
inline constexpr Site stream{"stream of numbers"}, drawn_in{"drawn in frame"}, random_seed{"seed of the run"},
    triple{"three numbers"}, circle{"direction on the circle"};
inline constexpr Site seed{"seed"}, row{"row"}, step_of_row{"place in its row"}, shade{"colour's share"};
inline constexpr Site angle{"angle"}, share_of_radius{"share of the radius"}, chance{"chance"};
inline constexpr Site direction_of_table{"direction of the table"};

// The tool's cone.
inline constexpr Site to_mouth{"way to the mouth"}, from_mouth{"way from the mouth"};
inline constexpr Site sqr_dist{"squared distance"}, in_range{"in range", {}, "m2"};
inline constexpr Site to_mouth_unit{"direction to the mouth"}, from_mouth_unit{"direction from the mouth"};
inline constexpr Site along{"cosine to the axis"}, in_cone{"in the cone"};
inline constexpr Site force_along{"cosine in the force"}, impulse{"impulse"}, pulled{"velocity pulled"};
inline constexpr Site pull{"pull"}, force{"force"}, distance{"distance"}, acceleration{"acceleration"};
inline constexpr Site forecast{"forecast"}, mouth_to_forecast{"way from the mouth to the forecast"};
inline constexpr Site sqr_dist_next{"squared distance of the forecast"};
inline constexpr Site current_direction{"direction of the grain"}, next_direction{"direction of the forecast"};
inline constexpr Site current_along{"grain's cosine"}, next_along{"forecast's cosine"};
inline constexpr Site was_in_cone{"grain was in the cone"}, left_cone{"forecast is outside the cone"};
inline constexpr Site near_mouth{"forecast is in the death range", {}, "m2"}, behind{"forecast is behind the mouth"};
inline constexpr Site dies_at_once{"in the death range", {}, "m2"}, overshot{"beyond the mouth"};
inline constexpr Site share{"share of the way"}, too_short{"way is too short"}, length{"length of the way"};

// The emitter and blasts.
inline constexpr Site is_lucky{"comes back"}, local{"direction in the emitter"}, emitted{"direction emitted"};
inline constexpr Site blast{"blast"}, blast_direction{"direction of the blast"};

// Update.
inline constexpr Site asks_again{"deaths are asked for again"}, pulled_alone{"only pulled grains die"};
inline constexpr Site asks_where_it_was{"deaths are asked for where it was"}, in_halves{"colours are halves"};
inline constexpr Site sucked{"sucked velocity"}, fall{"velocity of the fall"}, next{"next position"};
inline constexpr Site drag{"drag"}, mover{"velocity that moves"}, way_of_frame{"way of the frame"};
inline constexpr Site movement{"movement"}, movement_unit{"direction of the movement"};
inline constexpr Site length_of_movement{"length of the movement"}, way_in{"way to the contact"};
inline constexpr Site contact{"contact"}, way_out{"share of the way out"}, mirrored{"mirrored movement"};
inline constexpr Site bounced{"velocity after a bounce"}, landed{"position after a bounce"};
inline constexpr Site spheres{"spheres"}, boxes{"boxes"};
inline constexpr Site sphere_centre{"sphere's centre"}, sphere_radius{"sphere's radius"};
inline constexpr Site touches_sphere{"touches the sphere", {}, "m2"}, closest{"nearest of the ray"};
inline constexpr Site missed{"squared distance of the ray"}, root{"half chord"}, grazes{"ray misses the sphere"};
inline constexpr Site crosses_sphere{"ray crosses the sphere"}, comes_to_contact{"movement comes to the contact"};
inline constexpr Site passes_up{"movement passes the face upwards"};
inline constexpr Site passes_down{"movement passes the face downwards"};
inline constexpr Site rest{"rest of the movement"}, to_centre{"way to the sphere's centre"};
inline constexpr Site sqr_way{"squared way to the sphere's centre"}, from_centre{"way from the sphere's centre"};
inline constexpr Site normal{"normal"}, into{"movement into the sphere"}, speed_into{"speed into the sphere"};
inline constexpr Site box_min{"box's least corner"}, box_max{"box's greatest corner"};
inline constexpr Site touches_box{"touches the box", {}, "m2"}, misses_box{"misses the box", {}, "m"};
inline constexpr Site box_scale{"box's sides"}, half_box{"half of the box's sides"}, box_centre{"box's centre"};
inline constexpr Site gap{"way to the box"}, sqr_gap{"squared distance to the box"};
inline constexpr Site sqr_radius{"radius squared"}, touch_margin{"margin of the touch"};
inline constexpr Site speed_before_box{"velocity before the box"}, answered{"position at the box"};
inline constexpr Site speed_answered{"velocity at the box"}, box_mirrored{"mirrored velocity"};
inline constexpr Site sphere_half{"sphere's own radius"}, reach{"reach of the sphere"};
inline constexpr Site closest_squared{"nearest of the ray squared"};
inline constexpr Site sphere_path_kept{"path kept by the sphere"}, sphere_speed_kept{"speed kept by the sphere"};
inline constexpr Site box_path_kept{"path kept by the box"}, box_speed_kept{"speed kept by the box"};
inline constexpr Site wall_path_kept{"path kept by the wall"}, wall_speed_kept{"speed kept by the wall"};
inline constexpr Site has_colliders{"colliders are looked at"}, has_world{"the world is looked at"};
inline constexpr Site has_spheres{"spheres are looked at"}, has_boxes{"boxes are looked at"};
inline constexpr Site one_hit{"one hit a frame"};
inline constexpr Site half_grain{"grain's radius in the box"};
inline constexpr Site world_to_local{"worldToLocal"}, local_to_world{"localToWorld"};
inline constexpr Site by_columns{"matrices are by columns"}, translation{"translation"};
inline constexpr Site next_in_box{"next position in the box"}, current_in_box{"position in the box"};
inline constexpr Site speed_in_box{"velocity in the box"};
inline constexpr Site heads_up{"moves up the axis"}, time_of_face{"share of the way to the face"};
inline constexpr Site face_x{"enters by an x face"}, face_y{"enters by a y face"}, face_z{"enters by a z face"};
inline constexpr Site on_face{"contact is on the face"};
inline constexpr Site upper_limit{"upper limit"}, lower_limit{"lower limit"};
inline constexpr Site upper_alone{"an upper wall alone answers"}, lower_alone{"a lower wall alone answers"};
inline constexpr Site above_wall{"beyond an upper wall", {}, "m"}, below_wall{"beyond a lower wall", {}, "m"};
inline constexpr Site wall_margin{"wall's margin"}, lower_margin{"lower walls' margin"};
inline constexpr Site upper_margin{"upper walls' margin"}, chord{"squared half of the chord"},
    above_floor{"above the floor", {}, "m"};
inline constexpr Site started_beyond{"started beyond the wall", {}, "m"}, to_wall{"way along the ray"};
inline constexpr Site below_floor{"below the floor", {}, "m"};

// The count.
inline constexpr Site living{"living grains"}, change{"change of the count"}, count{"count", "alive_number"};

} // namespace lockstep::dust::site
