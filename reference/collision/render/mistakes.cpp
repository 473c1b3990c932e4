#include "reference/collision/render/mistakes.hpp"

#include <array>
#include <utility>

#include <glm/matrix.hpp>

#include "reference/collision/render/drawing.hpp"
#include "reference/plain_arithmetic.hpp"
#include "reference/subnormals.hpp"

namespace lockstep {
namespace {

constexpr std::array mistake_infos = [] {
    using enum RenderMistake;
    return std::array{
        RenderMistakeInfo{frame_not_drawn, "frame_not_drawn", "nothing is drawn, nor a background"},
        RenderMistakeInfo{sprites_not_drawn, "sprites_not_drawn", "no particle is drawn"},
        RenderMistakeInfo{obstacles_not_drawn, "obstacles_not_drawn", "no obstacle is drawn"},
        RenderMistakeInfo{background_not_drawn, "background_not_drawn", "no background is drawn"},
        RenderMistakeInfo{only_background_drawn, "only_background_drawn", "neither particles nor obstacles are drawn"},
        RenderMistakeInfo{sprites_half_size, "sprites_half_size", "squares and spheres of half the radius"},
        RenderMistakeInfo{sprites_twice_size, "sprites_twice_size", "squares and spheres of twice the radius"},
        RenderMistakeInfo{quads_half_size, "quads_half_size", "a sphere of full size on a square of half the size"},
        RenderMistakeInfo{sphere_twice_size, "sphere_twice_size",
                          "a sphere of twice the size on a square of full size"},
        RenderMistakeInfo{radius_in_clip_space, "radius_in_clip_space",
                          "the radius is added in clip space, without the projection's scale"},
        RenderMistakeInfo{radius_in_ndc, "radius_in_ndc",
                          "the radius is added in normalised device coordinates, whatever the distance"},
        RenderMistakeInfo{square_on_centre, "square_on_centre",
                          "a particle's square stands on its centre, not around it"},
        RenderMistakeInfo{square_below_centre, "square_below_centre", "a particle's square hangs from its centre"},
        RenderMistakeInfo{square_right_of_centre, "square_right_of_centre",
                          "a particle's square begins at its centre, to the right"},
        RenderMistakeInfo{square_left_of_centre, "square_left_of_centre",
                          "a particle's square ends at its centre, to the left"},
        RenderMistakeInfo{radius_halved, "radius_halved", "u_BillboardRadius is halved"},
        RenderMistakeInfo{radius_doubled, "radius_doubled", "u_BillboardRadius is doubled"},
        RenderMistakeInfo{sprites_square, "sprites_square", "fragments outside the disc are kept"},
        RenderMistakeInfo{sprites_square_and_flat, "sprites_square_and_flat",
                          "fragments outside the disc are kept, with a normal of z = 0"},
        RenderMistakeInfo{y_flipped, "y_flipped", "the image is upside down"},
        RenderMistakeInfo{x_flipped, "x_flipped", "left and right are swapped"},
        RenderMistakeInfo{x_and_y_swapped, "x_and_y_swapped", "rows and columns are swapped"},
        RenderMistakeInfo{depth_not_tested, "depth_not_tested", "no depth test: what is drawn last stays"},
        RenderMistakeInfo{depth_reversed, "depth_reversed", "depth test GREATER, from 0: the farthest stays"},
        RenderMistakeInfo{depth_equal_passes, "depth_equal_passes", "depth test LEQUAL"},
        RenderMistakeInfo{sphere_is_flat_in_depth, "sphere_is_flat_in_depth", "the depth is the centre's"},
        RenderMistakeInfo{sphere_reversed_in_depth, "sphere_reversed_in_depth", "the depth is the sphere's far side's"},
        RenderMistakeInfo{normal_flipped, "normal_flipped", "the sphere's normal points inwards"},
        RenderMistakeInfo{normal_x_flipped, "normal_x_flipped", "the sphere's normal has -x"},
        RenderMistakeInfo{normal_y_flipped, "normal_y_flipped", "the sphere's normal has -y"},
        RenderMistakeInfo{normal_z_flipped, "normal_z_flipped", "the sphere's normal has -z"},
        RenderMistakeInfo{normal_x_and_y_swapped, "normal_x_and_y_swapped",
                          "x and y of the sphere's normal are swapped"},
        RenderMistakeInfo{half_pixel_off, "half_pixel_off", "the sphere is half a pixel off: no + 0.5 at the fragment"},
        RenderMistakeInfo{half_pixel_further, "half_pixel_further",
                          "the sphere is half a pixel off: 0.5 twice at the fragment"},
        RenderMistakeInfo{disc_half_size, "disc_half_size", "fragments beyond half the radius are dropped"},
        RenderMistakeInfo{disc_of_half_area, "disc_of_half_area", "fragments beyond x x + y y = 0.5 are dropped"},
        RenderMistakeInfo{sphere_root_left_out, "sphere_root_left_out",
                          "the sphere's z is 1 - x x - y y, without the root"},
        RenderMistakeInfo{sphere_z_is_one, "sphere_z_is_one", "the sphere's z is 1 everywhere"},
        RenderMistakeInfo{sphere_depth_by_diameter, "sphere_depth_by_diameter",
                          "the depth is that of a sphere of twice the radius"},
        RenderMistakeInfo{sphere_depth_without_radius, "sphere_depth_without_radius",
                          "the depth is that of a sphere of radius 1"},
        RenderMistakeInfo{sprite_depth_not_halved, "sprite_depth_not_halved",
                          "a particle's depth is NDC's, not 0.5 z + 0.5"},
        RenderMistakeInfo{sprite_depth_zero, "sprite_depth_zero", "a particle's depth is 0"},
        RenderMistakeInfo{colour_swapped, "colour_swapped", "red and blue are swapped"},
        RenderMistakeInfo{sprite_colour_swapped, "sprite_colour_swapped", "red and blue of particles are swapped"},
        RenderMistakeInfo{sprite_red_and_green_swapped, "sprite_red_and_green_swapped",
                          "red and green of particles are swapped"},
        RenderMistakeInfo{sprite_green_and_blue_swapped, "sprite_green_and_blue_swapped",
                          "green and blue of particles are swapped"},
        RenderMistakeInfo{sprite_colours_squared, "sprite_colours_squared", "particles' colours are squared"},
        RenderMistakeInfo{sprite_colours_rooted, "sprite_colours_rooted",
                          "the square root of particles' colours is stored"},
        RenderMistakeInfo{codes_truncated, "codes_truncated", "colours are rounded down, not to nearest"},
        RenderMistakeInfo{codes_of_256, "codes_of_256", "colours are 256 times the share, rounded down"},
        RenderMistakeInfo{alpha_missing, "alpha_missing", "stores alpha 0"},
        RenderMistakeInfo{sprite_alpha_missing, "sprite_alpha_missing", "particles store alpha 0"},
        RenderMistakeInfo{colour_of_speed_missing, "colour_of_speed_missing", "every particle has the colour of rest"},
        RenderMistakeInfo{colour_of_collision_missing, "colour_of_collision_missing", "no particle has just collided"},
        RenderMistakeInfo{speed_not_halved, "speed_not_halved", "white at a speed of 1, not 2"},
        RenderMistakeInfo{speed_quartered, "speed_quartered", "white at a speed of 4, not 2"},
        RenderMistakeInfo{speed_doubled, "speed_doubled", "white at a speed of 0.5, not 2"},
        RenderMistakeInfo{speed_colours_swapped, "speed_colours_swapped", "slow is white, and fast is blue"},
        RenderMistakeInfo{heat_not_divided, "heat_not_divided", "the collide time is not divided by u_CollisionTime"},
        RenderMistakeInfo{heat_divided_twice, "heat_divided_twice",
                          "the glow is the collide time over the collision time, twice"},
        RenderMistakeInfo{heat_reversed, "heat_reversed", "what has collided glows more and more"},
        RenderMistakeInfo{heat_whole, "heat_whole", "what has collided glows in full while its collide time runs"},
        RenderMistakeInfo{sphere_unlit, "sphere_unlit", "a sphere is as bright everywhere as where it faces the light"},
        RenderMistakeInfo{sphere_lit_from_behind_too, "sphere_lit_from_behind_too",
                          "a sphere's side away from the light is as bright as the one towards it"},
        RenderMistakeInfo{sphere_lambert_wrapped, "sphere_lambert_wrapped",
                          "a sphere's light is 0.5 + 0.5 n . l, not n . l"},
        RenderMistakeInfo{sphere_ambient_missing, "sphere_ambient_missing",
                          "a sphere's side away from the light is black"},
        RenderMistakeInfo{sphere_ambient_added, "sphere_ambient_added",
                          "a particle's light is ambient plus lambert, not their mix"},
        RenderMistakeInfo{gleam_missing, "gleam_missing", "no highlight"},
        RenderMistakeInfo{gleam_of_fourth_power, "gleam_of_fourth_power", "the highlight's power is 4, not 8"},
        RenderMistakeInfo{gleam_of_square, "gleam_of_square", "the highlight's power is 2, not 8"},
        RenderMistakeInfo{gleam_of_sixteenth_power, "gleam_of_sixteenth_power", "the highlight's power is 16, not 8"},
        RenderMistakeInfo{gleam_not_weakened, "gleam_not_weakened", "the highlight is not weakened to a quarter"},
        RenderMistakeInfo{gleam_doubled, "gleam_doubled", "the highlight is twice as bright"},
        RenderMistakeInfo{gleam_halved, "gleam_halved", "the highlight is half as bright"},
        RenderMistakeInfo{glow_missing, "glow_missing", "what has just collided is lit as the others are"},
        RenderMistakeInfo{background_flipped, "background_flipped", "the background is upside down"},
        RenderMistakeInfo{background_black, "background_black", "the background is black"},
        RenderMistakeInfo{background_bottom_alone, "background_bottom_alone",
                          "the background has its bottom's colour everywhere"},
        RenderMistakeInfo{background_top_alone, "background_top_alone",
                          "the background has its top's colour everywhere"},
        RenderMistakeInfo{background_half_pixel_off, "background_half_pixel_off",
                          "the background is half a pixel off: y / height"},
        RenderMistakeInfo{background_to_last_row, "background_to_last_row", "the background is y / (height - 1) high"},
        RenderMistakeInfo{background_smoothed, "background_smoothed", "the background is smoothed, not linear"},
        RenderMistakeInfo{obstacles_unlit, "obstacles_unlit", "an obstacle is as bright as where it faces the light"},
        RenderMistakeInfo{obstacles_lit_from_one_side, "obstacles_lit_from_one_side",
                          "an obstacle's normal is not turned to the camera"},
        RenderMistakeInfo{obstacle_normal_flipped, "obstacle_normal_flipped", "an obstacle's normal points away"},
        RenderMistakeInfo{obstacle_light_x_flipped, "obstacle_light_x_flipped",
                          "obstacles are lit from the right, not the left"},
        RenderMistakeInfo{obstacle_light_y_flipped, "obstacle_light_y_flipped",
                          "obstacles are lit from below, not above"},
        RenderMistakeInfo{obstacle_light_z_flipped, "obstacle_light_z_flipped",
                          "obstacles are lit from behind, not from the camera's side"},
        RenderMistakeInfo{obstacle_normal_not_normalised, "obstacle_normal_not_normalised",
                          "an obstacle's normal is not of unit length"},
        RenderMistakeInfo{obstacles_shaded_in_world_space, "obstacles_shaded_in_world_space",
                          "an obstacle's light and view are applied to world positions"},
        RenderMistakeInfo{obstacle_lambert_not_wrapped, "obstacle_lambert_not_wrapped",
                          "an obstacle's light is n . l, not (0.5 + 0.5 n . l) squared"},
        RenderMistakeInfo{obstacle_lambert_squared, "obstacle_lambert_squared",
                          "an obstacle's light is n . l squared, not wrapped"},
        RenderMistakeInfo{obstacle_wrap_not_squared, "obstacle_wrap_not_squared", "an obstacle's light is not squared"},
        RenderMistakeInfo{obstacle_ambient_missing, "obstacle_ambient_missing",
                          "an obstacle's side away from the light is black"},
        RenderMistakeInfo{view_transposed, "view_transposed", "u_View is transposed"},
        RenderMistakeInfo{projection_transposed, "projection_transposed", "u_Projection is transposed"},
        RenderMistakeInfo{width_and_height_swapped, "width_and_height_swapped",
                          "u_ClientWidth and u_ClientHeight are swapped"},
        RenderMistakeInfo{sprite_width_and_height_swapped, "sprite_width_and_height_swapped",
                          "u_ClientWidth and u_ClientHeight are swapped for particles"},
        RenderMistakeInfo{view_of_earlier_frame, "view_of_earlier_frame", "u_View is still the frame before's"},
        RenderMistakeInfo{state_of_earlier_frame, "state_of_earlier_frame", "draws the particles of the frame before"},
    };
}();
static_assert(mistake_infos.size() == render_mistake_count);

static_assert([] {
    for (std::size_t i = 0; i < mistake_infos.size(); ++i)
        if (static_cast<std::size_t>(mistake_infos[i].mistake) != i)
            return false;
    return true;
}());

const Particles no_particles;
const Mesh no_obstacles;

} // namespace

std::span<const RenderMistakeInfo> render_mistakes() { return mistake_infos; }

MistakenInputs::MistakenInputs(const RenderInputs& inputs, RenderMistake mistake)
    : particles_(&inputs.particles), obstacles_(&inputs.obstacles), params_(inputs.params) {
    using enum RenderMistake;
    const bool nothing = mistake == frame_not_drawn || mistake == only_background_drawn;
    if (nothing || mistake == sprites_not_drawn)
        particles_ = &no_particles;
    if (nothing || mistake == obstacles_not_drawn)
        obstacles_ = &no_obstacles;
    if (mistake == state_of_earlier_frame && inputs.earlier != nullptr)
        particles_ = inputs.earlier;
    if (mistake == view_of_earlier_frame && inputs.earlier_params != nullptr)
        params_.render_view = inputs.earlier_params->render_view;
    if (mistake == radius_halved)
        params_.constants.billboard_radius *= 0.5F;
    if (mistake == radius_doubled)
        params_.constants.billboard_radius *= 2.0F;
    if (mistake == view_transposed)
        params_.render_view = glm::transpose(params_.render_view);
    if (mistake == projection_transposed)
        params_.render_projection = glm::transpose(params_.render_projection);
}

ColorImage mistaken_render_pass(const RenderInputs& inputs, const Profile& profile, RenderMistake mistake) {
    return mistaken_render_with_owners(inputs, profile, mistake).color;
}

RenderedFrame mistaken_render_with_owners(const RenderInputs& inputs, const Profile& profile, RenderMistake mistake) {
    const FlushSubnormals guard(profile.flush_subnormals);
    const MistakenInputs mistaken(inputs, mistake);
    const MistakenSites sites(mistake);
    const int width = inputs.params.render_width, height = inputs.params.render_height;
    const RenderedFrame drawn = with_plain_arithmetic(profile, inputs.params.switches.arithmetic, [&](auto fp) {
        RenderDrawing drawing(fp, sites, mistaken.params(), profile);
        if (sites.draws_background())
            drawing.draw_background();
        drawing.draw_obstacles(mistaken.obstacles());
        drawing.draw_particles(mistaken.particles());
        return drawing.take();
    });
    RenderedFrame image{ColorImage(width, height), Image<PixelOwner>(width, height)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::ivec2 from = sites.source(x, y, width, height);
            image.color.at(x, y) = drawn.color.at(from.x, from.y);
            image.owner.at(x, y) = drawn.owner.at(from.x, from.y);
        }
    return image;
}

} // namespace lockstep
