#include <array>
#include <limits>
#include <random>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/random_scenes.hpp"
#include "tests/collision/twin/twin_scenes.hpp"

namespace lockstep::test::layered_collision_pass_twin_test {

using test::crowded_scene;

namespace {

constexpr std::array presets{"corrected", "exact"};

using Settings = std::vector<std::pair<const char*, const char*>>;

const std::array combinations{
    Settings{{"cdt_layers", "2"}},
    Settings{{"cdt_layers", "8"}, {"search_window", "projected"}},
    Settings{{"search_window", "projected"}},
    Settings{{"cdt_cameras", "2"}, {"cdt_layers", "3"}},
    Settings{{"response", "mutual"}},
    Settings{{"response", "mutual"}, {"cdt_layers", "4"}, {"search_window", "projected"}},
};

Scene with(Scene scene, const char* base, const Settings& settings) {
    scene.switches = preset(base);
    for (const auto& [name, value] : settings)
        set_switch(scene.switches, name, value);
    return scene;
}

CheckReport check_agree(const Scene& scene, int frames = 4, CheckMode mode = CheckMode::resync) {
    const CheckReport report = test::check_twins(scene, frames, {}, mode);
    CHECK(report.verdict == Verdict::agree);
    CHECK(report.total.differing(collision::particles) == 0);
    CHECK(report.total.differing(collision::cdt) == 0);
    return report;
}

/// Calls `check(settings)` for every combination, with both presets.
template <class Check> void for_each_combination(const Check& check) {
    for (const char* base : presets)
        for (const Settings& settings : combinations) {
            std::string text = base;
            for (const auto& [name, value] : settings)
                text += fmt::format(" {}={}", name, value);
            INFO(text);
            check(base, settings);
        }
}

} // namespace

TEST_CASE("layered collision pass twin: every combination of remedies leaves the same bits") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for_each_combination([](const char* base, const Settings& settings) {
        const CheckReport report = check_agree(with(crowded_scene(), base, settings), 6);
        CHECK(report.hits > 0);
        CHECK(report.drawn_texels > 0);
    });
}

TEST_CASE("layered collision pass twin: every number of layers, with every other switch, leaves the same bits") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    std::mt19937 random(3);
    const auto any = [&](std::string_view name, Switches& switches) {
        for (const SwitchInfo& info : switch_table())
            if (info.name == name)
                set_switch(switches, name, info.values[random() % info.values.size()]);
    };
    for (int layers = 2; layers <= 8; ++layers)
        for (int round = 0; round < 3; ++round) {
            Scene scene = crowded_scene(700, 64, 97);
            scene.switches.cdt_layers = layers;
            for (const char* name : {"cdt_format", "cdt_cameras", "search_window", "collision_step", "cdt_camera",
                                     "obstacles_in_cdt", "arithmetic"})
                any(name, scene.switches);
            if (scene.switches.cdt_format != CdtFormat::rgba8 && scene.switches.cdt_cameras == 1)
                any("response", scene.switches);
            scene.constants.texel_collide_range = round + 1;
            INFO(layers << " layers, round " << round);
            check_agree(scene, 3);
        }
}

TEST_CASE("layered collision pass twin: particles at one depth in one texel leave the same layers") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for_each_combination([](const char* base, const Settings& settings) {
        Scene scene = with(crowded_scene(900, 12, 9), base, settings);
        for (std::size_t i = 0; i < scene.start.size(); ++i) {
            scene.start.position[i].z = 0.25F * static_cast<float>(i % 3);
            scene.start.direction[i] = {1.0F, 0.0F, 0.0F};
            if (i % 4 == 3)
                scene.start.set(i, scene.start[i - 1]); // coincident
        }
        scene.constants.gravity = glm::vec3(0.0F);
        check_agree(scene, 5);
    });
}

TEST_CASE("layered collision pass twin: images of any shape and size leave the same bits") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 200}, {203, 1}, {97, 31}, {640, 360}})
        for_each_combination([&, w = width, h = height](const char* base, const Settings& settings) {
            INFO(w << " x " << h);
            check_agree(with(crowded_scene(500, w, h), base, settings), 3);
        });
}

TEST_CASE("layered collision pass twin: odd states and places leave the same bits") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    using Limits = std::numeric_limits<float>;
    constexpr std::array odd{0.0F,          -0.0F,          1e-40F, -1e-40F, Limits::min(),      1e-20F,
                             Limits::max(), -Limits::max(), 1e20F,  -1e30F,  Limits::infinity(), Limits::quiet_NaN()};
    for_each_combination([&](const char* base, const Settings& settings) {
        Scene scene = with(crowded_scene(1500), base, settings);
        test::RandomScenes random(3);
        for (std::size_t i = 0; i < 300; ++i)
            scene.start.position[i] = random.position(i < 150 ? 2.0F : 8.0F);
        for (std::size_t i = 300; i < 320; ++i)
            scene.start.position[i] = scene.camera.eye; // w = 0
        for (std::size_t k = 0; k < odd.size(); ++k)
            for (std::size_t c = 0; c < 12; ++c) {
                ParticleState state = scene.start[400 + 12 * k + c];
                const auto axis = static_cast<glm::vec3::length_type>(c % 3);
                if (c < 3)
                    state.position[axis] = odd[k];
                else if (c < 6)
                    state.direction[axis] = odd[k];
                else if (c < 9)
                    state.speed = odd[k];
                else
                    state.collide_time = odd[k];
                scene.start.set(400 + 12 * k + c, state);
            }
        const CheckReport report = check_agree(scene);
        CHECK(report.hits > 0);
        CHECK(report.total[collision::position].nan > 0);
    });
}

TEST_CASE("layered collision pass twin: moving, fixed and offset cameras leave the same bits") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for_each_combination([](const char* base, const Settings& settings) {
        Scene scene = with(crowded_scene(), base, settings);
        scene.camera_path = {{0, {0.0F, 0.0F, 3.0F}, {}}, {4, {1.5F, 1.0F, 2.0F}, {0.1F, 0.0F, 0.0F}}};
        scene.collision_camera.eye = {2.0F, 0.5F, 1.0F};
        check_agree(scene);
        scene.switches.cdt_camera_offset = 0.75F;
        check_agree(scene);
        scene.switches.cdt_camera = CdtCamera::fixed;
        check_agree(scene);
    });
}

TEST_CASE("layered collision pass twin: left to themselves, both sides stay together") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for_each_combination([](const char* base, const Settings& settings) {
        const CheckReport report = check_agree(with(crowded_scene(), base, settings), 30, CheckMode::free);
        CHECK(report.reference_hash == report.gpu_hash);
    });
}

TEST_CASE("layered collision pass twin: the same bits through EGL") {
    const auto context = test::open_llvmpipe("egl");
    if (!context)
        return;
    for_each_combination([](const char* base, const Settings& settings) {
        CHECK(check_agree(with(crowded_scene(), base, settings), 6).hits > 0);
    });
}

} // namespace lockstep::test::layered_collision_pass_twin_test
