#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/cli/run_program.hpp"

namespace lockstep::test::examine_command_test {

using Catch::Contains;

namespace {

/// A sum of a group's numbers; `barrier` is between writing and reading.
std::string sum(const std::string& barrier) {
    return "#version 430 core\n"
           "layout(local_size_x = 64) in;\n"
           "buffer Numbers { float x[]; };\n"
           "uniform float u_Kept;\n"
           "shared float parts[64];\n"
           "void main() {\n"
           "    uint i = gl_LocalInvocationIndex;\n"
           "    parts[i] = x[gl_GlobalInvocationID.x] * u_Kept;\n"
           "    " +
           barrier +
           "\n"
           "    x[gl_GlobalInvocationID.x] = parts[63u - i];\n"
           "}\n";
}

} // namespace

TEST_CASE("examine: a shader without a fault has no findings, one without its barrier a race with both lines") {
    const TemporaryFolder folder;
    const std::string right = folder.write("right.comp", sum("barrier();")).string();
    const Outcome quiet = run_lockstep({"examine", right, "--uniform", "u_Kept=0.5"});
    CHECK(quiet.status == 0);
    CHECK(quiet.out == "right.comp: no findings in 4 groups of 64 invocations\ncoverage  right.comp: all 4 lines in 4 "
                       "groups of 64 invocations\n");
    const std::string wrong = folder.write("wrong.comp", sum("")).string(),
                      json = (folder.path() / "found.json").string();
    const Outcome found = run_lockstep({"examine", wrong, "--groups", "2,1,1", "--json", json});
    CHECK(found.status == 1);
    CHECK_THAT(found.out, Contains("wrong.comp: 1 finding in 2 groups of 64 invocations\n"));
    CHECK_THAT(found.out, Contains("wrong.comp:8: race on shared memory (GLSL 4.60, 8.16): invocation ") &&
                              Contains("; the other at wrong.comp:10;") && Contains("0 for want of --uniform: u_Kept"));
    const nlohmann::json all = nlohmann::json::parse(std::ifstream(json));
    CHECK(all["findings"].size() == 1);
    CHECK(all["findings"][0]["where"] == "wrong.comp:8");
    CHECK(all["findings"][0]["other"]["where"] == "wrong.comp:10");
}

TEST_CASE("examine: blocks with one binding are one buffer") {
    const TemporaryFolder folder;
    const auto examined = [&](const std::string& binding) {
        return run_lockstep({"examine",
                             folder
                                 .write("two.comp", "#version 430 core\n"
                                                    "layout(local_size_x = 8) in;\n"
                                                    "layout(binding = 0) buffer A { float x[]; };\n"
                                                    "layout(binding = " +
                                                        binding +
                                                        ") buffer B { float y[]; };\n"
                                                        "void main() {\n"
                                                        "    uint i = gl_LocalInvocationIndex;\n"
                                                        "    x[i] = 1.0;\n"
                                                        "    y[(i + 1) % 8] = 2.0;\n"
                                                        "}\n")
                                 .string(),
                             "--groups", "1"});
    };
    CHECK_THAT(examined("0").out, Contains("two.comp:8: race on a buffer") && Contains("two.comp:7"));
    CHECK(examined("1").status == 0);
}

TEST_CASE("examine: texelFetch of a level that a made-up image does not have is a finding") {
    const TemporaryFolder folder;
    const auto examined = [&](const std::string& level) {
        return run_lockstep({"examine", folder
                                            .write("fetch.comp", "#version 430 core\n"
                                                                 "layout(local_size_x = 1) in;\n"
                                                                 "uniform sampler2D u_Image;\n"
                                                                 "buffer Numbers { float x[]; };\n"
                                                                 "void main() {\n"
                                                                 "    x[0] = texelFetch(u_Image, ivec2(0), " +
                                                                     level + ").x;\n}\n")
                                            .string()});
    };
    for (const char* absent : {"7", "-1"})
        CHECK_THAT(examined(absent).out, Contains("fetch.comp:6: texelFetch of a level that the image does not have") &&
                                             Contains(std::string("level ") + absent + " of u_Image"));
    CHECK(examined("0").status == 1); // the race of four groups alone
    CHECK_THAT(examined("0").out, !Contains("level"));
}

TEST_CASE("examine: what it cannot run is refused in one line") {
    const TemporaryFolder folder;
    const std::string shader = folder.write("right.comp", sum("barrier();")).string();
    const auto refused = [&](std::vector<std::string> options, const std::string& file) {
        options.insert(options.begin(), {"examine", file});
        return refusal(run_lockstep(options));
    };
    CHECK_THAT(refused({"--uniform", "u_Keep=1"}, shader),
               Contains("--uniform u_Keep: the shader has no such name") && Contains("u_Kept"));
    CHECK_THAT(refused({"--uniform", "u_Kept=1,2"}, shader), Contains("expected 1 numbers, got 2"));
    CHECK_THAT(refused({"--fill", "Number=iota"}, shader),
               Contains("--fill Number: the shader has no such name; it has Numbers, Numbers.x"));
    CHECK_THAT(refused({"--fill", "Numbers=many"}, shader),
               Contains("--fill Numbers: expected iota, zero or a number"));
    CHECK_THAT(refused({"--fill", "Numbers"}, shader), Contains("--fill Numbers: expected NAME=VALUE"));
    CHECK_THAT(refused({"--groups", "0"}, shader), Contains("--groups 0: expected one to three numbers from 1"));
    CHECK_THAT(refused({"--size", "Number=4"}, shader), Contains("--size Number: the shader has no such name"));
    CHECK_THAT(refused({}, (folder.path() / "missing.comp").string()), Contains("no such file"));
    CHECK_THAT(refused({}, folder.write("slip.comp", "#version 430\nvoid main() {\n    float x = y;\n}\n").string()),
               Contains("shader") && Contains("slip.comp:3: "));
    const std::string number = folder
                                   .write("number.comp", "#version 430 core\nlayout(local_size_x = 1) in;\n"
                                                         "uniform int u_Count;\nbuffer Numbers { int x[]; };\n"
                                                         "void main() { x[0] = u_Count; }\n")
                                   .string();
    for (const char* value : {"1.5", "99999999999", "-3000000000", "nan"})
        CHECK_THAT(refused({"--uniform", std::string("u_Count=") + value}, number),
                   Contains("--uniform u_Count: '" + std::string(value) + "' is no int;"));
    const std::string typed =
        folder
            .write("typed.comp", "#version 430 core\nlayout(local_size_x = 1) in;\n"
                                 "uniform bool u_On;\nuniform uint u_Seed;\nuniform float u_Kept;\n"
                                 "buffer Numbers { float x[]; };\n"
                                 "void main() { x[gl_GlobalInvocationID.x] = u_On ? float(u_Seed) : u_Kept; }\n")
            .string();
    CHECK_THAT(refused({"--uniform", "u_On=2"}, typed), Contains("'2' is no bool;"));
    CHECK_THAT(refused({"--uniform", "u_Kept=1e39"}, typed), Contains("'1e39' is no float;"));
    CHECK(run_lockstep(
              {"examine", typed, "--uniform", "u_On=true", "--uniform", "u_Seed=0xff", "--uniform", "u_Kept=0x1p-2"})
              .status == 0);
    CHECK_THAT(refused({"--groups", ""}, typed), Contains("--groups : expected one to three numbers"));
    CHECK_THAT(refused({"--define", "A B=1"}, typed), Contains("'A B' is no name of a macro"));
    CHECK_THAT(refused({"--define", "A=1\n#undef B"}, typed), Contains("expected a text of one line"));
    CHECK_THAT(refused({}, folder.write("stage.glsl", "#version 430\nvoid main() {}\n").string()),
               Contains("expected a stage NAME.comp, NAME.vert, NAME.geom or NAME.frag"));
    CHECK_THAT(refused({"--input", "a_Place=1"}, shader), Contains("--invocations and --input are of vertex"));
    const std::string vertex =
        folder.write("stage.vert", "#version 430\nin vec2 a_Place;\nvoid main() { gl_Position = a_Place.xyxy; }\n")
            .string();
    CHECK_THAT(refused({"--groups", "2"}, vertex), Contains("--groups is of compute stages; use --invocations"));
    CHECK_THAT(refused({"--input", "a_Plane=1,2"}, vertex),
               Contains("--input a_Plane: the shader has no such name; it has a_Place; did you mean a_Place?"));
    CHECK_THAT(refused({"--input", "a_Place=1"}, vertex), Contains("--input a_Place: expected 2 numbers, got 1"));
}

TEST_CASE(
    "examine: members of blocks and push constants are given as uniforms are; GLSL for Vulkan, ES and no version run") {
    const TemporaryFolder folder;
    const auto examined = [&](const std::string& text, std::vector<std::string> options) {
        options.insert(options.begin(), {"examine", folder.write("shader.comp", text).string(), "--groups", "1"});
        return run_lockstep(options);
    };
    const std::string writes = "layout(std430, binding = 0) buffer Out { float x[]; };\n"
                               "layout(local_size_x = 1) in;\n"
                               "void main() {\n    x[N] = 1.0;\n}\n";
    const std::string push = "#version 450\n#define N push.n\n"
                             "layout(push_constant) uniform Push { int n; } push;\n" +
                             writes;
    CHECK(examined(push, {}).status == 0);
    CHECK_THAT(examined(push, {"--uniform", "Push.n=7"}).out, Contains("shader.comp:7: access outside of a buffer"));
    CHECK_THAT(refusal(examined(push, {"--uniform", "n=7"})), Contains("it has Push.n"));
    CHECK_THAT(refusal(examined(push, {"--uniform", "Push.n=7,8"})), Contains("expected 1 numbers, got 2"));
    const std::string block =
        "#version 310 es\n#define N n[1].y\nlayout(binding = 1) uniform Number { ivec2 n[2]; };\n" + writes;
    CHECK_THAT(examined(block, {"--uniform", "n=0,0,0,9"}).out, Contains("word 9 of Out"));
    const std::string vulkan = "#version 450\n#define N u_N\n"
                               "layout(set = 0, binding = 1) uniform Number { int of_a_set; };\nuniform int u_N;\n" +
                               writes;
    CHECK_THAT(examined(vulkan, {}).out, Contains("0 for want of --uniform: u_N\n"));
    CHECK_THAT(examined(vulkan, {"--uniform", "u_N=5"}).out, Contains("word 5 of Out"));
    CHECK_THAT(examined(writes, {"--define", "N=4"}).out, Contains("shader.comp:4: access outside of a buffer"));
}

TEST_CASE("examine: subgroups have the size that is given") {
    const TemporaryFolder folder;
    const std::string shader = folder
                                   .write("sums.comp", "#version 450\n"
                                                       "#extension GL_KHR_shader_subgroup_arithmetic : require\n"
                                                       "layout(local_size_x = 64) in;\n"
                                                       "layout(binding = 0) buffer Out { uint x[]; };\n"
                                                       "void main() {\n    x[subgroupAdd(1u)] = 1u;\n}\n")
                                   .string();
    const auto examined = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"examine", shader, "--groups", "1", "--size", "Out=8"});
        return run_lockstep(options);
    };
    CHECK_THAT(examined({}).out, Contains("sums.comp:6: access outside of a buffer") && Contains("word 32 of Out"));
    CHECK_THAT(examined({"--subgroup-size", "8"}).out, Contains("word 8 of Out"));
    CHECK_THAT(refusal(examined({"--subgroup-size", "12"})), Contains("--subgroup-size 12: expected a power of 2"));
}

