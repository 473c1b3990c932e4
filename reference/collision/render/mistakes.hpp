#pragma once
#include <cstddef>
#include <span>
#include <string_view>

#include "reference/collision/render/sites.hpp"
#include "reference/collision/render_pass.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/mesh.hpp"
#include "reference/model/profile.hpp"
#include "reference/triangle_interpolation.hpp"

namespace lockstep {

/// Mistakes that a render shader or its host may make; the reference can make them too, to see whether one explains
/// what a GPU drew. The order in which they are told: first those that say what is seen.
enum class RenderMistake {
    frame_not_drawn,
    sprites_not_drawn,
    obstacles_not_drawn,
    background_not_drawn,
    only_background_drawn,
    sprites_half_size,
    sprites_twice_size,
    quads_half_size,
    sphere_twice_size,
    radius_in_clip_space,
    radius_in_ndc,
    square_on_centre,
    square_below_centre,
    square_right_of_centre,
    square_left_of_centre,
    radius_halved,
    radius_doubled,
    sprites_square,
    sprites_square_and_flat,
    y_flipped,
    x_flipped,
    x_and_y_swapped,
    depth_not_tested,
    depth_reversed,
    depth_equal_passes,
    sphere_is_flat_in_depth,
    sphere_reversed_in_depth,
    normal_flipped,
    normal_x_flipped,
    normal_y_flipped,
    normal_z_flipped,
    normal_x_and_y_swapped,
    half_pixel_off,
    half_pixel_further,
    disc_half_size,
    disc_of_half_area,
    sphere_root_left_out,
    sphere_z_is_one,
    sphere_depth_by_diameter,
    sphere_depth_without_radius,
    sprite_depth_not_halved,
    sprite_depth_zero,
    colour_swapped,
    sprite_colour_swapped,
    sprite_red_and_green_swapped,
    sprite_green_and_blue_swapped,
    sprite_colours_squared,
    sprite_colours_rooted,
    codes_truncated,
    codes_of_256,
    alpha_missing,
    sprite_alpha_missing,
    colour_of_speed_missing,
    colour_of_collision_missing,
    speed_not_halved,
    speed_quartered,
    speed_doubled,
    speed_colours_swapped,
    heat_not_divided,
    heat_divided_twice,
    heat_reversed,
    heat_whole,
    sphere_unlit,
    sphere_lit_from_behind_too,
    sphere_lambert_wrapped,
    sphere_ambient_missing,
    sphere_ambient_added,
    gleam_missing,
    gleam_of_fourth_power,
    gleam_of_square,
    gleam_of_sixteenth_power,
    gleam_not_weakened,
    gleam_doubled,
    gleam_halved,
    glow_missing,
    background_flipped,
    background_black,
    background_bottom_alone,
    background_top_alone,
    background_half_pixel_off,
    background_to_last_row,
    background_smoothed,
    obstacles_unlit,
    obstacles_lit_from_one_side,
    obstacle_normal_flipped,
    obstacle_light_x_flipped,
    obstacle_light_y_flipped,
    obstacle_light_z_flipped,
    obstacle_normal_not_normalised,
    obstacles_shaded_in_world_space,
    obstacle_lambert_not_wrapped,
    obstacle_lambert_squared,
    obstacle_wrap_not_squared,
    obstacle_ambient_missing,
    view_transposed,
    projection_transposed,
    width_and_height_swapped,
    sprite_width_and_height_swapped,
    view_of_earlier_frame,
    state_of_earlier_frame,
};
inline constexpr std::size_t render_mistake_count = static_cast<std::size_t>(RenderMistake::state_of_earlier_frame) + 1;

struct RenderMistakeInfo {
    RenderMistake mistake;
    std::string_view name;
    std::string_view meaning;
};

/// All of them, in that order.
std::span<const RenderMistakeInfo> render_mistakes();

/// What a frame is drawn of. Refers to all of it.
struct RenderInputs {
    const Particles& particles;
    const Mesh& obstacles;
    const FrameParams& params;
    const Particles* earlier = nullptr;          ///< of the frame before; null: not known
    const FrameParams* earlier_params = nullptr; ///< likewise
};

/// What a mistake makes of the inputs.
class MistakenInputs {
  public:
    MistakenInputs(const RenderInputs& inputs, RenderMistake mistake);

    [[nodiscard]] const Particles& particles() const { return *particles_; }
    [[nodiscard]] const Mesh& obstacles() const { return *obstacles_; }
    [[nodiscard]] const FrameParams& params() const { return params_; }

  private:
    const Particles* particles_;
    const Mesh* obstacles_;
    FrameParams params_;
};

/// What it makes of the pass's sites.
class MistakenSites : public RightSites {
  public:
    explicit MistakenSites(RenderMistake mistake) : mistake_(mistake) {}

