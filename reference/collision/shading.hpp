#pragma once
#include <array>
#include <cmath>

#include <glm/vec3.hpp>

#include "reference/collision/render/sites.hpp"
#include "reference/model/image.hpp"
#include "reference/numbers.hpp"
#include "reference/triangle_interpolation.hpp"

namespace lockstep {

/// The colours of the render pass; twin of shaders/collision/shading.glsl. Colours are as displayed, 0..1. Constants
/// are binary fractions and sums are written out, so that a compiler has nothing to round its own way. View space: the
/// camera at the origin looks down -z. `A`: the arithmetic, of floats or of what floats may legally be (numbers.hpp).
template <class A, class Sites = RightSites> class Shading {
  public:
    using Real = typename NumbersOf<A>::Real;
    using Vec3 = typename NumbersOf<A>::Vec3;

    explicit Shading(A fp, Sites sites = {}) : fp_(fp), sites_(sites) {}

    [[nodiscard]] Vec3 background(int y, int height) const {
        const Real up = sites_.background_up(fp_, y, height);
        return sites_.background_color(blend({0.1875F, 0.203125F, 0.234375F}, {0.046875F, 0.0546875F, 0.078125F}, up));
    }

    /// Flat, both sides alike, lit from the upper left of the camera.
    [[nodiscard]] Vec3 obstacle(const std::array<Vec3, 3>& corners) const {
        const Vec3 up = cross(fp_.flush(corners[1] - corners[0]), fp_.flush(corners[2] - corners[0]));
        const Vec3 normal = sites_.corner_normal(choose(dot(up, corners[0]) > 0.0F, -up, up), up);
        const Real squared = dot(normal, normal);
        const Real of_normal = dot(normal, light());
        const Real lambert = sites_.obstacle_lambert(
            choose(squared > 0.0F, fp_.divide(of_normal, fp_.sqrt(squared)), Real(0.0F)), of_normal);
        const Real wrapped = Real(0.5F) + Real(0.5F) * lambert;
        const Real brightness =
            sites_.obstacle_brightness(lambert, wrapped, Real(0.125F) + Real(0.875F) * (wrapped * wrapped));
        return fp_.scale({0.8125F, 0.78125F, 0.734375F}, brightness);
    }

    /// A sphere: `normal` of unit length; slow is blue, fast is white, and what has just collided glows.
    [[nodiscard]] Vec3 particle(const Vec3& normal, Real speed, Real collide_time, float collision_time) const {
        const Real fast = sites_.fast(speed, share(speed * 0.5F));
        const Real heat = sites_.heat(
            fp_, collide_time, choose(collide_time > 0.0F, share(fp_.divide(collide_time, collision_time)), Real(0.0F)),
            collision_time);
        const Vec3 cold = blend({0.125F, 0.40625F, 0.875F}, {0.8125F, 0.9375F, 1.0F}, fast);
        const Vec3 color = blend(cold, {1.0F, 0.5F, 0.09375F}, heat);
        const Real of_light = dot(normal, light());
        const Real lambert = sites_.lambert(of_light, share(of_light));
        const Real lit = sites_.lit(lambert, Real(0.3125F) + Real(0.6875F) * lambert);
        const Real glow = sites_.glow(lit, lit + heat * (Real(0.5F) * (Real(1.0F) - lit)));
        const Real fourth = (lambert * lambert) * (lambert * lambert);
        const Real gleam = sites_.gleam(lambert, Real(0.25F) * (fourth * fourth));
        const Vec3 shaded = fp_.scale(color, glow);
        return sites_.particle_color(fp_, Vec3{shaded.x + gleam, shaded.y + gleam, shaded.z + gleam});
    }

    /// To the nearest of 256 codes a channel, opaque.
    [[nodiscard]] Rgba8 quantise(glm::vec3 color) const {
        const auto code = [&](float c) { return static_cast<std::uint8_t>(std::floor(code_of(c))); };
        return {code(color.x), code(color.y), code(color.z), 255};
    }
    /// What is rounded down to a channel's code.
    [[nodiscard]] Real code_of(Real channel) const { return sites_.code(share(channel)); }

  private:
    static Vec3 light() { return {-0.375F, 0.5F, 0.78125F}; } // of unit length within 5 / 10000

    static Real share(Real x) { return clamp_to(x, 1.0F); }
    [[nodiscard]] Real dot(const Vec3& a, const Vec3& b) const {
        const Vec3 products = fp_.flush(a * b);
        return fp_.flush(fp_.flush(products.x + products.y) + products.z);
    }
    [[nodiscard]] Vec3 cross(const Vec3& a, const Vec3& b) const {
        const Vec3 products = fp_.flush(Vec3{a.y * b.z, a.z * b.x, a.x * b.y});
        const Vec3 other_products = fp_.flush(Vec3{a.z * b.y, a.x * b.z, a.y * b.x});
        return fp_.flush(products - other_products);
    }
    static Vec3 blend(const Vec3& a, const Vec3& b, Real t) {
        return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
    }

    A fp_;
    Sites sites_;
};

} // namespace lockstep