TEST_CASE("examine: what would take more than is made up or run is refused, products that do not fit in 64 bits too") {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& name, const std::string& text, std::vector<std::string> options = {}) {
        options.insert(options.begin(), {"examine", folder.write(name, "#version 430\n" + text).string()});
        return refusal(run_lockstep(options));
    };
    const std::string group = "layout(local_size_x = 8) in;\n";
    const std::string image = group +
                              "layout(rgba32f, binding = 0) uniform image2D u_Image;\n"
                              "void main() { imageStore(u_Image, ivec2(gl_GlobalInvocationID.xy), vec4(1.0)); }\n";
    CHECK_THAT(refused("image.comp", image, {"--size", "u_Image=2147483648,2147483648"}),
               Contains("--size u_Image: 2147483648 * 2147483648 * 1 * 4 words; expected at most 67108864"));
    for (const char* const size : {"u_Image=0,4", "u_Sky=4,4,3", "u_Sky=4,2,6"})
        CHECK_THAT(refused("sky.comp",
                           group +
                               "layout(rgba32f, binding = 0) uniform image2D u_Image;\nuniform samplerCube u_Sky;\n"
                               "void main() { imageStore(u_Image, ivec2(0), textureLod(u_Sky, vec3(1.0), 0.0)); }\n",
                           {"--size", size}),
                   Contains("expected texels along each axis from 1, of a cube N,N,6"));
    CHECK_THAT(refused("none.comp", group + "void main() {}\n", {"--groups", "65535,65535,65535"}),
               Contains("--groups 65535,65535,65535: 65535 * 65535 * 65535 * 8 invocations; expected at most"));
    CHECK_THAT(refused("two.comp",
                       group + "buffer A { float x[]; };\nbuffer B { float y[]; };\n"
                               "void main() { x[gl_GlobalInvocationID.x] = y[0]; }\n",
                       {"--size", "A=40000000", "--size", "B=40000000"}),
               Contains("--size B: 80000000 words of blocks and images together"));
    CHECK_THAT(refused("many.geom",
                       "layout(points) in;\nlayout(points, max_vertices = 200) out;\n"
                       "void main() { gl_Position = vec4(0.0); EmitVertex(); }\n",
                       {"--invocations", "1000000"}),
               Contains("--invocations 1000000: 1000000 * 200 vertices; expected at most"));
    CHECK_THAT(refused("wide.vert", "in vec4 a_All[100];\nvoid main() { gl_Position = a_All[gl_VertexID % 100]; }\n",
                       {"--invocations", "1000000"}),
               Contains("--invocations 1000000: input a_All: 1000000 * 400 words; expected at most"));
    std::string nested = "struct S0 { float a; };\n";
    for (int k = 1; k <= 21; ++k)
        nested += "struct S" + std::to_string(k) + " { S" + std::to_string(k - 1) + " a, b; };\n";
    CHECK_THAT(refused("nested.comp", group + nested + "shared S21 all;\nvoid main() { all.a = all.b; }\n"),
               Contains("a value of 2097152 numbers"));
    CHECK_THAT(
        refused("blocks.comp", group + "buffer A { float x[]; } all[100000];\nvoid main() { all[0].x[0] = 1.0; }\n"),
        Contains("an array of 100000 blocks or images"));
}

