#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"
#include "tests/skip.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::shader_errors_test {

using test::refusal;
using test::run_lockstep;

namespace {

/// Checks the small scene with the shaders of a folder, asking for every kind of output; holds that none was left, and
/// gives the one line of error.
std::string refusal_of(const test::TemporaryFolder& shaders) {
    const test::TemporaryFolder folder;
    const auto scene = folder.write("scene.json", test::small_scene).string();
    const test::Outcome outcome = run_lockstep(
        {"check", scene, "--frames", "3", "--gl", test::software_gl(), "--shaders", shaders.path(), "--json",
         folder.path() / "report.json", "--hashes", folder.path() / "hashes", "--images", folder.path() / "images"});
    CHECK(test::names_in(folder.path()) == std::vector<std::string>{"scene.json"});
    return refusal(outcome);
}

const test::Surroundings no_gl{
    {{"LOCKSTEP_OSMESA_LIBRARY", "/no/such/libOSMesa.so"}, {"LOCKSTEP_EGL_LIBRARY", "/no/such/libEGL.so"}}, {}, {}, {}};

} // namespace

TEST_CASE("shader_errors: a shader that does not compile is told with file, line and the compiler's words") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder shaders;
    const auto file =
        shaders.write("collision_pass.frag", "#version 330 core\nout vec4 o_Texel;\n\nvoid main() { o_Texel = 3; }\n");
    CHECK_THAT(refusal_of(shaders), Catch::StartsWith("shader " + file.string() + ":4: ") && Catch::Contains("vec4"));
}

TEST_CASE("shader_errors: an error in an included file is told there") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_code.glsl", "vec3 decode_position(vec4 texel) {",
                "vec3 decode_position(vec4 texel) { nonsense;");
    CHECK_THAT(refusal_of(shaders), Catch::StartsWith("shader " + (shaders.path() / "collision_code.glsl:").string()) &&
                                        Catch::Contains("nonsense"));
}

TEST_CASE("shader_errors: a line of 40,000 characters is read like any other, in a right shader and in a wrong one") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder, shaders;
    const auto scene = folder.write("scene.json", test::small_scene).string();
    test::plant(
        shaders, "collision_pass.vert", "uniform float u_Tick;", "const float many_terms = 0.0" + [] {
            std::string terms;
            for (int i = 0; i < 5'000; ++i)
                terms += " + 0.25";
            return terms;
        }() + "; uniform float u_Tick;");
    const auto outcome =
        run_lockstep({"check", scene, "--frames", "3", "--gl", test::software_gl(), "--shaders", shaders.path()});
    CHECK(outcome.status == 0);
    const std::string name(50'000, 'x');
    test::plant(shaders, "collision_pass.frag", "void main() {", "void main() { " + name + ";");
    CHECK_THAT(refusal_of(shaders), Catch::Contains("collision_pass.frag:") && Catch::Contains("xxx..."));
}

TEST_CASE("shader_errors: a missing captured output is named") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.geom", "out float out_CollideTime;", "out float out_CollideTiem;");
    test::plant(shaders, "collision_pass.geom", "out_CollideTime = v_", "out_CollideTiem = v_");
    CHECK_THAT(
        refusal_of(shaders),
        Catch::Equals("collision_pass: output out_CollideTime is not written by the last vertex-processing stage (" +
                      (shaders.path() / "collision_pass.geom").string() +
                      "); it must write out_Position, out_Speed, out_Dir, out_CollideTime"));
}

