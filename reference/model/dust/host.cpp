#include "reference/model/dust/host.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace lockstep::dust {
namespace {

constexpr float constant_dt = 0.02F;
constexpr double ball_life = 5.0; // seconds

glm::dmat3 turned(const glm::vec3& degrees) {
    const glm::dvec3 angle = glm::dvec3(degrees) * (std::numbers::pi / 180.0);
    const double cx = std::cos(angle.x), sx = std::sin(angle.x), cy = std::cos(angle.y), sy = std::sin(angle.y);
    const double cz = std::cos(angle.z), sz = std::sin(angle.z);
    const glm::dmat3 about_x(1, 0, 0, 0, cx, sx, 0, -sx, cx), about_y(cy, 0, -sy, 0, 1, 0, sy, 0, cy);
    const glm::dmat3 about_z(cz, sz, 0, -sz, cz, 0, 0, 0, 1);
    return about_y * about_x * about_z;
}

ColliderMatrices matrices(const Collider& collider) {
    const glm::dvec3 scale = collider.sphere ? glm::dvec3(2.0 * collider.radius) : glm::dvec3(collider.scale);
    const glm::dmat3 turn = turned(collider.sphere ? glm::vec3(0.0F) : collider.rotate);
    const glm::dvec3 at(collider.position);
    glm::dmat4 to_world(1.0), to_local(1.0);
    const glm::dmat3 back = glm::transpose(turn);
    for (int c = 0; c < 3; ++c) {
        to_world[c] = glm::dvec4(turn[c] * scale[c], 0.0);
        to_local[c] = glm::dvec4(back[c] / scale, 0.0);
    }
    to_world[3] = glm::dvec4(at, 1.0);
    to_local[3] = glm::dvec4(-(back * at) / scale, 1.0);
    return {glm::mat4(to_world), glm::mat4(to_local), glm::vec3(scale)};
}

/// A frame of axes whose third is `forward`, at `position`.
glm::mat4 facing(const glm::dvec3& position, const glm::dvec3& forward) {
    glm::dvec3 right = glm::cross(glm::dvec3(0, 1, 0), forward);
    right = glm::length(right) > 0.0 ? glm::normalize(right) : glm::dvec3(1, 0, 0);
    const glm::dvec3 up = glm::cross(forward, right);
    return glm::mat4(
        glm::dmat4(glm::dvec4(right, 0), glm::dvec4(up, 0), glm::dvec4(forward, 0), glm::dvec4(position, 1)));
}

/// The cosine of a cone's half angle, and its tangent, as the source's host makes them.
float threshold_of(float degrees) { return static_cast<float>(std::cos(double{degrees * 0.0174532924F})); }

bool touches(const glm::dvec3& p, const Collider& collider, const ColliderMatrices& made) {
    if (collider.sphere)
        return glm::length(p - glm::dvec3(collider.position)) <= double{collider.radius};
    const glm::dvec3 local(glm::dmat4(made.world_to_local) * glm::dvec4(p, 1.0));
    return std::abs(local.x) <= 0.5 && std::abs(local.y) <= 0.5 && std::abs(local.z) <= 0.5;
}

} // namespace

Colliders colliders_of(const Settings& settings) {
    Colliders all;
    for (const bool sphere : {true, false}) {
        std::vector<ColliderMatrices>& list = sphere ? all.spheres : all.boxes;
        bool removed = false;
        for (const Collider& collider : settings.colliders)
            if (collider.sphere == sphere && collider.removed)
                removed = true;
            else if (collider.sphere == sphere)
                list.push_back(matrices(collider));
        // The buffer is gone and the count is still 1: what is read there is 0.
        if (removed && list.empty() && settings.switches.last_collider == LastCollider::zeros)
            list.push_back({glm::mat4(0.0F), glm::mat4(0.0F), glm::vec3(0.0F)});
    }
    return all;
}

Host::Host(Settings settings) : settings_(std::move(settings)) {
    check(settings_);
    if (switches().gravity_dir == GravityDir::down)
        settings_.gravity = {0.0F, settings_.gravity.y, 0.0F};
    colliders_ = colliders_of(settings_);
    for (const Ball& ball : settings_.cannon)
        if (const auto explosion = fly(ball))
            explosions_.push_back(*explosion);
    for (int i = 0; i < 4096; ++i)
        directions_.emplace_back(std::cos(2.0 * std::numbers::pi * i / 4096.0),
                                 std::sin(2.0 * std::numbers::pi * i / 4096.0));
}

