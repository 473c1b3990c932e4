#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <tuple>

#include "reference/fluid/sprite.hpp"
#include "reference/system/item_twin.hpp"
#include "reference/system/item_words.hpp"

namespace lockstep::fluid {

/// What a sphere leaves at a pixel.
template <class R> struct SphereAt {
    typename R::Real stored;
    auto fields() { return std::tie(stored); }
    auto fields() const { return std::tie(stored); }
};

struct SphereDepthTwin;
void draw_row(const SphereDepthTwin& twin, const Portable& arithmetic, const PassInput& in, std::size_t row,
              const WritableView& after);
void draw_row(const SphereDepthTwin& twin, const PlainArithmetic& arithmetic, const PassInput& in, std::size_t row,
              const WritableView& after);

/// The nearest sphere of each pixel. Twin of shaders/fluid/sphere_depth_pass.*.
struct SphereDepthTwin {
    HostPtr host;
    BoxesByTile boxes = {};
    std::shared_ptr<DrawnBalls> balls = {};
    std::shared_ptr<BoxesAround> around = {};

    [[nodiscard]] SphereDepthTwin at(const PassInput& in) const {
        return {host, sprite_boxes(*host, in.before, spheres()),
                std::make_shared<DrawnBalls>(in.before[particle_buffer].count()), std::make_shared<BoxesAround>()};
    }

    [[nodiscard]] HandedSpheres<SphereDepthTwin> handed(std::span<const Mistake> made) const { return {*this, made}; }

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        return at_pixel(r, in, item, Tried::in_their_boxes);
    }
    template <class R> ItemWords<R> at_pixel(R& r, const PassInput& in, std::size_t item, Tried tried) const {
        using Real = typename R::Real;
        const Pixel pixel = Pixel::of(host->settings().width, item);
        const SpriteTwin<R> sprite(r, *host, in.before, spheres());
        auto nearest = least<SphereAt<R>>(r, site::nearest_sphere, 1.0F);
        for_each_tried(*this, in.before, pixel, tried, [&](std::uint32_t i) {
            if (const auto ball = sprite.ball(i))
                offer(r, sprite, *ball, meeting(r, *host, in, sprite, *ball, item),
                      [&](const auto& condition, const Real& key, const Real& stored) {
                          nearest.offer(site::sphere_here, condition, key, SphereAt<R>{stored});
                      });
        });
        const std::optional<SphereAt<R>> found = nearest.take();
        ItemWords<R> words;
        words.add(r.note(site::depth, found ? found->stored : Real(DepthCode<R>(r, *host).empty())));
        return words;
    }

    // Sphere by sphere, a row of tiles at a time (sphere_lanes.cpp).
    [[nodiscard]] std::size_t parts() const { return boxes.rows(); }
    template <class A>
    void part(const Values<A>& r, const PassInput& in, std::size_t row, const WritableView& after) const {
        draw_row(*this, arithmetic_of(r), in, row, after);
    }

    [[nodiscard]] Spheres spheres() const { return {host->switches().sphere, host->settings().radius}; }

    /// Calls `made(condition, key, stored)` where the sphere may cover the pixel.
    template <class R, class Meets, class Made>
    void offer(R& r, const SpriteTwin<R>& sprite, const Ball<R>& ball, const Meets& meets, const Made& made) const {
        using Real = typename R::Real;
        const DepthCode<R> code(r, *host);
        const Real zero(0.0F), one(1.0F);
        const auto offer_at = [&](const Real& height_of, const auto& covered) {
            const Real z = r.note(site::surface_z, height_of), window = code.window(z), stored = code.stored(z);
            const Real in_scene = r.setting(site::scene_tests_surface, true) ? window : meets.window();
            made(covered && z < zero && before_scene(r, *host, meets.scene, in_scene),
                 r.setting(site::nearest_is_of_surface, true) ? code.tested(z, stored)
                                                              : code.tested(ball.centre.z, code.stored(ball.centre.z)),
                 r.note(site::sphere_depth, stored));
        };
        if (host->switches().sphere == Sphere::ray) {
            const RayOfPixel<R> ray = ray_at(r, sprite, ball, meets.place());
            if (!everywhere(decided(r, site::off_sphere, ray.chord < zero)))
                offer_at(-(ray.middle - half_chord(r, ray)), ray.chord >= zero);
            return;
        }
        const Real squared = sprite.squared_if_drawn(ball, meets.squared());
        // A point's edge is open: one fork among all spheres, not one for each.
        if (host->switches().sprite == Sprite::points || !everywhere(decided(r, site::off_disc, squared > one)))
            offer_at(ball.centre.z + r.note(site::rise, sprite.radius() * sprite.height(squared)), squared <= one);
    }

  private:
    /// A pixel's ray through a sphere: where its middle lies, and the square of half its chord.
    template <class R> struct RayOfPixel { typename R::Real squared, middle, chord; };
    template <class R> static auto half_chord(R& r, const RayOfPixel<R>& ray) {
        return r.note(site::half_chord, r.sqrt(site::half_chord, r.divide(site::chord_by_ray, ray.chord, ray.squared)));
    }
    template <class R, class Place>
    RayOfPixel<R> ray_at(R& r, const SpriteTwin<R>& sprite, const Ball<R>& ball, const Place& pixel) const {
        using Real = typename R::Real;
        using Vec3 = typename R::Vec3;
        const auto slope = pixel_slope(r, *host, pixel.x, pixel.y);
        const Vec3 d{slope.x, slope.y, Real(-1.0F)};
        const Real a = r.note(site::ray_squared, r.dot(site::ray_squared, d, d)),
                   b = r.note(site::ray_centre, r.dot(site::ray_centre, d, ball.centre));
        const Real k = r.note(site::along, r.divide(site::along, b, a));
        const Vec3 l = r.note(site::to_ray, ball.centre - d * k);
        const Real m = r.note(site::chord, sprite.radius() * sprite.radius() - r.dot(site::to_ray, l, l));
        return {a, k, m};
    }
};

} // namespace lockstep::fluid
