#include "reference/model/dust/settings.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "reference/model/error.hpp"

namespace lockstep::dust {
namespace {

constexpr double shortest_flight_step = 1e-5; ///< seconds

template <class... Parts> void expect(bool right, fmt::format_string<Parts...> text, Parts&&... parts) {
    if (!right)
        throw Error("dust: " + fmt::format(text, std::forward<Parts>(parts)...));
}

bool is_finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool is_direction(const glm::vec3& v) {
    const float squared = v.x * v.x + v.y * v.y + v.z * v.z;
    return squared > 0.0F && std::isfinite(squared);
}

/// Whether a number is 0 or above and has a square.
bool is_squared(float x) { return x >= 0.0F && std::isfinite(x * x); }

/// Whether the straight way from one direction to another comes by no direction at all.
bool turns_over(const glm::vec3& from, const glm::vec3& to) {
    const glm::dvec3 a = glm::normalize(glm::dvec3(from)), b = glm::normalize(glm::dvec3(to));
    return glm::length(a + b) < 1e-6;
}

void check_box(const char* name, const Box& box) {
    expect(is_finite(box.min) && is_finite(box.max), "{}: a corner is not finite", name);
    for (int axis = 0; axis < 3; ++axis)
        expect(box.min[axis] <= box.max[axis], "{}: min.{} is {}, above max, {}", name, "xyz"[axis], box.min[axis],
               box.max[axis]);
}

void check_controller(const std::vector<Pose>& poses) {
    expect(!poses.empty(), "controller: there is no keyframe; right is at least one");
    for (std::size_t k = 0; k < poses.size(); ++k) {
        expect(is_finite(poses[k].position), "controller: keyframe {}: position is not finite", k);
        expect(is_direction(poses[k].forward), "controller: keyframe {}: forward has no length", k);
        expect(k == 0 || poses[k].frame > poses[k - 1].frame,
               "controller: keyframe {} is of frame {}; right is after {}", k, poses[k].frame,
               k == 0 ? 0 : poses[k - 1].frame);
        expect(k == 0 || !turns_over(poses[k - 1].forward, poses[k].forward),
               "controller: keyframes {} and {} face opposite ways; right is one between them", k == 0 ? 0 : k - 1, k);
    }
}

void check_tool(const Tool& tool, std::size_t k) {
    expect(tool.from <= tool.to, "tools: {} is on from {} to {}; right is upwards", k, tool.from, tool.to);
    expect(tool.angle > 0.0F && tool.angle <= 90.0F, "tools: {} has an angle of {} degrees; right is 0.01 to 90", k,
           tool.angle);
    const std::pair<const char*, float> squared[] = {
        {"force", tool.force}, {"range", tool.range}, {"death_range", tool.death_range}, {"distance", tool.distance}};
    for (const auto& [name, value] : squared)
        expect(is_squared(value), "tools: {} has a {} of {}; right is 0 to 1.8e19, since it is squared", k, name,
               value);
}

void check_collider(const Collider& c, std::size_t k) {
    expect(is_finite(c.position) && is_finite(c.rotate), "colliders: {} has a position or rotate that is not finite",
           k);
    if (c.sphere)
        expect(c.radius > 0.0F && is_squared(c.radius),
               "colliders: sphere {} has radius {}; right is above 0, to 1.8e19", k, c.radius);
    for (int axis = 0; axis < 3 && !c.sphere; ++axis)
        expect(c.scale[axis] > 0.0F && std::isfinite(c.scale[axis]),
               "colliders: box {} has a scale.{} of {}; right is above 0", k, "xyz"[axis], c.scale[axis]);
}

void check_ball(const Ball& ball, std::size_t k) {
    expect(is_direction(ball.forward), "cannon: ball {} has no direction: forward has no length; right is one above 0",
           k);
    expect(ball.range > 0.0F && is_squared(ball.range),
           "cannon: ball {} has a range of {}; right is above 0, to 1.8e19, since it is squared", k, ball.range);
    expect(is_finite(ball.position) && std::isfinite(ball.speed) && std::isfinite(ball.force),
           "cannon: ball {} has a number that is not finite", k);
}

} // namespace

void check(const Settings& s) {
    expect(s.count >= 1 && s.count <= most_grains, "count is {}; right is 1 to {}, 65535 groups of 64", s.count,
           most_grains);
    expect(s.mass > 0.0F && std::isfinite(s.mass), "mass is {}; right is above 0: forces are divided by it", s.mass);
    expect(s.tick >= 0.0F && std::isfinite(s.tick), "tick is {} s; right is 0 or above", s.tick);
    expect(s.timescale >= 0.0F && s.timescale <= 1.0F, "timescale is {}; right is 0 to 1", s.timescale);
    expect(s.air_resistance >= 0.0F && std::isfinite(s.air_resistance), "air_resistance is {}; right is 0 or above",
           s.air_resistance);
    expect(s.scale > 0.0F && std::isfinite(s.scale), "scale is {}; right is above 0", s.scale);
    expect(is_finite(s.gravity), "gravity is {} {} {}; right is finite", s.gravity.x, s.gravity.y, s.gravity.z);
    expect(is_finite(s.colour_a) && is_finite(s.colour_b), "colours: a channel is not finite");
    expect(std::isfinite(s.switches.radius_of_scale) && s.switches.radius_of_scale >= 0.0F,
           "radius_of_scale is {}; right is 0 or above", s.switches.radius_of_scale);
    expect(s.elasticity >= 0.0F && s.elasticity <= 1.0F, "elasticity is {}; right is 0 to 1", s.elasticity);
    check_box("spawn", s.spawn);
    check_box("world", s.world);
    if (s.switches.random != Random::integer) {
        const float width = s.spawn.max.x - s.spawn.min.x;
        const float largest = static_cast<float>(s.count) / (width * width);
        expect(width > 0.0F && largest * 12.0F + 60.0F <= 32768.0F,
               "spawn: {} m wide in x, by which the sine hash divides; right is at least {} m, or random integer",
               width, std::sqrt(static_cast<float>(s.count) * 12.0F / 32700.0F));
    }
    check_controller(s.controller);
    for (std::size_t k = 0; k < s.tools.size(); ++k)
        check_tool(s.tools[k], k);
    for (std::size_t k = 0; k < s.colliders.size(); ++k)
        check_collider(s.colliders[k], k);
    for (std::size_t k = 0; k < s.cannon.size(); ++k)
        check_ball(s.cannon[k], k);
    const double dt = double{s.tick} * double{s.timescale};
    expect(s.cannon.empty() || dt == 0.0 || dt >= shortest_flight_step,
           "tick and timescale make a frame of {} s; right is 0 or at least {} s, as balls of a cannon fly for five",
           dt, shortest_flight_step);
    expect(s.switches.box_kind == BoxKind::aabb || s.switches.box_detect == BoxDetect::boxed,
           "box_detect rounded goes with box_kind aabb; right for obb is boxed");
}

} // namespace lockstep::dust
