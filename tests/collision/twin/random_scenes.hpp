#pragma once
#include <cmath>
#include <cstdint>
#include <random>

#include <glm/vec3.hpp>

#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/mesh.hpp"

namespace lockstep::test {

/// Scenes to set the twins against each other; the same on every run.
class RandomScenes {
  public:
    explicit RandomScenes(unsigned seed) : random_(seed) {}

    /// In a cube of half side `half_side`.
    glm::vec3 position(float half_side) { return {value(half_side), value(half_side), value(half_side)}; }

    /// `count` triangles round places in a cube of half side `spread`, corners up to `size` from the middle.
    Mesh triangles(int count, float spread, float size) {
        Mesh mesh;
        for (int i = 0; i < count; ++i) {
            const glm::vec3 middle = position(spread);
            for (int corner = 0; corner < 3; ++corner)
                append(mesh, middle + position(size));
        }
        return mesh;
    }

    /// Triangles in clip space (projection: identity) whose corners lie on multiples of `grid` / 256 pixels of an image
    /// of width x height, and up to 8 pixels apart: with grid 128 and 256 on pixel borders and centres.
    Mesh triangles_on_grid(int count, int grid, int width, int height) {
        Mesh mesh;
        std::uniform_int_distribution<int> x(0, 256 * width / grid);
        std::uniform_int_distribution<int> y(0, 256 * height / grid);
        std::uniform_int_distribution<int> offset(-2048 / grid, 2048 / grid);
        const auto to_clip = [&](int units, int pixels) {
            return static_cast<float>(units * grid) / 128.0F / static_cast<float>(pixels) - 1.0F;
        };
        for (int i = 0; i < count; ++i) {
            const int middle_x = x(random_);
            const int middle_y = y(random_);
            const float depth = value(1.0F);
            for (int corner = 0; corner < 3; ++corner)
                append(mesh, {to_clip(middle_x + offset(random_), width), to_clip(middle_y + offset(random_), height),
                              depth});
        }
        return mesh;
    }

    /// Triangles in the cube of half side 1 with two sides almost, or quite, on one line.
    Mesh slivers(int count) {
        Mesh mesh;
        for (int i = 0; i < count; ++i) {
            const glm::vec3 a = position(1.0F);
            const glm::vec3 b = position(1.0F);
            const float off = std::exp2(value(14.0F) - 14.0F);
            append(mesh, a);
            append(mesh, b);
            append(mesh, i % 8 == 0 ? a : a + (b - a) * value(1.0F) + position(off));
        }
        return mesh;
    }

    /// Triangles whose corners have some coordinates near 1 and some of any magnitude a float has, 0 included.
    Mesh any_magnitude(int count) {
        Mesh mesh;
        for (int i = 0; i < 3 * count; ++i) {
            glm::vec3 corner = position(2.0F);
            for (int axis = 0; axis < 3; ++axis)
                if (value(1.0F) > 0.5F)
                    corner[axis] *= std::exp2(value(160.0F));
                else if (value(1.0F) > 0.8F)
                    corner[axis] = 0.0F;
            append(mesh, corner);
        }
        return mesh;
    }

    Particles particles(std::size_t count, float spread) {
        Particles particles;
        particles.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            particles.position[i] = position(spread);
            particles.direction[i] = glm::vec3(0.0F, 1.0F, 0.0F);
            particles.speed[i] = value(1.5F) + 1.5F;
            particles.collide_time[i] = value(0.1F);
        }
        return particles;
    }

  private:
    static void append(Mesh& mesh, glm::vec3 corner) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(corner);
    }
    float value(float magnitude) { return std::uniform_real_distribution<float>(-magnitude, magnitude)(random_); }

    std::mt19937 random_;
};

} // namespace lockstep::test
