#include <array>
#include <string_view>

#include <catch2/catch.hpp>

#include "gpu/check.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/collision/particle_buffer.hpp"
#include "gpu/declaration.hpp"
#include "gpu/program.hpp"
#include "tests/gpu/any_context.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::program_test {

using test::open_context;
using test::TemporaryFolder;

namespace {

const std::string vertex = R"(#version 330 core
in vec3 a_Position;
in float a_Speed;
uniform float u_Tick;
uniform vec3 u_Gravity;
uniform mat4 u_ProjView;
uniform sampler2D u_CDTexture;
uniform int u_ClientWidth;
out vec3 out_Position;
out float out_Speed;
void main() {
    out_Position = a_Position + u_Gravity * u_Tick;
    out_Speed = a_Speed + texelFetch(u_CDTexture, ivec2(u_ClientWidth), 0).x;
    gl_Position = u_ProjView * vec4(out_Position, 1.0);
}
)";
const std::string fragment = "#version 330 core\nout vec4 o_Color;\nvoid main() { o_Color = vec4(1.0); }\n";

const std::vector<Capture> captures{{"out_Position", GL_FLOAT_VEC3}, {"out_Speed", GL_FLOAT}};

Program build(const TemporaryFolder& folder, const std::vector<Stage>& stages, std::span<const Capture> captured = {}) {
    return {"step", load_stages({folder.path()}, "step", stages), captured};
}

std::string message(const TemporaryFolder& folder, const std::vector<Stage>& stages,
                    std::span<const Capture> captured = {}) {
    try {
        build(folder, stages, captured);
    } catch (const Error& error) {
        CHECK(gl::GetError() == GL_NO_ERROR);
        return error.what();
    }
    return "built";
}

const std::string remedy =
    "; bindings.json beside the shader binds a uniform to a name or a number (docs/own_shader.md)";

} // namespace

TEST_CASE("program: captures outputs, sets uniforms, finds attributes") {
    const auto context = open_context();
    if (!context)
        return;
    const TemporaryFolder folder;
    folder.write("step.vert", vertex);
    folder.write("step.frag", fragment);
    const Program program = build(folder, {Stage::vertex, Stage::fragment}, captures);
    program.set("u_Tick", 0.5F);
    program.set("u_Gravity", glm::vec3(0.0F, -1.0F, 0.0F));
    program.set("u_ProjView", glm::mat4(1.0F));
    program.set("u_ClientWidth", 500);
    program.set_unit("u_CDTexture", 0);
    check_gl("uniforms");
    float tick = 0.0F;
    gl::GetUniformfv(program.id(), gl::GetUniformLocation(program.id(), "u_Tick"), &tick);
    CHECK(tick == 0.5F);
    CHECK(program.attribute("a_Position", GL_FLOAT_VEC3) >= 0);
}

TEST_CASE("program: a uniform or attribute the shader does not use is no error") {
    const auto context = open_context();
    if (!context)
        return;
    const TemporaryFolder folder;
    folder.write("step.vert", vertex);
    folder.write("step.frag", fragment);
    const Program program = build(folder, {Stage::vertex, Stage::fragment});
    CHECK_NOTHROW(program.set("u_Unused", 1));
    CHECK(program.attribute("a_Unused", GL_FLOAT) == -1);
    check_gl("unused");
}

TEST_CASE("program: a wrong uniform or attribute type is told") {
    const auto context = open_context();
    if (!context)
        return;
    const TemporaryFolder folder;
    folder.write("step.vert", vertex);
    folder.write("step.frag", fragment);
    const Program program = build(folder, {Stage::vertex, Stage::fragment}, captures);
    const std::string file = (folder.path() / "step.vert").string();
    CHECK_THROWS_WITH(program.set("u_Tick", 1), "shader " + file + ":4: uniform u_Tick is float, but must be int");
    CHECK_THROWS_WITH(program.set("u_Gravity", 1.0F),
                      "shader " + file + ":5: uniform u_Gravity is vec3, but must be float");
    CHECK_THROWS_WITH(program.set_unit("u_ClientWidth", 0),
                      "shader " + file + ":8: uniform u_ClientWidth is int, but must be sampler2D");
    CHECK_THROWS_WITH(program.attribute("a_Speed", GL_FLOAT_VEC3),
                      "shader " + file + ":3: attribute a_Speed is float, but must be vec3");
}

