#include <catch2/catch.hpp>

#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <lockstep/function.hpp>

#include "crosscheck/scene/profiles.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "gpu/collision/render_pass.hpp"
#include "gpu/collision/simulation.hpp"
#include "gpu/mesh_buffer.hpp"
#include "tests/gpu/any_context.hpp"
#include "tests/skip.hpp"
#include "tests/system_run.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/text/draw_watch.hpp"
#include "tests/text/shipped_scene.hpp"

namespace lockstep::test::drawn_stages_test {

namespace {

using Rows = std::map<std::string, DrawWatch::Row>;

void print(const std::string& what, const Rows& rows) {
    fmt::print("{}\n", what);
    for (const auto& [name, row] : rows)
        fmt::print("  {:60.60} {:3} {:8} {:9} {:6} {:6} {} {} {}\n", name, row.draws, row.invocations, row.words,
                   row.discarded, row.differing, row.first, row.finding, row.refused);
}

bool is_printed() { return std::getenv("LOCKSTEP_PRINT_STAGES") != nullptr; }

/// Every stage that was drawn with made the GPU's words, and at least `count` stages were: the probe's may be among
/// them.
void expect_equal(const std::string& what, const Rows& rows, std::size_t count) {
    INFO(what);
    if (is_printed())
        print(what, rows);
    std::size_t looked_at = 0;
    for (const auto& [name, row] : rows) {
        INFO(name);
        CHECK(row.refused == "");
        CHECK(row.first == "");
        // A ray that passes the sphere by has no place on it; what is made of it is discarded.
        if (!name.starts_with("frag: The nearest sphere's depth."))
            CHECK(row.finding == "");
        looked_at += row.words > 0 || row.discarded > 0 ? 1 : 0;
    }
    CHECK(looked_at >= count);
}

/// Frames of a shipped scene, and its last picture.
Rows drawn(const ShippedScene& shipped, int frames) {
    const SystemScene scene = shipped.load();
    const std::string shaders = "shaders/" + shipped.system;
    static_cast<void>(GlSystemSide(test::gl(), scene.system, scene.passes, shaders, scene.arithmetic)); // GL is ready
    const DrawWatch watch(test::gl().profile());
    GlSystemSide side(test::gl(), scene.system, scene.passes, shaders, scene.arithmetic);
    SystemState state = scene.system.start;
    side.upload(state.view());
    for (int frame = 0; frame < frames; ++frame)
        for (std::size_t pass = 0; pass < scene.system.passes.size(); ++pass)
            side.step(pass, frame);
    side.read(state);
    if (scene.picture) {
        const SystemPicture picture = scene.picture(state, frames - 1);
        GlSystemSide canvas(test::gl(), picture.system, picture.passes, shaders, scene.arithmetic);
        canvas.upload(picture.system.start.view());
        canvas.step(0, frames - 1);
        static_cast<void>(canvas.picture(0, frames - 1, picture.how));
    }
    return watch.rows();
}

} // namespace

TEST_CASE("text: each stage that collision draws with makes the GPU's words") {
    const auto context = open_context(software_gl());
    if (!context || !context->describe().compute)
        return;
    const Profile profile = measured_profile(*context);
    const auto draw = [&](const std::vector<std::string>& set, const std::string& preset) {
        SceneOptions options;
        options.particles = 1000;
        options.preset = preset;
        options.set = set;
        Scene scene = load_scene("data/scenes/x_streams.json", options);
        scene.obstacles.positions = {{-1.0F, -0.3F, -1.0F}, {1.0F, -0.3F, -1.0F}, {0.0F, -0.3F, 1.0F}};
        scene.obstacles.indices = {0, 1, 2};
        scene.width = 64;
        scene.height = 48;
        scene.render_width = 96;
        scene.render_height = 64;
        const DrawWatch watch(profile);
        GpuSimulation gpu(scene, {});
        Particles particles;
        for (int frame = 0; frame < 6; ++frame)
            gpu.step(frame_params(scene, frame));
        gpu.read(particles);
        RenderPass pass(scene.switches, {}, scene.render_width, scene.render_height);
        ParticleBuffer buffer(particles.size());
        buffer.upload(particles);
        pass.run(buffer, MeshBuffer(scene.obstacles), frame_params(scene, 5));
        return watch.rows();
    };
    for (const char* const preset : {"corrected", "exact"})
        expect_equal(preset, draw({}, preset), 12);
    expect_equal("step=compute", draw({"step=compute"}, "corrected"), 12);
}

TEST_CASE("text: each stage that a system draws with makes the GPU's words") {
    if (!test::gl())
        return skip(test::gl().missing());
    for (const char* const file : {"spheres", "kernels"})
        expect_equal(file, drawn({"dust", file, 1000}, 3), 2);
    for (const char* const file : {"births_and_deaths", "fire", "sorted_ribbon"})
        expect_equal(file, drawn({"lifecycle", file, 1000}, 4), 2);
    expect_equal("wave", drawn({"fluid", "wave", 0, "corrected", {}, R"({"render": [48, 40]})"}, 2), 7);
    expect_equal("two_layers", drawn({"fluid", "two_layers", 0, "exact", {}, R"({"render": [48, 40]})"}, 1), 5);
    expect_equal("hall", drawn({"lights", "hall", 60, "corrected", {}, R"({"image": [48, 32]})"}, 2), 5);
    expect_equal("hall", drawn({"lights", "hall", 60, "corrected", {"accumulate=blend"}, R"({"image": [48, 32]})"}, 2),
                 7);
}

TEST_CASE("text: the stage that calls a function makes the GPU's words") {
    if (!test::gl())
        return skip(test::gl().missing());
    const TemporaryFolder folder;
    const std::string file = folder
                                 .write("wall.glsl", R"(uniform float u_Kept;
        vec3 bounce(vec3 velocity, const in vec3 n) {
            precise float into = (velocity.x * n.x + velocity.y * n.y) + velocity.z * n.z;
            precise vec3 left = velocity - n * (into * (1.0 + u_Kept));
            return left;
        })")
                                 .string();
    FunctionTable<glm::vec3, glm::vec3> table;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const auto part = [&](std::uint32_t k) {
            return static_cast<float>((i * 2654435761U + k * 40503U) >> 8U) * 0x1p-23F - 1.0F;
        };
        table.emplace_back(glm::vec3(part(1), part(2), part(3)), glm::vec3(part(4), part(5), part(6)));
    }
    const DrawWatch watch(test::gl().profile());
    const MatchResult result = match_function(
        test::gl(), {file, "bounce", {{"u_Kept", 0.5F}}}, table, [](auto& r, const auto& velocity, const auto& n) {
            const auto into = (velocity.x * n.x + velocity.y * n.y) + velocity.z * n.z;
            return velocity - n * (into * (1.0F + r.uniform(Site{"kept"}, 0.5F)));
        });
    CHECK(result.passed());
    expect_equal("function", watch.rows(), 1);
    CHECK(watch.rows().begin()->second.invocations >= 1000);
}

} // namespace lockstep::test::drawn_stages_test