TEST_CASE("shader_errors: a misspelt uniform or attribute is told where it is declared, with what may be meant") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder shaders;
    const std::string file = "shader " + (shaders.path() / "collision_pass.vert").string();
    SECTION("uniform") {
        test::plant(shaders, "collision_pass.vert", "uniform float u_Tick;",
                    "uniform float u_Tick;\nuniform float u_Tik;");
        test::plant(shaders, "collision_pass.vert", "ls_flush(a_CollideTime) - u_Tick;",
                    "ls_flush(a_CollideTime) - u_Tik;");
        CHECK_THAT(refusal_of(shaders),
                   Catch::StartsWith(file + ":") &&
                       Catch::EndsWith(
                           ": nothing is given for uniform u_Tik; did you mean float u_Tick?; bindings.json beside "
                           "the shader binds a uniform to a name or a number (docs/own_shader.md)"));
    }
    SECTION("attribute") {
        test::plant(shaders, "collision_pass.vert", "in float a_Speed;", "in float a_Speed;\nin float a_CollideTme;");
        test::plant(shaders, "collision_pass.vert", "ls_flush(a_CollideTime) - u_Tick;",
                    "ls_flush(a_CollideTme) - u_Tick;");
        CHECK_THAT(
            refusal_of(shaders),
            Catch::StartsWith(file + ":") &&
                Catch::EndsWith(": nothing is given for attribute a_CollideTme; did you mean float a_CollideTime?"));
    }
    SECTION("of another type") {
        test::plant(shaders, "collision_pass.vert", "uniform float u_Tick;", "uniform vec2 u_Tick;");
        test::plant(shaders, "collision_pass.vert", "ls_flush(a_CollideTime) - u_Tick;",
                    "ls_flush(a_CollideTime) - u_Tick.x;");
        test::plant(shaders, "collision_pass.vert", "product(u_Gravity, u_Tick)", "product(u_Gravity, u_Tick.x)");
        test::plant(shaders, "collision_pass.vert", "v_Speed), u_Tick)", "v_Speed), u_Tick.x)");
        test::plant(shaders, "collision_pass.vert", "product(step, u_Tick)", "product(step, u_Tick.x)");
        CHECK_THAT(refusal_of(shaders),
                   Catch::StartsWith(file + ":") && Catch::EndsWith(": uniform u_Tick is vec2, but must be float"));
    }
    SECTION("an output of another type") {
        test::plant(shaders, "collision_pass.geom", "out float out_Speed;", "out vec2 out_Speed;");
        test::plant(shaders, "collision_pass.geom", "out_Speed = v_Speed[0];", "out_Speed = vec2(v_Speed[0]);");
        CHECK_THAT(refusal_of(shaders),
                   Catch::StartsWith("shader " + (shaders.path() / "collision_pass.geom").string() + ":") &&
                       Catch::EndsWith(": output out_Speed is vec2, but must be float"));
    }
}

TEST_CASE("shader_errors: particles that are not passed on are no verdict") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.geom", "    EmitVertex();\n    EndPrimitive();\n", "");
    CHECK_THAT(refusal_of(shaders),
               Catch::Equals("collision_pass: the shaders emitted 0 points for 300 particles; the last "
                             "vertex-processing stage must emit exactly one point a particle"));
}

TEST_CASE("shader_errors: a shader folder that is not there is named") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder;
    const auto scene = folder.write("scene.json", test::small_scene).string();
    CHECK(refusal(run_lockstep({"check", scene, "--gl", test::software_gl(), "--shaders", "/nowhere"})) ==
          "shader folder /nowhere does not exist");
}

TEST_CASE("shader_errors: without any GL the reasons are given, and nothing is left") {
    const test::TemporaryFolder folder;
    const auto scene = folder.write("scene.json", test::small_scene).string();
    const auto out = (folder.path() / "out").string();
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"check", scene, "--images", out},
                                                      {"check", scene, "--json", out},
                                                      {"render", scene, "--side", "gpu", "-o", out},
                                                      {"bench", scene}}) {
        CAPTURE(arguments);
        CHECK_THAT(refusal(run_lockstep(arguments, no_gl)),
                   Catch::StartsWith("no GL context: osmesa: /no/such/libOSMesa.so: cannot open shared object file") &&
                       Catch::Contains("; egl: /no/such/libEGL.so: cannot open shared object file"));
    }
    CHECK(test::names_in(folder.path()) == std::vector<std::string>{"scene.json"});

    const test::Outcome info = run_lockstep({"info"}, no_gl);
    CHECK(info.status == 2);
    CHECK_THAT(info.out, Catch::StartsWith("osmesa        none: /no/such/libOSMesa.so: cannot open"));
    CHECK_THAT(info.err, Catch::StartsWith("lockstep: no GL context: osmesa: /no/such/libOSMesa.so: cannot open") &&
                             Catch::Contains("; egl: /no/such/libEGL.so: cannot open"));
}