TEST_CASE("program: what the shader uses and nobody gives is told with the name it may be meant as") {
    const auto context = open_context();
    if (!context)
        return;
    const TemporaryFolder folder;
    const std::string file = folder.write("step.vert", vertex).string();
    folder.write("step.frag", fragment);
    const Program program = build(folder, {Stage::vertex, Stage::fragment}, captures);
    const auto give = [&](const char* tick, const char* speed) {
        program.set(tick, 0.5F);
        program.set("u_Gravity", glm::vec3(0.0F));
        program.set("u_ProjView", glm::mat4(1.0F));
        program.set("u_ClientWidth", 500);
        program.set_unit("u_CDTexture", 0);
        CHECK(program.attribute("a_Position", GL_FLOAT_VEC3) >= 0);
        static_cast<void>(program.attribute(speed, GL_FLOAT));
    };
    give("u_Tack", "a_Sped");
    CHECK_THROWS_WITH(program.check_interface(),
                      "shader " + file + ":4: nothing is given for uniform u_Tick; did you mean float u_Tack?; " +
                          file + ":3: nothing is given for attribute a_Speed; did you mean float a_Sped?" + remedy);
    give("u_Tick", "a_Sped");
    CHECK_THROWS_WITH(program.check_interface(),
                      "shader " + file + ":3: nothing is given for attribute a_Speed; did you mean float a_Sped?");
    give("u_Tick", "a_Speed");
    CHECK_NOTHROW(program.check_interface());
}

TEST_CASE("program: all that nobody gives is told at once, and what is not near in name and type is not meant") {
    const auto context = open_context();
    if (!context)
        return;
    const TemporaryFolder folder;
    const std::string file =
        folder
            .write("step.vert", "#version 330 core\nin vec3 a_Position;\nuniform mat4 u_Turn;\n"
                                "uniform sampler2DRect u_Map;\nuniform bvec2 u_Tic;\nuniform float u_Tik;\n"
                                "void main() { gl_Position = u_Turn * vec4(a_Position, u_Tik + (u_Tic.x ? 1.0 : 0.0)) "
                                "+ texelFetch(u_Map, ivec2(0)); }\n")
            .string();
    folder.write("step.frag", fragment);
    const Program program = build(folder, {Stage::vertex, Stage::fragment});
    program.set("u_Tick", 0.5F);
    program.set("u_Gravity", glm::vec3(0.0F));
    CHECK(program.attribute("a_Position", GL_FLOAT_VEC3) >= 0);
    CHECK_THROWS_WITH(program.check_interface(),
                      "shader " + file + ":4: nothing is given for uniform u_Map; " + file +
                          ":5: nothing is given for uniform u_Tic; did you mean float u_Tick?; " + file +
                          ":6: nothing is given for uniform u_Tik; did you mean float u_Tick?; " + file +
                          ":3: nothing is given for uniform u_Turn" + remedy);
    CHECK_THROWS_WITH(program.set("u_Map", 1),
                      "shader " + file + ":4: uniform u_Map is sampler2DRect, but must be int");
}

