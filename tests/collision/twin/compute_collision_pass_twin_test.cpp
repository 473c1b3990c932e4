#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "crosscheck/collision/judge/step_table.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"
#include "reference/model/state_hash.hpp"
#include "tests/collision/twin/compute_scenes.hpp"
#include "tests/collision/twin/shader_files.hpp"
#include "tests/collision/twin/twin_scenes.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::compute_collision_pass_twin_test {

using test::compute_scene;
using test::open_compute;

namespace {

constexpr std::array presets{"paper", "corrected", "exact"};

/// Not one differing bit over some frames; gives the report.
CheckReport check_agree(const Scene& scene, int frames = 4, const std::filesystem::path& shaders = {}) {
    CheckReport report = test::check_twins(scene, frames, shaders);
    CHECK(report.verdict == Verdict::agree);
    CHECK(report.total.differing(collision::particles) == 0);
    CHECK(report.total.differing(collision::cdt) == 0);
    CHECK(report.frames == frames);
    return report;
}

/// The hash of every frame that GL runs by itself.
std::vector<std::uint64_t> hashes(Scene scene, Step step, int frames) {
    scene.switches.step = step;
    GpuSimulation gpu(scene, "");
    std::vector<std::uint64_t> all;
    Particles particles;
    CollisionImage cdt;
    for (int frame = 0; frame < frames; ++frame) {
        gpu.step(frame_params(scene, frame));
        gpu.read(particles);
        gpu.read(cdt);
        all.push_back(state_hash(particles, cdt));
    }
    return all;
}

/// Particles a little beside each other, equally deep: of those in a texel the index alone decides.
Scene one_place(const char* base, std::size_t count) {
    Scene scene = compute_scene(base, count);
    scene.camera.eye = {0.0F, 0.0F, 2.0F};
    scene.camera.target = {0.0F, 0.0F, 0.0F};
    scene.obstacles = {};
    scene.constants.gravity = {0.0F, 0.0F, 0.0F};
    for (std::size_t i = 0; i < count; ++i) {
        scene.start.position[i] = {0.1F + 1e-5F * static_cast<float>(i % 97), 0.3F, 0.25F};
        scene.start.direction[i] = {0.0F, 1.0F, 0.0F};
        scene.start.speed[i] = 1e-3F * static_cast<float>(i % 4);
    }
    return scene;
}

} // namespace

TEST_CASE("compute collision pass twin: every switch leaves the same bits") {
    const auto context = open_compute();
    if (!context)
        return;
    for (const char* base : presets)
        for (const SwitchInfo& info : switch_table()) {
            if (chooses_pass(info.name))
                continue;
            std::vector<std::string> values(info.values.begin(), info.values.end());
            if (values.empty())
                values = {"-1.25"};
            for (const std::string& value : values) {
                Scene scene = compute_scene(base, 700);
                set_switch(scene.switches, info.name, value);
                scene.cdt_box = {glm::vec3(-1.0F), glm::vec3(1.0F)};
                INFO(fmt::format("{}, {} = {}", base, info.name, value));
                CHECK(check_agree(scene).drawn_texels > 100);
            }
        }
}

TEST_CASE("compute collision pass twin: any number of particles leaves the same bits") {
    const auto context = open_compute();
    if (!context)
        return;
    for (const std::size_t count : {1U, 2U, 63U, 64U, 65U, 127U, 128U, 129U, 5000U})
        for (const char* base : presets) {
            INFO(count << " particles, " << base);
            check_agree(compute_scene(base, count));
        }
}

TEST_CASE("compute collision pass twin: images of any size and windows of any radius leave the same bits") {
    const auto context = open_compute();
    if (!context)
        return;
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 97}, {97, 1}, {65, 63}, {500, 3}, {33, 250}})
        for (const int radius : {0, 1, 8}) {
            Scene scene = compute_scene("paper", 500, width, height);
            scene.constants.texel_collide_range = radius;
            INFO(width << " x " << height << ", radius " << radius);
            check_agree(scene);
            scene.switches = preset("exact");
            scene.switches.step = Step::compute;
            check_agree(scene);
        }
}