TEST_CASE("shader_errors: hash and render --side cpu need no GL") {
    const test::TemporaryFolder folder;
    const auto scene = folder.write("scene.json", test::small_scene).string();
    const auto picture = folder.path() / "frame.png";
    CHECK(run_lockstep({"hash", scene, "--frames", "2"}, no_gl).status == 0);
    CHECK(run_lockstep({"render", scene, "--frame", "1", "-o", picture}, no_gl).status == 0);
    CHECK(std::filesystem::file_size(picture) > 100);
}

TEST_CASE("shader_errors: an octree where GL has no compute shaders is refused in one line") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder;
    const auto scene = folder.write("scene.json", test::small_scene).string();
    const std::vector<std::string> arguments{"check", scene,          "--frames", "3", "--gl", test::software_gl(),
                                             "--set", "search=octree"};
    CHECK(run_lockstep(arguments).status == 0);
    CHECK(refusal(run_lockstep(arguments, {{{"GALLIUM_DRIVER", "softpipe"}}, {}, {}, {}})) ==
          "octree_pass: search = octree needs compute shaders and storage buffers, GL 4.3; this context is of an "
          "earlier version");
}

TEST_CASE("shader_errors: a shipped shader is named by its place among the shaders, not by the machine's path") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder data;
    std::filesystem::copy("shaders", data.path() / "shaders", std::filesystem::copy_options::recursive);
    const auto refused = [&] {
        return refusal(run_lockstep({"check", "data/scenes/lattice.json", "--frames", "1", "--gl", test::software_gl()},
                                    {.environment = {{"LOCKSTEP_DATA", data.path().string()}}}));
    };
    const auto break_shader = [&](const char* name, const std::string& text) {
        std::ofstream(data.path() / "shaders/collision" / name, std::ios::app) << text;
    };
    break_shader("collision_code.glsl", "nonsense;\n");
    CHECK_THAT(refused(), Catch::StartsWith("shader shaders/collision/collision_code.glsl:"));
    break_shader("collision_code.glsl", "#include \"gone.glsl\"\n");
    const std::string missing = refused();
    CHECK_THAT(missing, Catch::StartsWith("shader shaders/collision/collision_code.glsl:") &&
                            Catch::Contains("no shader file gone.glsl in shaders/collision or shaders/"));
    CHECK_THAT(missing, !Catch::Contains(data.path().string()));
}

TEST_CASE("shader_errors: a storage buffer that nobody binds is refused on a GL that cannot tell of it, too") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.frag", "flat in vec3 out_Position;",
                "layout(std430) buffer Step { float apart; };\nflat in vec3 out_Position;");
    test::plant(shaders, "collision_pass.frag", "#extension GL_ARB_gpu_shader5 : require",
                "#extension GL_ARB_gpu_shader5 : require\n"
                "#extension GL_ARB_shader_storage_buffer_object : require");
    test::plant(shaders, "collision_pass.frag", "encode_position(out_Position)",
                "encode_position(out_Position + vec3(apart))");
    const auto run = [&](const test::Surroundings& surroundings) {
        return run_lockstep({"check", "data/scenes/lattice.json", "--frames", "1", "--gl", test::software_gl(),
                             "--shaders", shaders.path()},
                            surroundings);
    };
    CHECK_THAT(refusal(run({})),
               Catch::EndsWith("nothing is given for storage buffer Step; storage buffers are bound in "
                               "compute shaders alone (docs/own_shader.md)"));
    const test::Outcome old = run({.environment = {{"MESA_GL_VERSION_OVERRIDE", "4.2"},
                                                   {"MESA_EXTENSION_OVERRIDE", "-GL_ARB_program_interface_query"}}});
    CHECK(old.status == 2);                                   // Mesa says on standard output what it leaves out
    if (old.err.find("GL_INVALID_ENUM") != std::string::npos) // of what has nothing to do with it
        return test::skip("this Mesa breaks when it is to leave out GL_ARB_program_interface_query", "");
    CHECK_THAT(old.err, Catch::Contains("nothing is given for storage buffer Step, and this GL is too old to say"));
}

} // namespace lockstep::test::shader_errors_test
