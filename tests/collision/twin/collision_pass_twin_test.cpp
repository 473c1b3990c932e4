#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/collision/switches.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/random_scenes.hpp"
#include "tests/collision/twin/twin_scenes.hpp"

namespace lockstep::test::collision_pass_twin_test {

using test::crowded_scene;

namespace {

constexpr std::array presets{"paper", "corrected", "exact"};

/// Not one differing bit over some frames; gives the report.
CheckReport check_agree(const Scene& scene, int frames = 4) {
    CheckReport report = test::check_twins(scene, frames);
    CHECK(report.verdict == Verdict::agree);
    CHECK(report.total.differing(collision::particles) == 0);
    CHECK(report.total.differing(collision::cdt) == 0);
    CHECK(report.frames == frames);
    CHECK(report.total[collision::position].compared == 3 * scene.start.size() * static_cast<std::size_t>(frames));
    return report;
}

Scene with_preset(Scene scene, const char* name) {
    scene.switches = preset(name);
    return scene;
}

/// Values that a step has to answer alike on both sides, however little sense they make.
const std::vector<float>& odd_values() {
    using Limits = std::numeric_limits<float>;
    static const std::vector<float> values{0.0F,
                                           -0.0F,
                                           0.25F,
                                           1e-40F,
                                           -1e-40F,
                                           Limits::denorm_min(),
                                           Limits::min(),
                                           -Limits::min(),
                                           1e-20F,
                                           1e20F,
                                           -1e30F,
                                           Limits::max(),
                                           -Limits::max(),
                                           Limits::infinity(),
                                           -Limits::infinity(),
                                           Limits::quiet_NaN()};
    return values;
}

/// The crowd, each field of some of its particles replaced: particle 12 k + c gets value k in component c.
Scene odd_scene() {
    Scene scene = crowded_scene(12 * odd_values().size() + 400);
    for (std::size_t k = 0; k < odd_values().size(); ++k)
        for (std::size_t c = 0; c < 12; ++c) {
            const std::size_t i = 12 * k + c;
            const float value = odd_values()[k];
            const auto axis = static_cast<glm::vec3::length_type>(c % 3);
            switch (c / 3) {
            case 0:
                scene.start.position[i][axis] = value;
                break;
            case 1:
                scene.start.direction[i][axis] = value;
                break;
            case 2:
                scene.start.speed[i] = value;
                scene.start.direction[i] = axis == 0 ? glm::vec3(0.0F) : scene.start.direction[i];
                break;
            default:
                scene.start.collide_time[i] = value;
                scene.start.position[i] = axis == 0 ? glm::vec3(value) : scene.start.position[i];
            }
        }
    return scene;
}

} // namespace

TEST_CASE("collision pass twin: every value of every switch leaves the same bits") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const Scene scene = crowded_scene();
    for (const char* base : presets) {
        const Switches switches = preset(base);
        INFO(base);
        CHECK(check_agree(with_preset(scene, base)).hits > 0);
        for (const SwitchInfo& info : switch_table()) {
            if (chooses_pass(info.name))
                continue;
            std::vector<std::string> values(info.values.begin(), info.values.end());
            if (info.number != nullptr)
                values = {"0", "0.5", "-1.25", "1e-39"};
            for (const std::string& value : values) {
                if (value == switch_value(switches, info.name))
                    continue;
                Scene changed = with_preset(scene, base);
                set_switch(changed.switches, info.name, value);
                INFO(fmt::format("{} = {}", info.name, value));
                CHECK(check_agree(changed, 3).drawn_texels > 0);
            }
        }
    }
}

TEST_CASE("collision pass twin: switches in any combination leave the same bits") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    std::mt19937 random(11);
    Scene scene = crowded_scene(600, 64, 97);
    for (int round = 0; round < 16; ++round) {
        std::string chosen;
        for (const SwitchInfo& info : switch_table())
            if (!info.values.empty() && !chooses_pass(info.name)) {
                const std::string value(info.values[random() % info.values.size()]);
                set_switch(scene.switches, info.name, value);
                chosen += fmt::format(" {}={}", info.name, value);
            }
        INFO(chosen);
        check_agree(scene, 3);
    }
}

TEST_CASE("collision pass twin: every format at every radius leaves the same codes") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for (const char* base : presets)
        for (const char* format : {"rgba32f", "rgba16f", "rgba8"})
            for (const int radius : {0, 1, 2, 4}) {
                Scene scene = with_preset(crowded_scene(), base);
                set_switch(scene.switches, "cdt_format", format);
                scene.constants.texel_collide_range = radius;
                INFO(fmt::format("{}, {}, radius {}", base, format, radius));
                const CheckReport report = check_agree(scene);
                CHECK((report.hits > 0) == (radius > 0));
            }
}

