#include <catch2/catch.hpp>

#include <initializer_list>
#include <string>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::clip_space_test {

using test::run_lockstep;

namespace {

/// The small scene without obstacles, seen from (0, 0, 2.5) with depth from 0.5 to 10, through a host's own matrix.
struct Setting : test::SceneSetting {
    Setting(const std::string& clip_space, const std::string& z_column, const std::string& z_offset)
        : SceneSetting("check") {
        std::string text = test::small_scene;
        text.erase(text.rfind(",\n  \"obstacles\""));
        folder.write("scene.json",
                     text + ",\n  \"clip_space\": " + clip_space +
                         ",\n  \"frames\": [{\"proj_view\": [1.29903811, 0, 0, 0, 0, 1.73205081, 0, 0, 0, 0, " +
                         z_column + ", -1, 0, 0, " + z_offset + ", 2.5]}]\n}\n");
    }
};

struct Reversed : Setting {
    Reversed() : Setting(R"({"depth": [1, 0]})", "0.0526315789", "0.394736842") {}
};

} // namespace

TEST_CASE("clip space: a host whose depth begins at 0, reversed or not, is drawn on GL and agrees") {
    if (!test::have_software_gl())
        return;
    const Reversed reversed;
    const Setting from_zero(R"({"depth": [0, 1]})", "-1.05263158", "2.10526316");
    const Setting downwards(R"({"first_row": 1, "depth": [1, 0]})", "0.0526315789", "0.394736842");
    for (const Setting* setting : std::initializer_list<const Setting*>{&from_zero, &reversed, &downwards}) {
        const test::Outcome outcome = run_lockstep(setting->command({"--frames", "8", "--require-hits"}));
        INFO(outcome.err);
        CHECK(outcome.status == 0);
        CHECK_THAT(outcome.out, Catch::Contains("verdict   AGREE"));
    }
}

TEST_CASE("clip space: reversed depth that a shader turns around once more is named") {
    if (!test::have_software_gl())
        return;
    const Reversed setting;
    test::plant(setting.shaders, "collision_pass.vert", "gl_Position = point_position(clip);",
                "gl_Position = point_position(vec4(clip.xy, clip.w - clip.z, clip.w));");
    const test::Outcome outcome = run_lockstep(setting.command({"--frames", "8"}));
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out, Catch::Contains("explained by point_depth_reversed"));
}

TEST_CASE("clip space: what draws with GL's own depth alone says so in one line") {
    if (!test::have_software_gl())
        return;
    CHECK_THAT(test::refusal(run_lockstep(Reversed().command({"--set", "step=compute"}))),
               Catch::Contains("clip_space: depth [1, 0] is drawn on GL with search=cdt"));
}

} // namespace lockstep::test::clip_space_test
