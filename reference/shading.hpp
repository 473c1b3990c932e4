#pragma once
#include <array>
#include <cmath>

#include <glm/vec3.hpp>

#include "reference/model/image.hpp"
#include "reference/triangle_interpolation.hpp"

namespace lockstep {

/// The colours of the render pass; twin of shaders/shading.glsl. Colours are as displayed, 0..1. Constants are binary
/// fractions and sums are written out, so that a compiler has nothing to round its own way. View space: the camera at
/// the origin looks down -z.
template <class A> class Shading {
  public:
    explicit Shading(A fp) : fp_(fp) {}

    [[nodiscard]] glm::vec3 background(int y, int height) const {
        const float up = fp_.divide(static_cast<float>(2 * y + 1), static_cast<float>(2 * height));
        return blend({0.1875F, 0.203125F, 0.234375F}, {0.046875F, 0.0546875F, 0.078125F}, up);
    }

    /// Flat, both sides alike, lit from the upper left of the camera.
    [[nodiscard]] glm::vec3 obstacle(const std::array<glm::vec3, 3>& corners) const {
        glm::vec3 normal = cross(fp_.flush(corners[1] - corners[0]), fp_.flush(corners[2] - corners[0]));
        if (dot(normal, corners[0]) > 0.0F)
            normal = -normal;
        const float squared = dot(normal, normal);
        const float lambert = squared > 0.0F ? fp_.divide(dot(normal, light), fp_.sqrt(squared)) : 0.0F;
        const float wrapped = 0.5F + 0.5F * lambert;
        const float brightness = 0.125F + 0.875F * (wrapped * wrapped);
        return fp_.scale({0.8125F, 0.78125F, 0.734375F}, brightness);
    }

    /// A sphere: `normal` of unit length; slow is blue, fast is white, and what has just collided glows.
    [[nodiscard]] glm::vec3 particle(glm::vec3 normal, float speed, float collide_time, float collision_time) const {
        const float fast = share(speed * 0.5F);
        const float heat = collide_time > 0.0F ? share(fp_.divide(collide_time, collision_time)) : 0.0F;
        const glm::vec3 cold = blend({0.125F, 0.40625F, 0.875F}, {0.8125F, 0.9375F, 1.0F}, fast);
        const glm::vec3 color = blend(cold, {1.0F, 0.5F, 0.09375F}, heat);
        const float lambert = share(dot(normal, light));
        const float lit = 0.3125F + 0.6875F * lambert;
        const float glow = lit + heat * (0.5F * (1.0F - lit));
        const float fourth = (lambert * lambert) * (lambert * lambert);
        const float gleam = 0.25F * (fourth * fourth);
        const glm::vec3 shaded = fp_.scale(color, glow);
        return {shaded.x + gleam, shaded.y + gleam, shaded.z + gleam};
    }

    /// To the nearest of 256 codes a channel, opaque.
    static Rgba8 quantise(glm::vec3 color) {
        const auto code = [](float c) { return static_cast<std::uint8_t>(std::floor(share(c) * 255.0F + 0.5F)); };
        return {code(color.x), code(color.y), code(color.z), 255};
    }

  private:
    static constexpr glm::vec3 light{-0.375F, 0.5F, 0.78125F}; // of unit length within 5 / 10000

    static float share(float x) { return clamp_to(x, 1.0F); }
    [[nodiscard]] float dot(glm::vec3 a, glm::vec3 b) const {
        const glm::vec3 products = fp_.flush(a * b);
        return fp_.flush(fp_.flush(products.x + products.y) + products.z);
    }
    [[nodiscard]] glm::vec3 cross(glm::vec3 a, glm::vec3 b) const {
        const glm::vec3 products = fp_.flush({a.y * b.z, a.z * b.x, a.x * b.y});
        const glm::vec3 other_products = fp_.flush({a.z * b.y, a.x * b.z, a.y * b.x});
        return fp_.flush(products - other_products);
    }
    static glm::vec3 blend(glm::vec3 a, glm::vec3 b, float t) {
        return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
    }

    A fp_;
};

} // namespace lockstep
