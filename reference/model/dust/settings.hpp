#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "reference/model/arithmetic_switch.hpp"
#include "reference/model/camera.hpp"
#include "reference/model/dust/switches.hpp"

namespace lockstep::dust {

struct Box {
    glm::vec3 min{0.0F}, max{0.0F};
};

/// Where the tool is held in a frame; between two of them in a straight line, after the last it stays.
struct Pose {
    int frame = 0;
    glm::vec3 position{0.0F}, forward{0.0F, 0.0F, 1.0F}; ///< of any length but 0
};

/// A tool that is on from frame `from` up to, not with, `to`. One at a time: the first of those that are on.
struct Tool {
    enum class Kind { vacuum, emit, wind };
    Kind kind = Kind::vacuum;
    int from = 0, to = 0;
    float force = 1.0F;
    float range = 5.0F;       ///< of vacuum and wind, world units
    float angle = 45.0F;      ///< from the axis to the cone's side, degrees
    float death_range = 0.2F; ///< of vacuum
    float distance = 1.0F;    ///< of emit
};

struct Collider {
    bool sphere = true;
    glm::vec3 position{0.0F};
    float radius = 1.0F;                 ///< of a sphere
    glm::vec3 scale{1.0F}, rotate{0.0F}; ///< of a box: its sides, and degrees about z, then x, then y
    bool removed = false;                ///< before the first frame: see the switch last_collider
};

/// A ball that the cannon shoots in a frame: it flies for at most five seconds and explodes where it meets a collider
/// or a wall.
struct Ball {
    int frame = 0;
    glm::vec3 position{0.0F}, forward{0.0F, 0.0F, 1.0F};
    float speed = 60.0F, range = 25.0F, force = 3000.0F;
};

/// All that a run of the dust system starts from. World units are metres.
struct Settings {
    std::string description;
    std::size_t count = 100'000; ///< of grains, 1 to most_grains
    std::uint32_t seed = 1;
    ArithmeticSwitch arithmetic = ArithmeticSwitch::plain;
    Switches switches;
    float tick = 1.0F / 60.0F, timescale = 1.0F; ///< a frame takes tick * timescale seconds
    glm::vec3 gravity{0.0F, -9.8F, 0.0F};
    float scale = 0.2F; ///< side of a grain's quad; its radius is scale * radius_of_scale
    float mass = 1.0F, air_resistance = 1.0F, elasticity = 0.6F;
    glm::vec3 colour_a{0.0F}, colour_b{0.5F};
    Box spawn{{-50.0F, 0.0F, -50.0F}, {50.0F, 5.0F, 50.0F}};
    Box world{{-50.0F, 0.0F, -50.0F}, {50.0F, 50.0F, 50.0F}};
    std::vector<Pose> controller{Pose{}}; ///< at least one, in the order of their frames
    std::vector<Tool> tools;
    std::vector<Collider> colliders;
    std::vector<Ball> cannon;
    Camera camera{.eye = {0.0F, 30.0F, 90.0F}, .target = {0.0F, 10.0F, 0.0F}, .near_plane = 0.5F, .far_plane = 400.0F};
};

/// 65,535 groups of 64: what every GL has in one dispatch.
inline constexpr std::size_t most_grains = 4'194'240;

/// Throws Error, one line, for what no run can start from: no grains or too many, a mass of 0, an angle outside 0 to
/// 90, a spawn box without width where numbers come of it, a collider without size, a number that is not finite or
/// whose square is not. Drag is not bounded: beyond 1 / dt velocities alternate, beyond 2 / dt they grow until they are
/// infinite. Other numbers may be as large as floats are; what overflows is infinite or NaN on both sides.
void check(const Settings& settings);

} // namespace lockstep::dust