TEST_CASE("program: a geometry stage that makes triangles is told as that") {
    const auto context = open_context();
    if (!context)
        return;
    const TemporaryFolder folder;
    folder.write("step.vert",
                 "#version 330 core\nin vec3 a_Position;\nvoid main() { gl_Position = vec4(a_Position, 1.0); }\n");
    folder.write("step.frag", fragment);
    const auto geometry = [&](const std::string& in, const std::string& out) {
        return folder
            .write("step.geom", "#version 330 core\nlayout(" + in + ") in;\nlayout(" + out +
                                    ", max_vertices = 3) out;\nout vec3 out_Position;\nout float out_Speed;\n"
                                    "void main() { out_Position = gl_in[0].gl_Position.xyz; out_Speed = 1.0; "
                                    "gl_Position = vec4(0.0); EmitVertex(); }\n")
            .string();
    };
    const std::vector<Stage> stages{Stage::vertex, Stage::geometry, Stage::fragment};
    std::string file = geometry("points", "triangle_strip");
    CHECK(message(folder, stages, captures) ==
          "shader " + file + ": layout(triangle_strip) out; right is layout(points) out, a point a particle");
    file = geometry("triangles", "points");
    CHECK(message(folder, stages, captures) ==
          "shader " + file + ": layout(triangles) in; right is layout(points) in, a point a particle");
    geometry("points", "points");
    CHECK(message(folder, stages, captures) == "built");
}

TEST_CASE("program: a uniform with an initialiser may be the shader's own; one in an array may not be forgotten") {
    const auto context = open_context();
    if (!context)
        return;
    const TemporaryFolder folder;
    folder.write("lib.glsl", "// uniform float u_Own = 1.0;\nuniform float u_Own = 0.5; // own\n"
                             "uniform vec2 u_Pairs[2];\n");
    folder.write("step.vert", "#version 330 core\n#include \"lib.glsl\"\nin vec3 a_Position;\n"
                              "void main() { gl_Position = vec4(a_Position * u_Own, u_Pairs[gl_VertexID % 2].x); }\n");
    folder.write("step.frag", fragment);
    const Program program = build(folder, {Stage::vertex, Stage::fragment});
    CHECK(program.attribute("a_Position", GL_FLOAT_VEC3) >= 0);
    CHECK_THROWS_WITH(program.check_interface(), "shader " + (folder.path() / "lib.glsl").string() +
                                                     ":3: nothing is given for uniform u_Pairs[0]" + remedy);
}

TEST_CASE("program: a declaration is found whatever stands round it") {
    const TemporaryFolder folder;
    const std::string file =
        folder
            .write("step.vert", "#version 330 core\n// uniform int u_A;\nuniform int u_AB;\n"
                                "layout(location = 0) in vec3 a_P; uniform highp int u_A = 3;\n"
                                "precise flat out vec3 out_P;\nvoid f(in int u_C) {}\nuniform int u_B, u_C[2];\n")
            .string();
    const std::vector<ShaderSource> stages = load_stages({folder.path()}, "step", std::array{Stage::vertex});
    CHECK(find_declaration(stages, "uniform", "u_A").place == file + ":4");
    CHECK(find_declaration(stages, "uniform", "u_A").is_initialised);
    CHECK(find_declaration(stages, "uniform", "u_AB").place == file + ":3");
    CHECK_FALSE(find_declaration(stages, "uniform", "u_AB").is_initialised);
    CHECK(find_declaration(stages, "in", "a_P").place == file + ":4");
    CHECK(find_declaration(stages, "out", "out_P").place == file + ":5");
    CHECK(find_declaration(stages, "uniform", "u_C").place == file + ":7");
    CHECK(find_declaration(stages, "uniform", "u_Nowhere").place == file);
}

TEST_CASE(
    "program: a declaration is found beside a line of a million characters, over several lines, not in comments") {
    const TemporaryFolder folder;
    const std::string file =
        folder
            .write("step.vert", "#version 330 core\n/* uniform int u_A;\n */ const int k = 1" +
                                    std::string(1'000'000, ' ') + "+ 1; // " + std::string(1'000'000, 'x') +
                                    "\nuniform highp\n  int u_A [ 2 * 1 ]\n = 3;\n")
            .string();
    const std::vector<ShaderSource> stages = load_stages({folder.path()}, "step", std::array{Stage::vertex});
    CHECK(find_declaration(stages, "uniform", "u_A").place == file + ":5");
    CHECK(find_declaration(stages, "uniform", "u_A").is_initialised);
}

