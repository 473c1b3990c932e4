#pragma once
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include <lockstep/catch.hpp>
#include <lockstep/system.hpp>

#include "crosscheck/fluid/system.hpp"
#include "crosscheck/scene/scene_fields.hpp"
#include "crosscheck/scene/surface.hpp"
#include "gpu/fluid/passes.hpp"
#include "reference/model/fluid/schema.hpp"
#include "reference/model/random.hpp"
#include "tests/system_run.hpp"

namespace lockstep::test {

inline fluid::HostPtr host_of(fluid::Settings settings) {
    return std::make_shared<const fluid::Host>(std::move(settings));
}

inline fluid::Settings in_preset(fluid::Settings settings, const std::string& name) {
    settings.switches = fluid::preset(name);
    settings.shading = fluid::shading_numbers(name);
    settings.arithmetic = name == "exact" ? ArithmeticSwitch::exact : ArithmeticSwitch::plain;
    return settings;
}

/// Runs what comes before the first pass of this name, which it returns the number of.
inline std::size_t run_up_to(ReferenceRun& run, const System& system, std::string_view pass) {
    std::size_t p = 0;
    for (; system.passes[p]->name() != pass; ++p)
        run.step_pass(p, 0);
    return p;
}

/// Settings with these switches, each as --set has it.
inline fluid::Settings with(fluid::Settings s, const std::vector<std::string>& values) {
    std::vector<SwitchValue> all = switch_values(s.switches);
    for (const std::string& one : values)
        set_value(one, "fluid", all);
    take_values(s.switches, all);
    return s;
}

/// A heap of drops on a floor, partly behind a ball, among them some that are not seen: beside the image, behind the
/// camera, on its near plane, nowhere.
inline fluid::Settings heap(int side = 6) {
    fluid::Settings s;
    s.radius = 0.0625F;
    s.width = 44;
    s.height = 36;
    s.filter_radius = 4;
    s.flow_iterations = 4;
    s.camera = {.eye = {0.6F, 0.9F, 2.0F}, .target = {0.3F, 0.2F, 0.3F}, .near_plane = 0.125F, .far_plane = 40.0F};
    for (int z = 0; z < side; ++z)
        for (int y = 0; y < side / 2; ++y)
            for (int x = 0; x < side; ++x) {
                Random random(3, s.particles.size());
                const auto place = [&](int i) { return static_cast<float>(0.1 * i + 0.04 * random.symmetric()); };
                s.particles.emplace_back(place(x), place(y), place(z));
            }
    const float nowhere = std::numeric_limits<float>::quiet_NaN();
    s.particles.insert(s.particles.end(), {{9.0F, 0.0F, 0.0F},
                                           {0.9F, 1.5F, 4.0F},
                                           {0.58F, 0.84F, 1.87F},
                                           {0.3F, nowhere, 0.2F},
                                           {1.1F, 0.1F, 0.1F},
                                           {-0.5F, 0.4F, -0.3F}});
    place(plane_surface(20.0, 20.0), {}, s.obstacles);
    place(sphere_surface(0.2, 2), {.position = {0.55, 0.15, 0.7}}, s.obstacles);
    return s;
}

/// A run of settings on both sides.
inline CheckReport run_fluid(const fluid::Settings& settings, int frames, CheckMode mode = CheckMode::resync,
                             const std::string& shaders = "shaders/fluid") {
    const fluid::HostPtr host = host_of(settings);
    return run_system(fluid::system(host), fluid::passes(host), shaders, settings.arithmetic, frames, mode);
}

} // namespace lockstep::test