FrameValues Host::at(int frame) const {
    FrameValues values;
    const auto& poses = settings_.controller;
    const auto next = std::find_if(poses.begin(), poses.end(), [&](const Pose& pose) { return pose.frame > frame; });
    const Pose& a = next == poses.begin() ? *next : *std::prev(next);
    const Pose& b = next == poses.end() ? poses.back() : *next;
    const double t = b.frame > a.frame ? double(frame - a.frame) / double(b.frame - a.frame) : 0.0;
    const glm::dvec3 at = glm::dvec3(a.position) + t * (glm::dvec3(b.position) - glm::dvec3(a.position));
    const glm::dvec3 forward =
        glm::normalize(glm::dvec3(a.forward) + t * (glm::dvec3(b.forward) - glm::dvec3(a.forward)));
    values.controller_pos = glm::vec3(at);
    values.controller_forward = glm::vec3(forward);
    values.controller_matrix = facing(at, forward);
    values.tool = tool_at(frame);
    if (const Tool* tool = values.tool) {
        values.sqr_force = tool->force * tool->force;
        values.sqr_range = tool->range * tool->range;
        values.threshold = threshold_of(tool->angle);
        const bool unset = switches().death_range == DeathRange::unset && has_update();
        values.sqr_death_range = unset ? 0.0F : tool->death_range * tool->death_range;
        values.angle_rad = tool->angle * 0.0174532924F;
        values.tangent = static_cast<float>(std::tan(double{values.angle_rad}));
    }
    values.frame = frame;
    values.dt = settings_.tick * settings_.timescale;
    values.time = static_cast<float>(double(frame) * double{values.dt});
    const bool constant = switches().impulse_dt != ImpulseDt::frame;
    values.tool_dt = values.explosion_dt = constant ? constant_dt : values.dt;
    values.wind_dt = switches().impulse_dt == ImpulseDt::constant ? constant_dt : values.dt;
    return values;
}

const Tool* Host::tool_at(int frame) const {
    for (const Tool& tool : settings_.tools)
        if (tool.from <= frame && frame < tool.to)
            return &tool;
    return nullptr;
}

bool Host::is_on(Tool::Kind kind, int frame) const {
    const Tool* tool = tool_at(frame);
    return tool != nullptr && tool->kind == kind;
}

int Host::pulled_in(int frame) const {
    const bool before_tools =
        switches().suction == Suction::force_kernel && switches().kernel_order == KernelOrder::update_first;
    return before_tools ? frame - 1 : frame;
}

bool Host::update_may_kill() const {
    return switches().suction == Suction::force_in_update ||
           (switches().suction == Suction::force_kernel && switches().forecast == Forecast::moved);
}

bool Host::update_kills(int frame) const {
    return update_may_kill() && pulled_in(frame) >= 0 && is_on(Tool::Kind::vacuum, pulled_in(frame));
}

bool Host::has(Tool::Kind kind) const {
    return std::any_of(settings_.tools.begin(), settings_.tools.end(), [&](const Tool& t) { return t.kind == kind; });
}

const Explosion* Host::explosion(int frame, std::size_t ball) const {
    for (const Explosion& one : explosions_)
        if (one.frame == frame && ball-- == 0)
            return &one;
    return nullptr;
}

std::size_t Host::most_explosions() const {
    std::size_t most = 0;
    for (const Explosion& one : explosions_) {
        std::size_t of_frame = 0;
        for (const Explosion& other : explosions_)
            of_frame += other.frame == one.frame ? 1 : 0;
        most = std::max(most, of_frame);
    }
    return most;
}

std::optional<Explosion> Host::fly(const Ball& ball) const {
    const double dt = double{settings_.tick} * double{settings_.timescale};
    glm::dvec3 position(ball.position);
    glm::dvec3 velocity = glm::normalize(glm::dvec3(ball.forward)) * double{ball.speed};
    std::vector<std::pair<Collider, ColliderMatrices>> obstacles;
    for (const Collider& collider : settings_.colliders)
        if (!collider.removed)
            obstacles.emplace_back(collider, matrices(collider));
    for (int step = 0; step * dt < ball_life && dt > 0.0; ++step) {
        velocity += glm::dvec3(settings_.gravity) * dt;
        position += velocity * dt;
        bool hit = glm::any(glm::lessThan(position, glm::dvec3(settings_.world.min))) ||
                   glm::any(glm::greaterThan(position, glm::dvec3(settings_.world.max)));
        for (const auto& [collider, made] : obstacles)
            hit = hit || touches(position, collider, made);
        if (hit)
            return Explosion{ball.frame + step + 1, glm::vec3(position), ball.range * ball.range, ball.force};
    }
    return {};
}

} // namespace lockstep::dust
