#pragma once
#include <cstdint>
#include <random>

#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"

namespace lockstep::test {

/// 8 x 8 texels over -1..1 in x and y, no perspective: texel = 4 * position + 4, depth = z / 2 + 1 / 2.
/// Dyadic constants, so that answers can be worked out by hand. Switches: preset corrected, speed factor 1/2.
FrameParams flat_params();

/// A falling particle that searches: direction +x, speed 3, collide time -1. With flat_params() it integrates to
/// 3 + (-8 * 0.5) = (3, -4, 0) a second: direction (0.6, -0.8, 0), speed 5, position + (1.5, -2, 0), collide time -1.5.
Particles falling(glm::vec3 position);

/// An empty CDT for `params`.
CollisionImage empty_cdt(const FrameParams& params);

/// Stores the code of `position` in texel (x, y), whether or not it projects there.
void store(CollisionImage& cdt, const FrameParams& params, int x, int y, glm::vec3 position);

/// Whether particle i collided: flat_params() sets its collide time to 1/8.
bool collided(const Particles& particles, std::size_t i = 0);

/// The same bits in every field of every particle; any NaN equals any NaN.
bool same_bits(const Particles& a, const Particles& b);
bool same_bits(const CollisionImage& a, const CollisionImage& b);

/// What a collision pass makes: particles and the images it draws.
struct PassOutput {
    Particles particles;
    CollisionImage cdt;
    DepthImage depth;
};

/// Floats of a fixed sequence, the same on every platform.
class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    float between(float low, float high) { return low + (high - low) * static_cast<float>(engine_() >> 8U) * 0x1p-24F; }
    bool chance(float probability) { return between(0.0F, 1.0F) < probability; }
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(engine_()) % n; }

  private:
    std::mt19937 engine_;
};

/// Particles in front of a camera and a CDT around them, some texels empty, many neighbours within reach; a few
/// particles outside the image, and a few that do not search.
struct RandomScene {
    FrameParams params;
    Particles particles;
    CollisionImage cdt;
};
RandomScene random_scene(std::uint32_t seed, std::size_t count, int width, int height);

} // namespace lockstep::test