TEST_CASE("collision pass twin: images of any shape and size leave the same bits") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for (const auto& [width, height] :
         {std::pair{1, 1}, {1, 200}, {203, 1}, {97, 31}, {31, 97}, {640, 360}, {500, 500}})
        for (const char* base : presets) {
            INFO(fmt::format("{} x {}, {}", width, height, base));
            check_agree(with_preset(crowded_scene(800, width, height), base), 3);
        }
}

TEST_CASE("collision pass twin: any number of particles leaves the same bits") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for (const std::size_t count : {1U, 2U, 3U, 31U, 4097U})
        for (const char* base : presets) {
            INFO(count << " particles, " << base);
            check_agree(with_preset(crowded_scene(count), base), 3);
        }
}

TEST_CASE("collision pass twin: particles outside the image and behind the camera leave the same bits") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for (const char* base : presets) {
        Scene scene = with_preset(crowded_scene(3000), base);
        test::RandomScenes random(3);
        for (std::size_t i = 0; i < 2000; ++i)
            scene.start.position[i] = random.position(i < 1000 ? 2.0F : 8.0F);
        for (std::size_t i = 0; i < 64; ++i)
            scene.start.position[i] = scene.camera.eye; // w = 0
        INFO(base);
        CHECK(check_agree(scene).hits > 0);
        scene.camera.near_plane = 2.9F;
        scene.camera.far_plane = 3.1F;
        CHECK(check_agree(scene).hits > 0);
    }
}

TEST_CASE("collision pass twin: NaN, infinite, subnormal and huge states leave the same bits") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for (const char* base : presets)
        for (const char* format : {"rgba32f", "rgba16f", "rgba8"}) {
            Scene scene = with_preset(odd_scene(), base);
            set_switch(scene.switches, "cdt_format", format);
            INFO(base << ", " << format);
            const CheckReport report = check_agree(scene);
            CHECK(report.total[collision::position].nan > 0);
            CHECK(report.hits > 0);
        }
}

TEST_CASE("collision pass twin: constants at their ends leave the same bits") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for (const char* base : presets)
        for (const float extreme : {1.2e-38F, 1e-20F, 1e20F, 3e38F}) {
            INFO(base << ", " << extreme);
            for (float Constants::*constant :
                 {&Constants::tick, &Constants::collision_range, &Constants::collision_time}) {
                Scene scene = with_preset(crowded_scene(500), base);
                scene.constants.*constant = extreme;
                check_agree(scene, 3);
            }
            Scene scene = with_preset(crowded_scene(500), base);
            scene.constants.gravity = {extreme, -extreme, 0.0F};
            check_agree(scene, 3);
        }
}

TEST_CASE("collision pass twin: a fixed, an offset and a moving camera leave the same bits") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for (const char* base : presets) {
        INFO(base);
        Scene moving = with_preset(crowded_scene(), base);
        moving.camera_path = {
            {0, {0.0F, 0.0F, 3.0F}, {}}, {3, {1.5F, 1.0F, 2.0F}, {0.1F, 0.0F, 0.0F}}, {6, {-1.0F, 2.0F, -2.0F}, {}}};
        moving.collision_camera.eye = {2.0F, 0.5F, 1.0F};
        CHECK(check_agree(moving, 8).hits > 0);
        Scene fixed = moving;
        fixed.switches.cdt_camera = CdtCamera::fixed;
        CHECK(check_agree(fixed, 8).hits > 0);
        Scene offset = moving;
        offset.switches.cdt_camera_offset = 0.75F;
        CHECK(check_agree(offset, 8).hits > 0);
    }
}

TEST_CASE("collision pass twin: left to themselves, both sides stay together") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for (const char* base : presets) {
        INFO(base);
        const CheckReport report = test::check_twins(with_preset(crowded_scene(), base), 40, {}, CheckMode::free);
        CHECK(report.verdict == Verdict::agree);
        CHECK(report.reference_hash == report.gpu_hash);
        CHECK(report.hits > 0);
    }
}

TEST_CASE("collision pass twin: the same bits through EGL") {
    const auto context = test::open_llvmpipe("egl");
    if (!context)
        return;
    for (const char* base : presets) {
        INFO(base);
        CHECK(check_agree(with_preset(crowded_scene(), base), 6).hits > 0);
        check_agree(with_preset(odd_scene(), base));
    }
}

} // namespace lockstep::test::collision_pass_twin_test
