#pragma once
#include "reference/readings/site.hpp"
#include "reference/system/drawn_triangles.hpp"
#include "reference/system/encode_twin.hpp"

/// The places of the lights passes' twins. What names a field is known to the shaders by that name.
namespace lockstep::lights::site {

// A light, before and after its step.
inline constexpr Site before{"position before"}, way{"direction before"}, speed_before{"speed before"},
    colour_before{"colour before"}, range_before{"range before"}, inv_range2{"inv_range2"};
inline constexpr Site position{"position", "position", "m"}, direction{"direction", "direction"};
inline constexpr Site tick{"u_Tick"}, low{"u_GridOrigin"}, high{"u_GridEnd"}, step{"step"}, moved{"moved"};
inline constexpr Site below{"below the grid", {}, "m"}, above{"above the grid", {}, "m"}, turned{"direction turned"},
    wall_low{"lower wall"}, wall_high{"upper wall"}, mirrored_low{"mirrored at the lower wall"},
    mirrored_high{"mirrored at the upper wall"}, still_below{"still below", {}, "m"},
    still_above{"still above", {}, "m"}, moves{"lights move"};

// One light at a voxel.
inline constexpr Site voxel_x{"voxel's x"}, voxel_y{"voxel's y"}, voxel_z{"voxel's z"}, voxel_index{"voxel's index"},
    voxel_point{"voxel's point"}, offset{"voxel's offset"}, voxel_size{"u_VoxelSize"};
inline constexpr Site to_light{"way to the light"}, squared{"squared distance"}, in_range{"in range", {}, "m2"},
    range2{"squared range"}, ratio{"squared share of the range"}, falloff{"falloff"}, denominator{"1 m2 more"},
    attenuation{"attenuation"}, distance{"distance"}, inverse{"inverse distance"}, unit{"unit direction"},
    on_the_point{"on the voxel's point"}, point_counts{"a light on the voxel's point counts"},
    weight{"weight of the direction"}, light_colour{"colour at the voxel"}, light_direction{"direction at the voxel"},
    own_voxel{"in its own voxel"}, by_own_voxel{"own voxel only"};

// The accumulator.
inline constexpr Site carries{"carries"}, borrows{"negative sums borrow"}, fixed_scale{"u_FixedScale"},
    always_carries{"a carry without need"}, rounds_down{"negative addends are rounded down"}, word{"accumulator"},
    is_cleared{"is cleared"}, cleared{"cleared word"}, all_lights{"lights"}, by_cell{"lights by cell"},
    adds{"addends are added"}, greatest{"the greatest addend"}, goes_on{"goes on behind a light that does not reach"},
    own_place{"stored in its own place"}, sum{"sum"}, count{"count"}, one_more{"added to the count"},
    units{"addend in units"}, quantum{"addend on the grid of sums"}, half_unit{"half a unit"};
inline constexpr Site channel{"channel"}, is_stacked{"channels lie behind each other"}, own_sums{"sums of its own"},
    high_word{"high word"}, low_word{"low word"}, low_first{"the low word first"}, low_is_cut{"the low word is cut"},
    count_word{"a word of its own for the count"}, volume_colour{"light_color", "light_color"},
    volume_direction{"light_direction", "light_direction"}, red{"red"}, green{"green"}, blue{"blue"}, sum_x{"x sum"},
    sum_y{"y sum"}, sum_z{"z sum"}, sum_weight{"weight sum"};

// Cells.
inline constexpr Site cell{"cell"}, cell_start{"cell_start"}, cell_count{"cell_count"},
    row_end{"lights up to the row's end"}, sorted{"light"};

// Surfaces.
using namespace triangle_site;
inline constexpr Site eye{"u_Eye"}, normal_sum{"cross product"}, normal_length{"length of the cross product"},
    faces_away{"faces away"}, surface_normal{"surface normal"}, albedo{"albedo"},
    depth{"surface_depth", "surface_depth"}, stored_position{"surface_position", "surface_position"},
    stored_normal{"surface_normal", "surface_normal"}, valid{"valid"}, is_valid{"is valid"},
    own_value{"the value of its own"}, from_origin{"from the world's origin"}, background{"background"};

// Sampling.
inline constexpr Site grid_place{"place in the grid"}, inv_voxel{"u_InvVoxelSize"}, interpolates{"interpolates"},
    sample_offset{"offset of a sample"}, sample_place{"place of a sample"}, sample_mean{"1 / samples"},
    nearest_place{"place whose texel is taken"}, half_texel{"half a texel"},
    half_texel_of_four{"half a texel, before four"}, own_colour{"colours of their own texture"},
    own_direction{"directions of their own texture"}, texel_place{"place among texels"}, base{"base texel"},
    first_texel{"first texel of four"}, fraction{"fraction"}, fraction8{"fraction of 8 bits"}, fractions{"fractions"},
    in_grid{"in the grid"}, texel_x{"texel's x"}, texel_y{"texel's y"}, texel_z{"texel's z"}, texel{"texel"},
    sampled_colour{"sampled colour"}, sampled_direction{"sampled direction"}, sampled_count{"sampled count"},
    sampled_weight{"sampled weight"}, weighed{"fraction of four weights"}, weight_before{"weight of the texel before"},
    weights{"four weights"}, filtered{"filtered"}, not_below{"colour below 0"};

// Lighting.
inline constexpr Site length2{"squared length of the direction"}, no_direction{"has no direction"},
    direction_length{"length of the direction"}, to_lights{"direction to the lights"}, cosine{"cosine"},
    lambert{"lambert"}, faces_light{"faces the light"}, directionality{"directionality"}, diffuse{"diffuse"},
    ambient{"u_Ambient"}, radiance{"radiance"}, lit{"lit", "lit"}, is_one{"directionality above 1"},
    even_share{"share of even light"}, same_row{"reads its own row"};

// Glow.
inline constexpr Site glow_lights{"glowing lights"}, glow_w{"w of the light"}, before_camera{"light before the camera"},
    glow_depth{"depth of the light"}, glow_nearer{"light nearer"}, stored_depth{"stored depth"}, glow_x{"window x"},
    glow_y{"window y"}, glow_radius{"radius in pixels"}, centre_x{"pixel centre x"}, centre_y{"pixel centre y"},
    disc_scale{"u_DiscScale"}, disc_x{"disc x"}, disc_y{"disc y"}, disc{"squared distance on the disc"},
    on_disc{"on the disc"}, glow_gain{"u_GlowGain"}, glow_share{"share of the glow"}, glow_colour{"colour of the glow"},
    lit_before{"lit before"}, blends{"blends"}, keeps_alpha{"keeps alpha"}, glow_in_planes{"light between the planes"};

using namespace encode_site;

} // namespace lockstep::lights::site