TEST_CASE("program: a compile error names file and line, in an included file too") {
    const auto context = open_context();
    if (!context)
        return;
    const TemporaryFolder folder;
    const std::string file =
        folder.write("step.vert", "#version 330 core\nvoid main() {\n    gl_Position = nowhere;\n}\n").string();
    CHECK_THAT(message(folder, {Stage::vertex}),
               Catch::StartsWith("shader " + file + ":3: ") && Catch::Contains("nowhere") && !Catch::Contains("\n"));

    const std::string library = folder.write("lib.glsl", "\n\nfloat twice(float x) { return 2.0 * y; }\n").string();
    folder.write("step.vert", "#version 330 core\n#include \"lib.glsl\"\nvoid main() { gl_Position = vec4(0.0); }\n");
    CHECK_THAT(message(folder, {Stage::vertex}), Catch::StartsWith("shader " + library + ":3: "));

    folder.write("lib.glsl", "float one() { return 1.0; }\n");
    folder.write("step.vert", "#version 330 core\n#include \"lib.glsl\"\nvoid main() { gl_Position = vec5(0.0); }\n");
    CHECK_THAT(message(folder, {Stage::vertex}), Catch::StartsWith("shader " + file + ":3: "));

    folder.write("step.vert", "#version 150\n\nvoid main() { gl_Position = vec5(0.0); }\n");
    CHECK_THAT(message(folder, {Stage::vertex}), Catch::StartsWith("shader " + file + ":3: "));

    folder.write("step.vert", "#version 330 core\n#if\nvoid main() { gl_Position = vec4(0.0); }\n");
    CHECK_THAT(message(folder, {Stage::vertex}), Catch::StartsWith("shader " + file + ":2: "));
}

TEST_CASE("program: stages that do not fit say so") {
    const auto context = open_context();
    if (!context)
        return;
    const TemporaryFolder folder;
    folder.write("step.vert", vertex);
    folder.write("step.frag", "#version 330 core\nin vec2 out_Position;\nout vec4 o_Color;\n"
                              "void main() { o_Color = vec4(out_Position, 0.0, 1.0); }\n");
    const std::string told = message(folder, {Stage::vertex, Stage::fragment});
    CHECK_THAT(told, Catch::StartsWith("step: does not link (" + (folder.path() / "step.vert").string()) &&
                         Catch::Contains("out_Position") && !Catch::Contains("\n"));
}

TEST_CASE("program: a missing captured output is named with the stage that lacks it") {
    const auto context = open_context();
    if (!context)
        return;
    const TemporaryFolder folder;
    folder.write("step.vert", "#version 330 core\nin vec3 a_Position;\nout vec3 out_Position;\n"
                              "void main() { out_Position = a_Position; gl_Position = vec4(0.0); }\n");
    folder.write("step.frag", fragment);
    CHECK(message(folder, {Stage::vertex, Stage::fragment}, captures) ==
          "step: output out_Speed is not written by the last vertex-processing stage (" +
              (folder.path() / "step.vert").string() + "); it must write out_Position, out_Speed");
    folder.write("step.geom", "#version 330 core\nlayout(points) in;\nlayout(points, max_vertices = 1) out;\n"
                              "out float out_Speed;\nvoid main() { out_Speed = 1.0; EmitVertex(); }\n");
    CHECK(message(folder, {Stage::vertex, Stage::geometry, Stage::fragment}, captures) ==
          "step: output out_Position is not written by the last vertex-processing stage (" +
              (folder.path() / "step.geom").string() + "); it must write out_Position, out_Speed");
}

