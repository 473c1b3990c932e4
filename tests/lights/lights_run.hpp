#pragma once
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include <lockstep/catch.hpp>
#include <lockstep/system.hpp>

#include "crosscheck/lights/system.hpp"
#include "crosscheck/scene/surface.hpp"
#include "gpu/lights/passes.hpp"
#include "reference/model/lights/schema.hpp"
#include "reference/model/random.hpp"
#include "tests/system_run.hpp"

namespace lockstep::test {

inline lights::HostPtr host_of(lights::Settings settings) {
    return std::make_shared<const lights::Host>(std::move(settings));
}

inline lights::Settings in_preset(lights::Settings settings, const std::string& name) {
    settings.switches = lights::preset(name);
    settings.arithmetic = name == "exact" ? ArithmeticSwitch::exact : ArithmeticSwitch::plain;
    return settings;
}

inline void add_surface(lights::Settings& s, const Surface& surface, glm::dvec3 position, glm::ivec3 albedo) {
    place(surface, {.position = position}, s.obstacles.mesh);
    s.obstacles.albedo.resize(s.obstacles.mesh.triangle_count(), albedo);
}

/// A small room: a floor, a box and a ball among lights that move, some of which begin outside.
inline lights::Settings room(std::size_t count = 24) {
    lights::Settings s;
    s.grid = {.size = {16, 8, 16}, .voxel = 1.0F, .origin = {-8.0F, 0.0F, -8.0F}};
    for (std::size_t i = 0; i < count; ++i) {
        Random random(7, i);
        lights::Light light;
        light.position = {static_cast<float>(8.5 * random.symmetric()), static_cast<float>(7.5 * random.unit() + 0.25),
                          static_cast<float>(8.5 * random.symmetric())};
        const glm::dvec3 way(random.symmetric(), random.symmetric(), random.symmetric() + 0.01);
        light.direction = glm::vec3(way / std::sqrt(way.x * way.x + way.y * way.y + way.z * way.z));
        light.speed = static_cast<float>(4.0 + 30.0 * random.unit());
        light.range = static_cast<float>(1.5 + 2.0 * random.unit());
        light.colour = {static_cast<float>(random.unit()), static_cast<float>(random.unit()),
                        static_cast<float>(random.unit())};
        s.lights.push_back(light);
    }
    add_surface(s, plane_surface(14.0, 14.0), {0.0, 1.0, 0.0}, {192, 192, 128});
    add_surface(s, box_surface({2.0, 4.0, 3.0}), {-3.0, 3.0, -2.0}, {240, 64, 32});
    add_surface(s, sphere_surface(1.5, 3), {3.5, 3.0, 1.0}, {64, 200, 255});
    s.camera = {.eye = {2.0F, 9.0F, 16.0F}, .target = {0.0F, 2.0F, 0.0F}, .near_plane = 0.5F, .far_plane = 60.0F};
    s.width = 48;
    s.height = 32;
    s.glow_radius = 0.6F;
    s.glow_gain = 0.5F;
    return s;
}

/// A run of settings on both sides.
inline CheckReport run_lights(const lights::Settings& settings, int frames, CheckMode mode = CheckMode::resync,
                              const std::string& shaders = "shaders/lights") {
    const lights::HostPtr host = host_of(settings);
    return run_system(lights::system(host), lights::passes(host), shaders, settings.arithmetic, frames, mode);
}

} // namespace lockstep::test
