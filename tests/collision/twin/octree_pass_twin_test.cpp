#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <glm/common.hpp>

#include "reference/model/collision/collision_state.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/random_scenes.hpp"
#include "tests/collision/twin/twin_scenes.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::octree_pass_twin_test {

namespace {

constexpr std::array presets{"paper", "corrected", "exact"};

/// The context if it is llvmpipe's and has compute shaders; else a skip.
std::optional<Context> open_compute(const std::string& name = test::software_gl()) {
    std::optional<Context> context = test::open_llvmpipe(name);
    if (!context || context->describe().compute)
        return context;
    test::skip(name + " has no compute shaders");
    return std::nullopt;
}

Scene octree_scene(const char* base, std::size_t count = 1200) {
    Scene scene = test::crowded_scene(count);
    scene.switches = preset(base);
    scene.switches.search = Search::octree;
    scene.constants.octree_size = 1.1F;
    return scene;
}

/// Puts every `stride`th particle on the sides of leaves, and has all search at once.
void on_sides(Scene& scene, std::size_t stride) {
    scene.constants.octree_size = 1.0F;
    for (std::size_t i = 0; i < scene.start.size(); ++i) {
        if (i % stride == 0)
            scene.start.position[i] = glm::round(scene.start.position[i] * 16.0F) * 0.0625F;
        scene.start.collide_time[i] = -1.0F;
    }
}

/// Not one differing bit over some frames; gives the report.
CheckReport check_agree(const Scene& scene, int frames = 4) {
    CheckReport report = test::check_twins(scene, frames);
    CHECK(report.verdict == Verdict::agree);
    CHECK(report.total.differing(collision::particles) == 0);
    CHECK(report.frames == frames);
    CHECK(report.total[collision::position].compared == 3 * scene.start.size() * static_cast<std::size_t>(frames));
    CHECK(report.drawn_texels == 0);
    return report;
}

} // namespace

TEST_CASE("octree pass twin: every switch it knows leaves the same bits") {
    const auto context = open_compute();
    if (!context)
        return;
    for (const char* base : presets)
        for (const auto& [name, value] :
             std::vector<std::pair<const char*, const char*>>{{"search", "octree"},
                                                              {"zero_distance", "hit"},
                                                              {"zero_distance", "skip"},
                                                              {"collision_step", "full"},
                                                              {"collision_step", "tick"},
                                                              {"obstacles_in_cdt", "off"},
                                                              {"obstacles_in_cdt", "vertices"},
                                                              {"arithmetic", "exact"},
                                                              {"speed_factor", "-1.25"},
                                                              {"speed_factor", "1e-39"}}) {
            Scene scene = octree_scene(base);
            set_switch(scene.switches, name, value);
            INFO(fmt::format("{}, {} = {}", base, name, value));
            CHECK(check_agree(scene).hits > 100);
        }
}

TEST_CASE("octree pass twin: any number of particles leaves the same bits") {
    const auto context = open_compute();
    if (!context)
        return;
    for (const std::size_t count : {1U, 2U, 63U, 64U, 65U, 5000U})
        for (const char* base : presets) {
            INFO(count << " particles, " << base);
            check_agree(octree_scene(base, count));
        }
}

TEST_CASE("octree pass twin: roots of any size leave the same bits, particles outside included") {
    const auto context = open_compute();
    if (!context)
        return;
    std::uint64_t widest = 0, narrowest = 0;
    for (const char* base : presets)
        for (const float size : {0.1F, 0.5F, 0.77F, 2.0F, 50.0F, 1e6F}) {
            Scene scene = octree_scene(base);
            scene.constants.octree_size = size;
            INFO(base << ", " << size);
            const std::uint64_t hits = check_agree(scene).hits;
            (size < 0.2F ? narrowest : widest) = hits;
        }
    CHECK(narrowest < widest / 10);
}

TEST_CASE("octree pass twin: positions on the sides of leaves leave the same bits") {
    const auto context = open_compute();
    if (!context)
        return;
    for (const char* base : presets) {
        Scene scene = octree_scene(base, 2000);
        on_sides(scene, 1);
        INFO(base);
        CHECK(check_agree(scene, 3).hits > 100);
    }
}

TEST_CASE("octree pass twin: NaN, infinite, subnormal and huge states leave the same bits") {
    const auto context = open_compute();
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
        Scene scene = octree_scene(base, 12 * odd.size() + 400);
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

TEST_CASE("octree pass twin: constants at their ends leave the same bits") {
    const auto context = open_compute();
    if (!context)
        return;
    for (const char* base : presets)
        for (const float extreme : {1.2e-38F, 1e-20F, 1e20F, 3e38F})
            for (float Constants::*constant :
                 {&Constants::tick, &Constants::collision_range, &Constants::collision_time}) {
                Scene scene = octree_scene(base, 500);
                scene.constants.*constant = extreme;
                INFO(base << ", " << extreme);
                check_agree(scene, 3);
            }
}

TEST_CASE("octree pass twin: left to themselves, both sides stay together") {
    const auto context = open_compute();
    if (!context)
        return;
    for (const char* base : presets) {
        INFO(base);
        const CheckReport report = test::check_twins(octree_scene(base), 40, {}, CheckMode::free);
        CHECK(report.verdict == Verdict::agree);
        CHECK(report.reference_hash == report.gpu_hash);
        CHECK(report.hits > 1000);
    }
}

TEST_CASE("octree pass twin: the same bits through EGL") {
    const auto context = open_compute("egl");
    if (!context)
        return;
    for (const char* base : presets) {
        INFO(base);
        CHECK(check_agree(octree_scene(base), 6).hits > 0);
    }
}

TEST_CASE("octree pass twin: planted bugs are seen") {
    const auto context = open_compute();
    if (!context)
        return;
    const std::vector<std::pair<std::string, std::string>> bugs{
        {"greaterThanEqual(p, nodes[node].box_min)", "greaterThan(p, nodes[node].box_min)"},
        {"if (entry == self)\n            continue;", "if (entry >= self)\n            continue;"},
        {" && len < particle_min_length", ""},
        {"u_CollisionRange > len", "u_CollisionRange * 0.99 > len"},
        {"uint end = first + nodes[leaf].entries;", "uint end = first + nodes[leaf].entries - 1u;"},
        {"uint first = 3u * (entry - u_ParticleCount);", "uint first = 3u * (entry - u_ParticleCount) + 3u;"},
        {"float settled(float x) { return (floatBitsToInt(x) & 0x7fffffff) > 0x00800000 ? x : 0.0; }",
         "float settled(float x) { return x + 0.01; }"},
        {"product(a.speed, u_SpeedFactor)", "a.speed"},
        {"ls_flush(a.collide_time) < 0.0", "ls_flush(a.collide_time) < 0.05"},
    };
    Scene scene = octree_scene("corrected", 2000);
    on_sides(scene, 2);
    CHECK(test::check_twins(scene, 6).verdict == Verdict::agree);
    for (const auto& [text, replacement] : bugs) {
        const test::TemporaryFolder shaders;
        test::plant(shaders, "octree_pass.comp", text, replacement);
        INFO(text);
        CHECK(test::check_twins(scene, 6, shaders.path()).verdict == Verdict::divergent);
    }
}

} // namespace lockstep::test::octree_pass_twin_test
