#include <catch2/catch.hpp>

#include <string>

#include "tests/cli/cli_checks.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::driver_interpolates_test {

namespace {

/// What check says of obstacles whose positions the driver interpolates; `stored` of its g_World.
test::Outcome checked(const std::string& stored, const std::string& declared = "in vec3 g_World;") {
    const test::TemporaryFolder shaders;
    shaders.write("obstacle_pass.geom", R"(#version 330 core
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
in vec3 v_Position[];
)" + std::string(declared.starts_with("flat") ? "flat " : "") +
                                            R"(out vec3 g_World;
void main() {
    for (int i = 0; i < 3; ++i) {
        g_World = v_Position[i];
        gl_Position = gl_in[i].gl_Position;
        EmitVertex();
    }
    EndPrimitive();
}
)");
    shaders.write("obstacle_pass.frag", "#version 330 core\n" + declared + "\nout vec4 o_Texel;\nvoid main() {\n    " +
                                            "o_Texel = vec4(" + stored + ", 1.0);\n}\n");
    return test::run_lockstep({"check", "data/scenes/lattice.json", "--particles", "500", "--frames", "3", "--gl",
                               test::software_gl(), "--shaders", shaders.path().string()});
}

} // namespace

TEST_CASE("driver interpolates: obstacles' positions within what GL allows are LEGAL, and a note says what is open") {
    if (!test::have_software_gl())
        return;
    const test::Outcome outcome = checked("g_World");
    INFO(outcome.out << outcome.err);
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, Catch::Contains("verdict   LEGAL"));
    CHECK_THAT(outcome.out, Catch::Contains("not followed: triangles: interpolation"));
    CHECK_THAT(outcome.out, Catch::Contains("note      obstacle_pass.frag takes what the driver interpolates"));
}

TEST_CASE(
    "driver interpolates: a position further off, another corner's or one that is not interpolated is DIVERGENT") {
    if (!test::have_software_gl())
        return;
    for (const auto& [stored, declared] : {std::pair{"g_World * 1.001", "in vec3 g_World;"},
                                           {"g_World.yxz", "in vec3 g_World;"},
                                           {"g_World", "flat in vec3 g_World;"}}) {
        INFO(stored << " " << declared);
        const test::Outcome outcome = checked(stored, declared);
        INFO(outcome.out << outcome.err);
        CHECK(outcome.status == 1);
        CHECK_THAT(outcome.out, Catch::Contains("verdict   DIVERGENT"));
    }
}

} // namespace lockstep::test::driver_interpolates_test
