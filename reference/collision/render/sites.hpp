#pragma once
#include <glm/vec2.hpp>

#include "reference/model/image.hpp"

namespace lockstep {

/// How a fragment's depth is held against what is there.
enum class DepthTest { less, less_or_equal, greater, always };

/// The places of the render pass that a mistake may change (mistakes.hpp), each with what it is handed on: here all as
/// it is. Numbers may be of any reading (numbers.hpp).
struct RightSites {
    /// From the bottom to the top, 0..1.
    template <class A> static auto background_up(A fp, int y, int height) {
        return fp.divide(static_cast<float>(2 * y + 1), static_cast<float>(2 * height));
    }
    template <class Vec3> static Vec3 background_color(Vec3 color) { return color; }
    template <class Vec3> static Vec3 corner_normal(Vec3 turned, Vec3) { return turned; }
    template <class Vec3> static Vec3 shaded_corner(Vec3 view, Vec3 /*world*/) { return view; }
    template <class Real> static Real obstacle_lambert(Real lambert, Real /*of_normal*/) { return lambert; }
    template <class Real> static Real obstacle_brightness(Real /*lambert*/, Real /*wrapped*/, Real brightness) {
        return brightness;
    }
    static float corner_radius(float radius) { return radius; }
    template <class Vec3> static Vec3 square_centre(Vec3 centre, float /*radius*/) { return centre; }
    /// `project` takes the square's centre to clip space.
    template <class Billboard, class Project>
    static Billboard square(Billboard square, const Project& /*project*/, float) {
        return square;
    }
    template <class Window> static Window sphere_window(Window window) { return window; }
    template <class Billboard> static Billboard quad(Billboard square) { return square; }
    static glm::ivec2 size(int width, int height, bool /*of a particle*/) { return {width, height}; }
    static float pixel_centre() { return 0.5F; }
    template <class Bool, class Real> static Bool in_disc(Bool inside, Real /*squared*/) { return inside; }
    template <class Real> static Real under_root(Real rest) { return rest; }
    template <class Real> static Real rooted(Real root, Real /*rest*/) { return root; }
    template <class Vec3> static Vec3 sphere_normal(Vec3 normal) { return normal; }
    template <class Real> static Real towards_camera(Real /*normal_z*/, Real by_radius, float /*radius*/) {
        return by_radius;
    }
    template <class Real> static Real sprite_depth(Real /*ndc*/, Real depth) { return depth; }
    template <class Real> static Real fast(Real /*speed*/, Real share) { return share; }
    template <class A, class Real> static Real heat(A, Real /*collide_time*/, Real share, float /*collision_time*/) {
        return share;
    }
    template <class Real> static Real lambert(Real /*of_light*/, Real share) { return share; }
    template <class Real> static Real lit(Real /*lambert*/, Real lit) { return lit; }
    template <class Real> static Real gleam(Real /*lambert*/, Real light) { return light; }
    template <class Real> static Real glow(Real, Real glow) { return glow; }
    template <class A, class Vec3> static Vec3 particle_color(A /*fp*/, Vec3 color) { return color; }
    /// What is rounded down to a channel's code.
    template <class Real> static Real code(Real channel) { return channel * 255.0F + 0.5F; }
    static constexpr DepthTest depth_test() { return DepthTest::less; }
    static Rgba8 stored(Rgba8 color, bool /*of a particle*/) { return color; }
    static constexpr bool draws_background() { return true; }
    /// The pixel drawn whose colour is at pixel (x, y) of the image.
    static glm::ivec2 source(int x, int y, int, int) { return {x, y}; }
};

} // namespace lockstep
