#include <array>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "crosscheck/scene/surface.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "tests/collision/twin/compute_scenes.hpp"
#include "tests/collision/twin/random_scenes.hpp"
#include "tests/collision/twin/told_causes.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::depth_pass_twin_test {

namespace {

constexpr std::array presets{"corrected", "exact"};

/// A crowd that falls on a floor, a sphere and triangles of any direction.
Scene depth_scene(const char* base, std::size_t count = 1200) {
    Scene scene = test::crowded_scene(count);
    scene.switches = preset(base);
    scene.switches.search = Search::depth;
    scene.constants.surface_thickness = 0.15F;
    scene.constants.collision_time = 0.02F;
    scene.camera.eye = {0.3F, 0.7F, 2.5F};
    const Mesh pieces = test::RandomScenes(5).triangles(20, 0.5F, 0.3F);
    for (const std::uint32_t i : pieces.indices)
        scene.obstacles.indices.push_back(i + static_cast<std::uint32_t>(scene.obstacles.positions.size()));
    scene.obstacles.positions.insert(scene.obstacles.positions.end(), pieces.positions.begin(), pieces.positions.end());
    return scene;
}

/// Not one differing bit over some frames, of particles or depth; gives the report.
CheckReport check_agree(const Scene& scene, int frames = 4) {
    CheckReport report = test::check_twins(scene, frames);
    CHECK(report.verdict == Verdict::agree);
    CHECK(report.total.differing(collision::particles) == 0);
    CHECK(report.total.differing(collision::cdt) == 0);
    CHECK(report.frames == frames);
    CHECK(report.total[collision::position].compared == 3 * scene.start.size() * static_cast<std::size_t>(frames));
    return report;
}

} // namespace

TEST_CASE("depth pass twin: thirty frames from the same state, with either arithmetic, leave the same bits") {
    const auto context = test::open_compute();
    if (!context)
        return;
    for (const char* base : presets) {
        INFO(base);
        const CheckReport report = check_agree(depth_scene(base), 30);
        CHECK(report.hits > 500);
        CHECK(report.drawn_texels > 30U * 1000U);
    }
}

TEST_CASE("depth pass twin: left to themselves, both sides stay together") {
    const auto context = test::open_compute();
    if (!context)
        return;
    for (const char* base : presets) {
        INFO(base);
        const CheckReport report = test::check_twins(depth_scene(base), 60, {}, CheckMode::free);
        CHECK(report.verdict == Verdict::agree);
        CHECK(report.reference_hash == report.gpu_hash);
        CHECK(report.hits > 500);
    }
}

TEST_CASE("depth pass twin: every switch it knows, any thickness and any number of particles leave the same bits") {
    const auto context = test::open_compute();
    if (!context)
        return;
    for (const char* base : presets) {
        for (const auto& [name, value] : std::vector<std::pair<const char*, const char*>>{{"collision_step", "full"},
                                                                                          {"cdt_camera", "fixed"},
                                                                                          {"cdt_camera_offset", "0.5"},
                                                                                          {"obstacles_in_cdt", "off"},
                                                                                          {"speed_factor", "-1.25"},
                                                                                          {"speed_factor", "1e-39"}}) {
            Scene scene = depth_scene(base, 500);
            set_switch(scene.switches, name, value);
            INFO(fmt::format("{}, {} = {}", base, name, value));
            check_agree(scene);
        }
        for (const float thickness : {1.2e-38F, 1e-6F, 1.0F, 3e38F}) {
            Scene scene = depth_scene(base, 500);
            scene.constants.surface_thickness = thickness;
            INFO(base << ", " << thickness);
            check_agree(scene);
        }
        for (const std::size_t count : {1U, 63U, 64U, 65U, 5000U}) {
            INFO(count << " particles, " << base);
            check_agree(depth_scene(base, count));
        }
    }
}

TEST_CASE("depth pass twin: groups of any size step every particle") {
    const auto context = test::open_compute();
    if (!context)
        return;
    const Scene scene = depth_scene("corrected", 500);
    for (const int size : {1, 32, 96, 512}) {
        const test::TemporaryFolder shaders;
        test::plant(shaders, "depth_pass.comp", "local_size_x = 64", fmt::format("local_size_x = {}", size));
        INFO(size);
        CHECK(test::check_twins(scene, 4, shaders.path()).verdict == Verdict::agree);
    }
    const test::TemporaryFolder square;
    test::plant(square, "depth_pass.comp", "local_size_x = 64", "local_size_x = 8, local_size_y = 8");
    CHECK_THROWS_WITH(test::check_twins(scene, 4, square.path()),
                      Catch::StartsWith("depth_pass: local_size_y is 8 and local_size_z 1"));
}

