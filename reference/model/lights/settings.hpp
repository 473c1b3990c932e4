#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "reference/model/arithmetic_switch.hpp"
#include "reference/model/camera.hpp"
#include "reference/model/lights/switches.hpp"
#include "reference/model/mesh.hpp"

namespace lockstep::lights {

struct Light {
    glm::vec3 position{0.0F};              ///< m
    float range = 4.0F;                    ///< m, above 0
    glm::vec3 direction{1.0F, 0.0F, 0.0F}; ///< of its way, unit
    float speed = 0.0F;                    ///< m/s
    glm::vec3 colour{1.0F};                ///< linear
};

/// The voxels of both textures. O is a multiple of h, and h a power of two, so that voxels' points are exact.
struct Grid {
    glm::ivec3 size{16};    ///< N: powers of two, 2 to 256
    float voxel = 1.0F;     ///< h, m: a power of two, 1/4 to 4
    glm::vec3 origin{0.0F}; ///< O, m

    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
    }
};

/// What is lit: triangles in world space, and of each the codes k of its albedo, k / 256.
struct Obstacles {
    Mesh mesh;
    std::vector<glm::ivec3> albedo; ///< one a triangle, 0 to 255
};

/// All that a run of the lights system starts from.
struct Settings {
    std::string description;
    std::uint32_t seed = 1;
    ArithmeticSwitch arithmetic = ArithmeticSwitch::plain;
    Switches switches;
    Grid grid;
    std::vector<Light> lights;
    Obstacles obstacles;
    Camera camera{.eye = {0.0F, 12.0F, 40.0F}, .target = {0.0F, 2.0F, 0.0F}, .near_plane = 0.5F, .far_plane = 200.0F};
    int width = 320, height = 180; ///< of the image, pixels
    float tick = 1.0F / 60.0F;     ///< s
    glm::vec3 ambient{1.0F / 64.0F}, background{0.0F};
    float glow_radius = 0.1F, glow_gain = 1.0F; ///< m
    std::optional<int> fixed_bits;              ///< of fixed32 and blend_exact; not set: the most that fit
};

inline constexpr std::size_t most_lights = std::size_t{1} << 21U;

/// Throws Error, one line, for what no run can start from: a grid that is no power of two, a range beyond 14 voxels or
/// not above 0, sums that a fixed-point word cannot hold, remedies without what they need.
void check(const Settings& settings);

/// The largest magnitude of one addend, of any channel.
double largest_addend(const Settings& settings);
/// The most bits behind the point with which fixed32 (31 bits) or blend_exact (24) hold every sum.
int most_fixed_bits(const Settings& settings);

} // namespace lockstep::lights
