#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/model/arithmetic_switch.hpp"
#include "reference/model/camera.hpp"
#include "reference/model/graph.hpp"
#include "reference/model/image.hpp"
#include "reference/model/lifecycle/switches.hpp"

namespace lockstep::lifecycle {

/// What accelerates particles. World units and seconds.
struct Force {
    enum class Kind { drag, vortex, attraction, curl_noise };
    Kind kind = Kind::drag;
    float k = 0.0F; ///< of drag, 1/s
    glm::vec3 centre{0.0F};
    glm::vec3 axis{0.0F, 1.0F, 0.0F};
    float strength = 1.0F; ///< units/s^2
    float radius = 1.0F;
    int falloff = 1;   ///< the exponent: 0, 1 or 2
    float pull = 0.0F; ///< of a vortex, towards its axis
    bool inverse_square = false;
    float softening = 0.1F;
    float kill_radius = 0.0F;
    float frequency = 1.0F; ///< of curl noise
    glm::vec3 pan{0.0F};    ///< units/s
    std::uint32_t seed = 1; ///< below 2^24
};

/// Where an emitter is in a frame; between two of them in between.
struct Place {
    int frame = 0;
    glm::vec3 position{0.0F};
};

struct Emitter {
    enum class Shape { point, box, sphere };
    enum class Draw { sprite, ribbon };
    /// Over what was drawn before, added to it, or in its place where it is nearer.
    enum class Blend { over, additive, opaque };
    enum class Uv { segment, stretched, distance };
    std::size_t capacity = 1024;
    double rate = 0.0;                                 ///< particles a second
    std::vector<std::pair<int, std::uint32_t>> bursts; ///< frame, count
    std::array<float, 2> lifetime{1.0F, 1.0F};         ///< s
    Shape shape = Shape::point;
    glm::vec3 min{0.0F}, max{0.0F}; ///< of a box; of a point its place is `min`
    float radius = 1.0F;            ///< of a sphere around `min`
    std::vector<Place> path;
    glm::vec3 direction{0.0F, 1.0F, 0.0F};
    float direction_jitter = 0.0F, speed = 1.0F, speed_jitter = 0.0F;
    float cone = -1.0F; ///< degrees off the direction; below 0: jitter instead
    glm::vec3 acceleration{0.0F};
    std::array<float, 2> size{0.1F, 0.1F};
    std::array<glm::vec4, 2> color{glm::vec4(1.0F), glm::vec4(1.0F)};
    std::vector<Force> forces;
    Draw draw = Draw::sprite;
    Uv uv = Uv::distance; ///< of a ribbon
    float uv_scale = 1.0F;
    Blend blend = Blend::over;
    GraphPtr emission, simulation, rendering; ///< of those stages; null: as above
};

/// What sprites are drawn with.
struct Sprite {
    enum class Filter { nearest, bilinear };
    ColorImage texture;      ///< square; empty: a soft, round blob
    std::size_t polygon = 0; ///< corners of the bounding polygon, 3 to 8; 0: the quad
    int alpha_cut = 0;       ///< texels whose alpha's code is above it are to be seen
    Filter filter = Filter::nearest;
};

struct Settings {
    std::string description;
    std::uint64_t seed = 1;
    float tick = 0.016666668F; ///< s
    Switches switches;
    ArithmeticSwitch arithmetic = ArithmeticSwitch::plain;
    glm::vec3 box_low{-16.0F}, box_size{32.0F}; ///< of box16
    Camera camera;
    int width = 960, height = 540; ///< of its pictures
    Sprite sprite;
    std::vector<Emitter> emitters{1};
};

inline constexpr int largest_texture = 1024; ///< texels along a side

/// GL's guaranteed number of groups, of 256.
inline constexpr std::size_t most_particles_of_emitter = std::size_t{65535} * 256;

/// Throws Error naming the first thing that cannot be run, what, and what would be right.
void check(const Settings& settings);

} // namespace lockstep::lifecycle