TEST_CASE("examine: a module that lies beside the named file is left alone") {
    const TemporaryFolder folder;
    const std::string right = folder.write("right.comp", sum("barrier();")).string();
    folder.write("right.comp.spv", "another file");
    CHECK(run_lockstep({"examine", right}).status == 0);
    CHECK_THAT(refusal(run_lockstep({"examine", right + ".spv"})), Contains("right.comp.spv"));
}

TEST_CASE("examine: a text of an old version is one line, not the compiler's tables") {
    const TemporaryFolder folder;
    const Outcome old = run_lockstep(
        {"examine", folder.write("old.frag", "#version 130\nout vec4 o;\nvoid main() { o = vec4(1.0); }\n").string()});
    CHECK(old.out == "old.frag: no findings in 64 fragments\ncoverage  old.frag: 1 of 1 line in 64 fragments\n");
}

TEST_CASE("examine: vertex, geometry and fragment stages run with inputs that are given or made up") {
    const TemporaryFolder folder;
    const auto examined = [&](const std::string& name, const std::string& text, std::vector<std::string> options = {}) {
        options.insert(options.begin(), {"examine", folder.write(name, "#version 430\n" + text).string()});
        return run_lockstep(options);
    };
    const std::string shade = "in vec3 v_Normal;\nuniform float u_Shine;\nout vec4 o_Colour;\nvoid main() {\n"
                              "    float edge = fwidth(gl_FragCoord.x);\n"
                              "    o_Colour = vec4(pow(v_Normal.z, u_Shine), edge, normalize(v_Normal).xy);\n}\n";
    const Outcome right = examined("shade.frag", shade, {"--uniform", "u_Shine=2", "--invocations", "9"});
    CHECK(right.status == 0);
    CHECK(right.out == "shade.frag: no findings in 12 fragments\ncoverage  shade.frag: all 2 lines in 12 fragments\n");
    const Outcome behind = examined("shade.frag", shade, {"--uniform", "u_Shine=2", "--input", "v_Normal=0,0,-1"});
    CHECK(behind.status == 1);
    CHECK_THAT(behind.out, Contains("shade.frag: 1 finding in 64 fragments\n") &&
                               Contains("shade.frag:7: pow of a negative base, or of 0 to no positive power (GLSL "
                                        "4.60, 8.2): pow(-1, 2); invocation 0; 64 times"));
    const Outcome vertex = examined("place.vert", "in vec3 a_Place;\nout vec3 v_Place;\nvoid main() {\n"
                                                  "    if (a_Place.x > 0.5)\n        v_Place = a_Place;\n"
                                                  "    gl_Position = vec4(a_Place, 1.0);\n}\n");
    // The line of the last statement, or, since glslang 15, of the brace behind it.
    CHECK_THAT(vertex.out, Contains("place.vert:7: output that is not written (GLSL 4.60, 4.3.6): v_Place;") ||
                               Contains("place.vert:8: output that is not written (GLSL 4.60, 4.3.6): v_Place;"));
    const Outcome geometry =
        examined("strip.geom", "layout(points) in;\nlayout(line_strip, max_vertices = 2) out;\nvoid main() {\n"
                               "    for (int i = 0; i < 2; ++i) {\n        gl_Position = gl_in[0].gl_Position;\n"
                               "        EmitVertex();\n    }\n}\n");
    CHECK(geometry.out == "strip.geom: no findings in 64 primitives\ncoverage  strip.geom: all 3 lines and 2 branch "
                          "sides in 64 primitives\n");
}