TEST_CASE("compute collision pass twin: of particles at one place the first is drawn") {
    const auto context = open_compute();
    if (!context)
        return;
    for (const char* base : presets)
        for (const std::size_t count : {2U, 64U, 3000U}) {
            INFO(base << ", " << count);
            check_agree(one_place(base, count), 6);
        }
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.comp", "#ifdef LOCKSTEP_INT64_ATOMICS", "#if 0");
    test::plant(shaders, "nearest_particle.comp", "atomicMin(nearest[2u * offer.x], self);",
                "atomicCompSwap(nearest[2u * offer.x], nowhere, 0u), atomicMax(nearest[2u * offer.x], self);");
    const CheckReport last = test::check_twins(one_place("corrected", 300), 3, shaders.path());
    REQUIRE(last.verdicts);
    CHECK(last.verdict == Verdict::divergent);
    CHECK(last.verdicts->causes[collision::cdt].explains_all()); // all are equally deep: any order of them
}

TEST_CASE("compute collision pass twin: nothing within the range hits nothing") {
    const auto context = open_compute();
    if (!context)
        return;
    for (const char* base : presets) {
        Scene scene = compute_scene(base);
        scene.constants.collision_range = 0.0F;
        CHECK(check_agree(scene).hits == 0);
    }
}

TEST_CASE("compute collision pass twin: NaN, infinite, subnormal and huge states leave the same bits") {
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
        Scene scene = compute_scene(base, 12 * odd.size() + 400);
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
        const Profile profile = test::llvmpipe_profile();
        const bool open = !in_compute_stage(measured_operations(profile), profile).subnormals;
        const CheckReport report = open ? test::check_twins(scene) : check_agree(scene);
        CHECK(report.verdict <= (open ? Verdict::legal : Verdict::agree));
        CHECK(report.total[collision::position].nan > 0);
    }
}

TEST_CASE("compute collision pass twin: in exact arithmetic transform feedback and compute come to one hash") {
    const auto context = open_compute();
    if (!context)
        return;
    Scene crowd = compute_scene("exact");
    CHECK(hashes(crowd, Step::compute, 100) == hashes(crowd, Step::transform_feedback, 100));
    for (const CdtFormat format : {CdtFormat::rgba16f, CdtFormat::rgba8}) {
        crowd.switches.cdt_format = format;
        crowd.cdt_box = {glm::vec3(-1.0F), glm::vec3(1.0F)};
        CHECK(hashes(crowd, Step::compute, 12) == hashes(crowd, Step::transform_feedback, 12));
    }
    for (const char* name : {"lattice", "x_streams"}) {
        const Scene scene =
            load_scene(std::string("data/scenes/") + name + ".json", {.particles = 3000, .preset = "exact", .set = {}});
        INFO(name);
        const std::vector<std::uint64_t> compute = hashes(scene, Step::compute, 100);
        CHECK(compute == hashes(scene, Step::transform_feedback, 100));
        CHECK(compute.front() != compute.back());
    }
}

TEST_CASE("compute collision pass twin: left to themselves, both sides stay together") {
    const auto context = open_compute();
    if (!context)
        return;
    for (const char* base : presets) {
        INFO(base);
        const CheckReport report = test::check_twins(compute_scene(base), 40, {}, CheckMode::free);
        CHECK(report.verdict == Verdict::agree);
        CHECK(report.reference_hash == report.gpu_hash);
        CHECK(report.hits > 1000);
    }
}

TEST_CASE("compute collision pass twin: the same bits through EGL") {
    const auto context = open_compute("egl");
    if (!context)
        return;
    for (const char* base : presets) {
        INFO(base);
        CHECK(check_agree(compute_scene(base), 6).hits > 0);
    }
}

TEST_CASE("compute collision pass twin: the lowest index is found in two passes or in one") {
    const auto context = open_compute();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.comp", "#ifdef LOCKSTEP_INT64_ATOMICS", "#if 0");
    for (const char* base : presets) {
        check_agree(one_place(base, 300), 4, shaders.path());
        check_agree(compute_scene(base), 4, shaders.path());
    }
}

TEST_CASE("compute collision pass twin: a right shader in another style agrees") {
    const auto context = open_compute();
    if (!context)
        return;
    const std::vector<std::filesystem::path> files = test::files_in("tests/collision/right_compute");
    CHECK(files.size() >= 2);
    for (const std::filesystem::path& file : files) {
        const test::TemporaryFolder shaders;
        shaders.write("collision_pass.comp", test::content(file));
        INFO(file);
        const CheckReport report = test::check_twins(compute_scene("corrected"), 6, shaders.path());
        CHECK((report.verdict == Verdict::agree || report.verdict == Verdict::legal));
        CHECK(report.hits > 100);
        CHECK(report.drawn_texels > 100);
    }
}