TEST_CASE("program: a captured output of another type is told") {
    const auto context = open_context();
    if (!context)
        return;
    const TemporaryFolder folder;
    folder.write("step.vert",
                 "#version 330 core\nin vec3 a_Position;\nout vec4 out_Position;\nout float out_Speed[2];\n"
                 "void main() { out_Position = vec4(a_Position, 1.0); out_Speed = float[2](1.0, 2.0);"
                 " gl_Position = vec4(0.0); }\n");
    folder.write("step.frag", fragment);
    const std::string file = (folder.path() / "step.vert").string();
    CHECK(message(folder, {Stage::vertex, Stage::fragment}, captures) ==
          "shader " + file + ":3: output out_Position is vec4, but must be vec3");
    CHECK(message(folder, {Stage::vertex, Stage::fragment}, std::span(captures).subspan(1)) ==
          "shader " + file + ":4: output out_Speed is float[2], but must be float");
}

TEST_CASE("program: outputs are found by the start of their names, in the last vertex-processing stage") {
    const auto context = open_context();
    if (!context)
        return;
    const TemporaryFolder folder;
    folder.write("step.vert", "#version 330 core\nin vec3 a_Position;\n// trace_comment\nvec3 trace_local;\n"
                              "out vec3 trace_b;\nflat out ivec2 trace_a[2];\nout float other_trace_c;\n"
                              "void main() { trace_local = a_Position; trace_b = trace_local; trace_a[0] = ivec2(1);"
                              " trace_a[1] = ivec2(2); other_trace_c = 1.0; gl_Position = vec4(0.0); }\n");
    const auto of = [&](const std::vector<Stage>& stages) {
        return outputs_with("trace_", load_stages({folder.path()}, "step", stages));
    };
    const std::vector<Capture> found = of({Stage::vertex});
    REQUIRE(found.size() == 2);
    CHECK((found[0].name == "trace_a" && found[0].type == GL_INT_VEC2 && found[0].size == 2));
    CHECK((found[1].name == "trace_b" && found[1].type == GL_FLOAT_VEC3 && found[1].size == 1));
    folder.write("step.geom", "#version 330 core\nlayout(points) in;\nlayout(points, max_vertices = 1) out;\n"
                              "out uint trace_g;\nvoid main() { trace_g = 1u; EmitVertex(); }\n");
    REQUIRE(of({Stage::vertex, Stage::geometry}).size() == 1);
    CHECK(of({Stage::vertex, Stage::geometry})[0].type == GL_UNSIGNED_INT);
}

TEST_CASE("program: every built-in shader links with every switch") {
    const auto context = open_context();
    if (!context)
        return;
    const ShaderFolders folders = shader_folders({}, "collision");
    for (const auto& entry : std::filesystem::directory_iterator(folders.front())) {
        if (entry.path().extension() != ".vert")
            continue;
        const std::string name = entry.path().stem().string();
        if (name == "collision_texels" && !context->describe().compute)
            continue;
        if (name == "without_geometry") // the end of collision_pass.vert, no stage by itself
            continue;
        std::vector<Stage> stages{Stage::vertex};
        for (const Stage stage : {Stage::geometry, Stage::fragment})
            if (std::filesystem::exists(folders.front() / (name + std::string(extension(stage)))))
                stages.push_back(stage);
        const std::vector<Capture> captures = particle_records().captures();
        const std::span<const Capture> captured(captures);
        for (const SwitchInfo& info : switch_table())
            for (const std::string_view value : info.values) {
                Switches switches;
                set_switch(switches, info.name, value);
                CAPTURE(name, info.name, value);
                constexpr std::array<std::string_view, 2> buffers{"After", "Nearest"}; // of collision_texels.frag
                CHECK_NOTHROW(Program(name, load_stages(folders, name, stages, switch_defines(switches)),
                                      name.ends_with("collision_pass") ? captured : captured.first(0), buffers));
            }
    }
}

} // namespace lockstep::test::program_test