TEST_CASE("examine: a stage that the driver refuses was not run, whatever its text is found to do") {
    if (!have_software_gl())
        return skip("no software GL");
    const TemporaryFolder folder;
    const std::string file =
        folder
            .write("mine.comp",
                   "#version 430 core\nlayout(local_size_x = 1) in;\nbuffer Numbers { float x; };\n"
                   "void main() {\n    if (gl_GlobalInvocationID.x == 0u) x = 1.0;\n#ifndef GL_SPIRV\n    foo();\n"
                   "#endif\n}\n")
            .string();
    const Outcome outcome = run_lockstep({"examine", file, "--quiet", "--gl", software_gl()});
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains("not run: ") && Contains("mine.comp:7"));
}

TEST_CASE("check: a report on shaders of one's own says what their texts show, whatever the driver made of it") {
    if (!have_software_gl())
        return skip("no software GL");
    const TemporaryFolder shaders;
    std::ifstream shipped("shaders/dust/update.comp");
    std::string text{std::istreambuf_iterator<char>(shipped), {}};
    const std::string set = "vec3 a = vec3(0.0);";
    REQUIRE(text.find(set) != std::string::npos);
    const auto check = [&] {
        return run_lockstep({"check", "data/scenes/dust/spheres.json", "--particles", "100", "--frames", "1",
                             "--shaders", shaders.path().string(), "--gl", software_gl()});
    };
    shaders.write("update.comp", text);
    CHECK_THAT(check().out, !Contains("never set"));
    shaders.write("update.comp", text.replace(text.find(set), set.size(), "vec3 a;"));
    CHECK_THAT(check().out, Contains("use of a variable that was never set (GLSL 4.60, 5.8): variable a"));
}

} // namespace lockstep::test::examine_command_test
