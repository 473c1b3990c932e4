#pragma once
#include "reference/readings/site.hpp"
#include "reference/system/drawn_triangles.hpp"
#include "reference/system/encode_twin.hpp"

/// The places of the fluid passes' twins. What names a field is known to the shaders by that name.
namespace lockstep::fluid::site {

using namespace triangle_site;
using namespace encode_site;

// Particles.
inline constexpr Site handed{"position of the frame", {}, "m"}, position{"position", "position", "m"},
    before{"position before", {}, "m"}, view{"mView"}, centre{"centre in view space", {}, "m"},
    w{"distance along the view", {}, "m"}, near{"u_Near"}, beyond_near{"beyond the near plane", {}, "m"},
    middle_in_volume{"middle in the view volume"}, radius{"pointRadius", {}, "m"}, point_scale{"pointScale"},
    sprite_scale{"scale times radius"}, distance{"distance", {}, "m"}, size{"sprite's size", {}, "pixel"},
    drawn_size{"point's size", {}, "pixel"}, half{"half of the sprite", {}, "pixel"}, p00{"P00"}, p11{"P11"},
    width{"width"}, height{"height"}, place_x{"place x"}, place_y{"place y"}, window_x{"window x", {}, "pixel"},
    window_y{"window y", {}, "pixel"}, pixel_x{"pixel centre x", {}, "pixel"}, pixel_y{"pixel centre y", {}, "pixel"},
    nx{"nx"}, ny{"ny"}, magnitude{"squared distance on the disc"}, off_disc{"off the disc"}, nz{"nz"},
    rise{"surface before the middle", {}, "m"}, surface_z{"z of the surface", {}, "m"},
    view_moves{"view's translation is taken"}, sized_by_w{"size is by the distance along the view"};
inline constexpr Site unit_slope_x{"u_Slope.x"}, unit_slope_y{"u_Slope.y"}, slope_x{"slope x"}, slope_y{"slope y"},
    ray_squared{"d.d"}, ray_centre{"d.c"}, along{"middle of the ray"}, to_ray{"way from the ray to the centre"},
    chord{"squared half chord"}, off_sphere{"off the sphere"}, chord_by_ray{"squared half chord over d.d"},
    half_chord{"half chord"}, ray_of_centre{"rays are of pixels' centres"};

// Depth.
inline constexpr Site depth_coefficients{"u_DepthCoefficients"}, clip_z{"clip z"}, ndc{"ndc"}, window{"window depth"},
    clamped{"clamped depth"}, codes{"u_DepthCodes"}, half_code{"half a code"}, depth_code{"code of the depth"},
    depth_scale{"u_DepthScale"}, tested{"depth that is tested"}, in_front_of_eye{"in front of the eye", {}, "m"},
    nearer_than_scene{"nearer than the scene"}, tests_scene{"scene is tested"}, scene_depth_in{"scene's depth"},
    nearest_sphere{"nearest sphere"}, sphere_here{"sphere at the pixel"}, sphere_depth{"depth of a sphere"},
    depth{"depth", "depth"}, unprojected{"unprojected depth", {}, "m"}, decoded{"decoded depth", {}, "m"},
    reads_ndc{"stored is taken for ndc"}, window_is_ndc{"window depth is taken for ndc"},
    has_codes{"depth is rounded to codes"}, scene_tests_surface{"scene is held against the surface"},
    nearest_is_of_surface{"nearest is of the surface"}, ends_at_edge{"image ends with its edge"},
    reads_filtered{"filtered depth is read"}, decodes{"depth is decoded"};

// Scene.
inline constexpr Site tile{"tile of the floor"}, check{"share of the check"}, scene{"scene", "scene"},
    surface_depth{"depth of the surface"}, scene_depth{"scene_depth", "scene_depth"}, sky_colour{"u_SceneSky"};

// Filters.
inline constexpr Site blur_direction{"blurDir"}, centre_depth{"depth at the pixel"}, sample{"sample"},
    empty{"is empty"}, centre_empty{"pixel is empty"}, is_black{"stored 0"}, samples{"samples"},
    rows{"rows of samples"}, weight{"weight"}, row_weight{"weight of the row"}, exponent{"exponent"},
    in_exponent{"exponent within reach"}, blur_scale{"blurScale"}, range_scale{"u_RangeScale"},
    range_step{"step to the sample"}, range_weight{"range weight"}, weighted_sum{"weighted sum"},
    sum_of_weights{"sum of weights"}, mean{"mean"}, skips_empty{"empty samples are skipped"},
    reads_spheres{"depth of the spheres is read"}, takes_centre{"pixel itself is taken"},
    range_is_squared{"range step is squared"}, range_in_sum{"sum has the range weights"},
    range_in_weights{"weights have the range weights"}, sum_from_0{"sum begins with 0"},
    weights_from_0{"weights begin with 0"}, empty_weighs{"empty samples weigh"},
    smooth_depth{"smooth_depth", "smooth_depth"};
inline constexpr Site narrow_scale{"u_NarrowScale"}, reach{"reach", {}, "pixel"}, most_reach{"most pixels"},
    delta{"u_NarrowDelta", {}, "m"}, mu{"u_NarrowMu", {}, "m"}, high{"high", {}, "m"}, low{"low", {}, "m"},
    widens_high{"range is widened forwards"}, widens_low{"range is widened backwards"}, too_near{"too near", {}, "m"},
    too_far{"too far", {}, "m"}, clamped_sample{"sample drawn in", {}, "m"}, partner_weight{"partner's weight"},
    own_weight{"refused sample's weight"}, screen_width{"screenSize.x"}, weighs_rows{"rows weigh"},
    reach_is_ceiling{"reach is rounded up"}, refuses_near{"near samples are refused"},
    drawn_to_centre{"samples are drawn in to the pixel"}, range_is_kept{"range keeps what widened it"},
    near_is_refused{"near samples count for nothing"}, far_is_kept{"far samples count"},
    two_ranges{"each side has its range"}, empty_is_far{"empty samples are far ones"},
    judges_from_first{"samples are judged from the first"}, columns_first{"columns come first"};
inline constexpr Site flow_scale_x{"Cx"}, flow_scale_y{"Cy"}, flow_step{"u_FlowStep"},
    flow_reach{"u_FlowReach", {}, "m"}, within_reach{"neighbour within reach", {}, "m"}, zx{"zx"}, zy{"zy"}, zxx{"zxx"},
    zyy{"zyy"}, zxy{"zxy"}, takes_middle_twice{"middle is taken twice"}, slopes_of_two{"slopes are over two pixels"},
    reach_is_two_way{"reach is to both sides"}, needs_both_sides{"derivatives need all neighbours"}, e0{"E0"},
    e0_root{"root of E0"}, fx{"Fx"}, fy{"Fy"}, ex{"Ex"}, ey{"Ey"}, curvature{"mean curvature"};

// Normals.
inline constexpr Site point{"point", {}, "m"}, neighbour_empty{"neighbour is empty"}, right_side{"right side taken"},
    upper_side{"upper side taken"}, faces_at_edges{"facing where no side is"}, step_left{"step from the left", {}, "m"},
    step_up{"step from below", {}, "m"}, step_right{"step to the right", {}, "m"}, step_above{"step upwards", {}, "m"},
    picks_nearer{"nearer side is taken"}, right_is_right{"right neighbour is on the right"},
    left_is_left{"left neighbour is on the left"}, upper_is_above{"upper neighbour is above"},
    lower_is_below{"lower neighbour is below"}, step_x{"step along x", {}, "m"}, step_y{"step along y", {}, "m"},
    one_sided{"steps are to one side"}, on_own_ray{"neighbour is on its own ray"}, cross{"cross product"},
    has_no_length{"cross product is 0"}, normal{"normal", "normal"}, facing{"facing normal"};

// Thickness.
inline constexpr Site is_cleared{"is cleared"}, gain{"u_ThicknessGain"}, addend{"thickness of a sphere", {}, "m"},
    units{"65536"}, half_unit{"half a unit"}, quantum{"units of 2^-16"}, takes_last_sphere{"last sphere is taken"},
    adds_all{"spheres are added up"}, thickness{"thickness", "thickness"};

// Shading.
inline constexpr Site to_eye{"direction to the eye"}, halfway_by_sum{"halfway is a sum"},
    bend_rises{"high water bends"}, tint{"colour without light"}, half_light{"light from all around"},
    inverse_view{"u_InverseView"}, up_row{"y of u_InverseView"}, world{"world point", {}, "m"},
    light{"direction to the light"}, halfway{"halfway vector"}, shine{"N.h"}, specular{"specular"},
    share{"share of a step"}, bend_of{"bend"}, offset{"offset of the refracted scene"},
    fetch_x{"refracted x", {}, "pixel"}, fetch_y{"refracted y", {}, "pixel"}, base{"base texel"}, fraction{"fraction"},
    scene_texel{"scene texel"}, filtered{"filtered"}, seen{"scene seen through"},
    thickness_in{"thickness at the pixel", {}, "m"}, floor_of_thickness{"u_ThicknessFloor", {}, "m"},
    dark{"thickness that darkens", {}, "m"}, colour{"color"}, alpha{"color.a"}, absorbed{"absorbed"},
    transmission{"transmission"}, refracted{"refracted"}, down{"direction down"}, spot{"spot"}, lambert{"l.N"},
    wrapped{"wrapped light"}, scattered{"1 - color.a"}, diffuse{"diffuse"}, cosine{"N.V"}, r0{"u_FresnelR0"},
    grazing{"1 - N.V"}, raised{"(1 - N.V)^p"}, fresnel{"fresnel"}, mirrors_to_eye{"mirror of the direction to the eye"},
    incident{"incident direction"}, along_normal{"2 N.I"}, mirrored{"mirrored direction"},
    mirror_y{"height of the mirrored direction"}, sky_share{"share of the sky"}, sky_bias{"u_SkyBias"}, sky{"sky"},
    surface{"mirror and refraction"}, normal_in{"normal at the pixel"}, background{"scene at the pixel"},
    normal_is_of_view{"normal is taken in view space"}, step_is_smooth{"steps are smooth"},
    texels_have_middles{"texels are taken at their middles"}, surface_light{"light of the surface"},
    light_to_eye{"light to the eye"}, lit{"lit", "lit"};

} // namespace lockstep::fluid::site