    template <class A> [[nodiscard]] auto background_up(A fp, int y, int height) const {
        using Real = typename NumbersOf<A>::Real;
        const Real up = RightSites::background_up(fp, y, height);
        if (is(RenderMistake::background_smoothed))
            return up * up * (Real(3.0F) - Real(2.0F) * up);
        if (is(RenderMistake::background_bottom_alone) || is(RenderMistake::background_top_alone))
            return Real(is(RenderMistake::background_top_alone) ? 1.0F : 0.0F);
        if (is(RenderMistake::background_half_pixel_off) || is(RenderMistake::background_to_last_row)) {
            const int last = is(RenderMistake::background_to_last_row) ? height - 1 : height;
            return Real(fp.divide(static_cast<float>(y), static_cast<float>(last)));
        }
        return is(RenderMistake::background_flipped) ? Real(1.0F) - up : up;
    }
    template <class Vec3> [[nodiscard]] Vec3 background_color(Vec3 color) const {
        return is(RenderMistake::background_black) ? Vec3{0.0F, 0.0F, 0.0F} : color;
    }
    template <class Vec3> [[nodiscard]] Vec3 corner_normal(Vec3 turned, Vec3 as_wound) const {
        if (is(RenderMistake::obstacles_lit_from_one_side))
            return as_wound;
        if (is(RenderMistake::obstacle_normal_flipped))
            return -turned;
        return {is(RenderMistake::obstacle_light_x_flipped) ? -turned.x : turned.x,
                is(RenderMistake::obstacle_light_y_flipped) ? -turned.y : turned.y,
                is(RenderMistake::obstacle_light_z_flipped) ? -turned.z : turned.z};
    }
    template <class Vec3> [[nodiscard]] Vec3 shaded_corner(Vec3 view, Vec3 world) const {
        return is(RenderMistake::obstacles_shaded_in_world_space) ? world : view;
    }
    template <class Real> [[nodiscard]] Real obstacle_lambert(Real lambert, Real of_normal) const {
        if (is(RenderMistake::obstacle_normal_not_normalised))
            return of_normal;
        return is(RenderMistake::obstacles_unlit) ? Real(1.0F) : lambert;
    }
    template <class Real> [[nodiscard]] Real obstacle_brightness(Real lambert, Real wrapped, Real brightness) const {
        if (is(RenderMistake::obstacle_lambert_squared))
            return Real(0.125F) + Real(0.875F) * (clamp_to(lambert, 1.0F) * clamp_to(lambert, 1.0F));
        if (is(RenderMistake::obstacle_lambert_not_wrapped))
            return Real(0.125F) + Real(0.875F) * clamp_to(lambert, 1.0F);
        if (is(RenderMistake::obstacle_wrap_not_squared))
            return Real(0.125F) + Real(0.875F) * wrapped;
        return is(RenderMistake::obstacle_ambient_missing) ? Real(0.875F) * (wrapped * wrapped) : brightness;
    }
    [[nodiscard]] float corner_radius(float radius) const {
        const bool half = is(RenderMistake::sprites_half_size), twice = is(RenderMistake::sprites_twice_size);
        return half ? radius * 0.5F : twice ? radius * 2.0F : radius;
    }
    template <class Vec3> [[nodiscard]] Vec3 square_centre(Vec3 centre, float radius) const {
        if (is(RenderMistake::square_on_centre) || is(RenderMistake::square_below_centre))
            centre.y = centre.y + (is(RenderMistake::square_on_centre) ? radius : -radius);
        if (is(RenderMistake::square_right_of_centre) || is(RenderMistake::square_left_of_centre))
            centre.x = centre.x + (is(RenderMistake::square_right_of_centre) ? radius : -radius);
        return centre;
    }
    template <class Billboard, class Project>
    [[nodiscard]] Billboard square(Billboard square, const Project& project, float radius) const {
        if (!is(RenderMistake::radius_in_clip_space) && !is(RenderMistake::radius_in_ndc))
            return square;
        const auto centre = project();
        const auto side = is(RenderMistake::radius_in_ndc) ? centre.w * radius : centre.w * 0.0F + radius;
        square.low = square.high = centre;
        square.low.x = centre.x - side;
        square.low.y = centre.y - side;
        square.high.x = centre.x + side;
        square.high.y = centre.y + side;
        return square;
    }
    template <class Window> [[nodiscard]] Window sphere_window(Window window) const {
        if (is(RenderMistake::sphere_twice_size))
            window.half = window.half * 2.0F;
        return window;
    }
    template <class Billboard> [[nodiscard]] Billboard quad(Billboard square) const {
        if (!is(RenderMistake::quads_half_size))
            return square;
        const auto x = (square.high.x - square.low.x) * 0.25F, y = (square.high.y - square.low.y) * 0.25F;
        square.low.x = square.low.x + x;
        square.low.y = square.low.y + y;
        square.high.x = square.high.x - x;
        square.high.y = square.high.y - y;
        return square;
    }
    [[nodiscard]] glm::ivec2 size(int width, int height, bool of_particle) const {
        const bool swapped = is(RenderMistake::width_and_height_swapped) ||
                             (of_particle && is(RenderMistake::sprite_width_and_height_swapped));
        return swapped ? glm::ivec2(height, width) : glm::ivec2(width, height);
    }
    [[nodiscard]] float pixel_centre() const {
        return is(RenderMistake::half_pixel_off) ? 0.0F : is(RenderMistake::half_pixel_further) ? 1.0F : 0.5F;
    }
    template <class Bool, class Real> [[nodiscard]] Bool in_disc(Bool inside, Real squared) const {
        if (is(RenderMistake::disc_half_size))
            return squared <= 0.25F;
        if (is(RenderMistake::disc_of_half_area))
            return squared <= 0.5F;
        if (!is_square())
            return inside;
        if constexpr (requires { inside.yes; })
            return {true, false};
        else
            return true;
    }
    template <class Real> [[nodiscard]] Real under_root(Real rest) const {
        return is(RenderMistake::sprites_square_and_flat) ? clamp_to(rest, 1.0F) : rest;
    }
    template <class Real> [[nodiscard]] Real rooted(Real root, Real rest) const {
        if (is(RenderMistake::sphere_z_is_one))
            return Real(1.0F);
        return is(RenderMistake::sphere_root_left_out) ? rest : root;
    }
    template <class Vec3> [[nodiscard]] Vec3 sphere_normal(Vec3 n) const {
        const bool all = is(RenderMistake::normal_flipped);
        if (is(RenderMistake::normal_x_and_y_swapped))
            return {n.y, n.x, n.z};
        return {all || is(RenderMistake::normal_x_flipped) ? -n.x : n.x,
                all || is(RenderMistake::normal_y_flipped) ? -n.y : n.y,
                all || is(RenderMistake::normal_z_flipped) ? -n.z : n.z};
    }
    template <class Real> [[nodiscard]] Real towards_camera(Real normal_z, Real by_radius, float radius) const {
        if (is(RenderMistake::sphere_is_flat_in_depth))
            return Real(0.0F);
        if (is(RenderMistake::sphere_depth_without_radius))
            return normal_z;
        if (is(RenderMistake::sphere_depth_by_diameter))
            return normal_z * (2.0F * radius);
        return is(RenderMistake::sphere_reversed_in_depth) ? -by_radius : by_radius;
    }
    template <class Real> [[nodiscard]] Real sprite_depth(Real ndc, Real depth) const {
        if (is(RenderMistake::sprite_depth_zero))
            return Real(0.0F);
        return is(RenderMistake::sprite_depth_not_halved) ? ndc : depth;
    }
    template <class Real> [[nodiscard]] Real fast(Real speed, Real share) const {
        if (is(RenderMistake::speed_not_halved) || is(RenderMistake::speed_quartered) ||
            is(RenderMistake::speed_doubled))
            return clamp_to(speed * speed_share(), 1.0F);
        if (is(RenderMistake::speed_colours_swapped))
            return Real(1.0F) - share;
        return is(RenderMistake::colour_of_speed_missing) ? Real(0.0F) : share;
    }
    template <class A, class Real>
    [[nodiscard]] Real heat(A fp, Real collide_time, Real share, float collision_time) const {
        const auto glows = collide_time > 0.0F;
        if (is(RenderMistake::heat_divided_twice))
            return choose(glows, clamp_to(fp.divide(fp.divide(collide_time, collision_time), collision_time), 1.0F),
                          Real(0.0F));
        if (is(RenderMistake::heat_not_divided))
            return choose(glows, clamp_to(collide_time, 1.0F), Real(0.0F));
        if (is(RenderMistake::heat_reversed))
            return choose(glows, Real(1.0F) - share, Real(0.0F));
        if (is(RenderMistake::heat_whole))
            return choose(glows, Real(1.0F), Real(0.0F));
        return is(RenderMistake::colour_of_collision_missing) ? Real(0.0F) : share;
    }
    template <class Real> [[nodiscard]] Real lambert(Real of_light, Real share) const {
        if (is(RenderMistake::sphere_lit_from_behind_too))
            return clamp_to(abs(of_light), 1.0F);
        if (is(RenderMistake::sphere_lambert_wrapped))
            return clamp_to(of_light * 0.5F + 0.5F, 1.0F);
        return is(RenderMistake::sphere_unlit) ? Real(1.0F) : share;
    }
    template <class Real> [[nodiscard]] Real lit(Real lambert, Real lit) const {
        if (is(RenderMistake::sphere_ambient_added))
            return Real(0.3125F) + lambert;
        return is(RenderMistake::sphere_ambient_missing) ? Real(0.6875F) * lambert : lit;
    }
    template <class Real> [[nodiscard]] Real gleam(Real lambert, Real light) const {
        const Real square = lambert * lambert, fourth = square * square, eighth = fourth * fourth;
        if (is(RenderMistake::gleam_of_square))
            return Real(0.25F) * square;
        if (is(RenderMistake::gleam_of_fourth_power))
            return Real(0.25F) * fourth;
        if (is(RenderMistake::gleam_of_sixteenth_power))
            return Real(0.25F) * (eighth * eighth);
        if (is(RenderMistake::gleam_not_weakened) || is(RenderMistake::gleam_doubled) ||
            is(RenderMistake::gleam_halved))
            return eighth * gleam_share();
        return is(RenderMistake::gleam_missing) ? Real(0.0F) : light;
    }
    template <class Real> [[nodiscard]] Real glow(Real lit, Real glow) const {
        return is(RenderMistake::glow_missing) ? lit : glow;
    }
    template <class A, class Vec3> [[nodiscard]] Vec3 particle_color(A fp, Vec3 c) const {
        if (is(RenderMistake::sprite_colours_squared))
            return {c.x * c.x, c.y * c.y, c.z * c.z};
        return is(RenderMistake::sprite_colours_rooted) ? Vec3{fp.sqrt(c.x), fp.sqrt(c.y), fp.sqrt(c.z)} : c;
    }
    template <class Real> [[nodiscard]] Real code(Real channel) const {
        if (is(RenderMistake::codes_truncated))
            return channel * 255.0F;
        return is(RenderMistake::codes_of_256) ? clamp_to(channel * 256.0F, 255.0F) : RightSites::code(channel);
    }
    [[nodiscard]] DepthTest depth_test() const {
        if (is(RenderMistake::depth_not_tested))
            return DepthTest::always;
        if (is(RenderMistake::depth_equal_passes))
            return DepthTest::less_or_equal;
        return is(RenderMistake::depth_reversed) ? DepthTest::greater : DepthTest::less;
    }
    [[nodiscard]] Rgba8 stored(Rgba8 c, bool of_particle) const {
        if (is(RenderMistake::alpha_missing) || (of_particle && is(RenderMistake::sprite_alpha_missing)))
            c.a = 0;
        const bool swapped =
            is(RenderMistake::colour_swapped) || (of_particle && is(RenderMistake::sprite_colour_swapped));
        if (of_particle && is(RenderMistake::sprite_red_and_green_swapped))
            return {c.g, c.r, c.b, c.a};
        if (of_particle && is(RenderMistake::sprite_green_and_blue_swapped))
            return {c.r, c.b, c.g, c.a};
        return swapped ? Rgba8{c.b, c.g, c.r, c.a} : c;
    }
    [[nodiscard]] bool draws_background() const {
        return !is(RenderMistake::background_not_drawn) && !is(RenderMistake::frame_not_drawn);
    }
    [[nodiscard]] glm::ivec2 source(int x, int y, int width, int height) const {
        if (is(RenderMistake::x_and_y_swapped))
            return {y % width, x % height};
        return {is(RenderMistake::x_flipped) ? width - 1 - x : x, is(RenderMistake::y_flipped) ? height - 1 - y : y};
    }

  private:
    [[nodiscard]] bool is(RenderMistake mistake) const { return mistake_ == mistake; }
    [[nodiscard]] float speed_share() const {
        return is(RenderMistake::speed_not_halved) ? 1.0F : is(RenderMistake::speed_doubled) ? 2.0F : 0.25F;
    }
    [[nodiscard]] float gleam_share() const {
        return is(RenderMistake::gleam_not_weakened) ? 1.0F : is(RenderMistake::gleam_doubled) ? 0.5F : 0.125F;
    }
    [[nodiscard]] bool is_square() const {
        return is(RenderMistake::sprites_square) || is(RenderMistake::sprites_square_and_flat);
    }

    RenderMistake mistake_;
};

/// The frame that the reference draws with that mistake.
ColorImage mistaken_render_pass(const RenderInputs& inputs, const Profile& profile, RenderMistake mistake);

/// The same, with whose each pixel is.
RenderedFrame mistaken_render_with_owners(const RenderInputs& inputs, const Profile& profile, RenderMistake mistake);

} // namespace lockstep