TEST_CASE("compute collision pass twin: planted bugs are seen") {
    const auto context = open_compute();
    if (!context)
        return;
    struct Bug {
        std::string file, text, replacement;
    };
    const std::vector<Bug> bugs{
        {"collision_pass.comp", " && len < particle_min_length", ""},
        {"collision_pass.comp", "u_CollisionRange > len", "u_CollisionRange * 0.99 > len"},
        {"collision_pass.comp", "product(a.speed, u_SpeedFactor)", "a.speed"},
        {"collision_pass.comp", "ls_flush(a.collide_time) < 0.0", "ls_flush(a.collide_time) < 0.09"},
        {"collision_pass.comp", "    offer_to_texel(self, clip);\n", ""},
        {"nearest_particle.glsl", "(ls_divide(clip.z, clip.w) + 1.0) * 0.5", "(1.0 - ls_divide(clip.z, clip.w)) * 0.5"},
        {"collision_texels.frag", "after[particle].position", "after[particle].direction"},
        {"collision_texels.frag", "uintBitsToFloat(nearest[2u * texel + 1u])", "0.0"},
    };
    const Scene scene = compute_scene("corrected", 2000);
    CHECK(test::check_twins(scene, 6).verdict == Verdict::agree);
    for (const auto& [file, text, replacement] : bugs) {
        const test::TemporaryFolder shaders;
        test::plant(shaders, file, text, replacement);
        INFO(text);
        CHECK(test::check_twins(scene, 6, shaders.path()).verdict == Verdict::divergent);
    }
    const test::TemporaryFolder turned;
    test::plant(turned, "nearest_particle.glsl", "at.y * u_ClientWidth + at.x", "at.x * u_ClientWidth + at.y");
    CHECK_THROWS_WITH(test::check_twins(scene, 6, turned.path()),
                      Catch::Contains("collision_pass.comp) wrote past the end of Nearest (6208 texels)"));
}

TEST_CASE("compute collision pass twin: every value on a particle's way is told, and agrees") {
    const auto context = open_compute();
    if (!context)
        return;
    const Profile profile = test::llvmpipe_profile();
    FrameRun run(compute_scene("corrected"), profile, measured_operations(profile), std::filesystem::path());
    run.go_to(3);
    std::size_t drawn = 0, found = 0;
    for (std::size_t particle = 0; particle < 150; ++particle) {
        const StepTable table = step_table(run, particle);
        CHECK(table.warning.empty());
        CHECK(table.first_divergent() == nullptr);
        CHECK(table.gpu.drawn_alone);
        CHECK(table.gpu.texel == glm::ivec2(table.reference.fragment.x, table.reference.fragment.y));
        const std::size_t looked_at = table.reference.neighbours.size(); // the base texel is none of them
        CHECK(table.gpu.neighbours.size() == (looked_at > 0 ? looked_at + 1 : 0));
        for (const StepRow& row : table.rows)
            CHECK((row.reference.empty() == row.gpu.empty() || row.label == "also wanted by"));
        drawn += table.gpu.texel.x >= 0 ? 1 : 0;
        found += table.reference.nearest ? 1 : 0;
    }
    CHECK(drawn > 10);
    CHECK(found > 3);
}

TEST_CASE("compute collision pass twin: what does not fit is told") {
    const auto context = open_compute();
    if (!context)
        return;
    const auto error = [](const Scene& scene, const std::filesystem::path& shaders) -> std::string {
        try {
            const GpuSimulation gpu(scene, shaders);
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    };
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.comp", "layout(local_size_x = 64) in;",
                "layout(local_size_x = 8, local_size_y = 8) in;");
    CHECK(error(compute_scene("corrected"), shaders.path()) ==
          "collision_pass: local_size_y is 8 and local_size_z 1; particles are counted along x, so both must be 1");
    const test::TemporaryFolder misspelt;
    test::plant(misspelt, "collision_texels.frag", "buffer Nearest", "buffer Nearer");
    CHECK_THAT(error(compute_scene("corrected"), misspelt.path()),
               Catch::Contains("collision_texels.frag") &&
                   Catch::Contains("nothing is given for storage buffer Nearer"));
}

} // namespace lockstep::test::compute_collision_pass_twin_test