TEST_CASE("depth pass twin: while the camera moves, both sides read the depth as it was drawn") {
    const auto context = test::open_compute();
    if (!context)
        return;
    for (const char* base : presets) {
        Scene scene = depth_scene(base);
        scene.camera_path = {{0, scene.camera.eye, scene.camera.target}, {20, {-0.8F, 1.0F, 2.0F}, {0.1F, 0.0F, 0.0F}}};
        INFO(base);
        CHECK(check_agree(scene, 20).hits > 200);
    }
}

TEST_CASE("depth pass twin: NaN, infinite, subnormal and huge states leave the same bits") {
    const auto context = test::open_compute();
    if (!context)
        return;
    using Limits = std::numeric_limits<float>;
    const std::array odd{0.0F,
                         -0.0F,
                         1e-40F,
                         -1e-40F,
                         Limits::min(),
                         -Limits::min(),
                         1e-20F,
                         1e20F,
                         -1e30F,
                         Limits::max(),
                         Limits::infinity(),
                         -Limits::infinity(),
                         Limits::quiet_NaN()};
    for (const char* base : presets) {
        Scene scene = depth_scene(base, 12 * odd.size() + 400);
        for (std::size_t k = 0; k < odd.size(); ++k)
            for (std::size_t c = 0; c < 12; ++c) {
                const std::size_t i = 12 * k + c;
                const auto axis = static_cast<glm::vec3::length_type>(c % 3);
                if (c < 3)
                    scene.start.position[i][axis] = odd[k];
                else if (c < 6)
                    scene.start.direction[i][axis] = odd[k];
                else if (c < 9)
                    scene.start.speed[i] = odd[k];
                else
                    scene.start.collide_time[i] = odd[k];
            }
        INFO(base);
        // Some compute stages compare subnormals otherwise than they compute with them: then either is legal.
        const Profile profile = test::llvmpipe_profile();
        const bool open = !in_compute_stage(measured_operations(profile), profile).subnormals;
        const CheckReport report = open ? test::check_twins(scene) : check_agree(scene);
        CHECK(report.verdict <= (open ? Verdict::legal : Verdict::agree));
        CHECK(report.total[collision::position].nan > 0);
        CHECK(report.hits > 0);
    }
}

TEST_CASE("depth pass twin: planted bugs are seen, and those that people make are named") {
    const auto context = test::open_compute();
    if (!context)
        return;
    const std::vector<std::tuple<const char*, std::string, std::string, std::string>> bugs{
        {"depth_pass.comp", "cross_product(sum(right, -here), sum(upper, -here))",
         "cross_product(sum(upper, -here), sum(right, -here))", "normal_reversed"},
        {"depth_pass.comp", "!(behind > 0.0) || !(behind < u_SurfaceThickness)", "!(behind > 0.0)",
         "thickness_not_tested"},
        {"depth_pass.comp", "!(behind > 0.0) || !(behind < u_SurfaceThickness)", "!(behind < u_SurfaceThickness)",
         "thickness_in_front"},
        {"depth_pass.comp", "if (stored.a == 0.0)\n        return false;", "", "empty_texels_shown"},
        {"depth_pass.comp", "texel + ivec2(1, 0)", "texel - ivec2(1, 0)", ""},
        {"depth_pass.comp", "texel + ivec2(0, 1)", "texel + ivec2(1, 1)", ""},
        {"depth_pass.comp", "ls_flush(stored.r)", "ls_flush(stored.r) * 0.999", ""},
        {"obstacle_pass.frag", "vec4(fragment.depth, 0.0", "vec4(gl_FragCoord.z + 1e-6, 0.0", ""},
    };
    const Scene scene = depth_scene("corrected", 2000);
    CHECK(test::check_twins(scene, 6).verdict == Verdict::agree);
    for (const auto& [file, text, replacement, cause] : bugs) {
        const test::TemporaryFolder shaders;
        test::plant(shaders, file, text, replacement);
        INFO(text << " -> " << replacement);
        const CheckReport report = test::check_twins(scene, 6, shaders.path());
        CHECK(report.verdict == Verdict::divergent);
        const std::vector<std::string> told = test::told_causes(report);
        if (!cause.empty())
            CHECK(told == std::vector{cause});
    }
}

} // namespace lockstep::test::depth_pass_twin_test
