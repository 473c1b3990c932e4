#include <fstream>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>
#include <lockstep/catch.hpp>
#include <lockstep/shader_text.hpp>
#include <lockstep/system_program.hpp>

#include "tests/consumer/grains/grains.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::own_text_test {

using lockstep::test::TemporaryFolder;

/// Systems of one's own whose reference is a shader's text, and no twin.
namespace {

/// A kernel that changes two buffers in place and counts by atomics, in another hand than tests/package/sparks.
constexpr const char* plain_burn = R"(#version 430
layout(local_size_x = 1) in;
layout(std430) buffer heatBuffer { float heat[]; };
layout(std430) buffer litBuffer { int lit[]; };
layout(std430) buffer burntBuffer { uint burnt; };
layout(std430) readonly buffer lossBuffer { float loss[]; };
uniform uint u_ItemCount;

void main() {
    uint spark = gl_GlobalInvocationID.x;
    if (spark < u_ItemCount && lit[spark] != 0) {
        precise float cooled = heat[spark];
        cooled -= loss[0] * FACTOR;
        heat[spark] = cooled;
        if (cooled < 0.0) {
            atomicAdd(burnt, 1u);
            lit[spark] = 0;
        }
    }
}
)";

const Schema& schema() {
    static const Schema all =
        checked({"sparks",
                 {{.name = "sparks",
                   .item = "spark",
                   .title = "the sparks",
                   .fields = {{.name = "heat", .block = "heatBuffer"},
                              {.name = "lit", .scalar = Scalar::int32, .block = "litBuffer"}}},
                  {.name = "tally",
                   .item = "tally",
                   .title = "the tally",
                   .fields = {{.name = "burnt", .scalar = Scalar::uint32, .block = "burntBuffer"}}}}});
    return all;
}

bool runs(int frame) { return frame % 4 != 0; }

std::vector<GlPass> passes() {
    GlPass burn{.name = "burn", .stage = Stage::compute};
    burn.data["lossBuffer"] = [](int frame) { return std::vector<float>{0.25F * static_cast<float>(frame % 3)}; };
    burn.defines = {{"FACTOR", "0.5"}};
    burn.runs = runs;
    return {burn, {.name = "tally", .stage = Stage::compute, .resource = 1, .runs = runs, .continues = true}};
}

System sparks(std::size_t count, const std::string& reference) {
    System system{.name = "sparks",
                  .schema = schema(),
                  .passes = passes_by_text(schema(), passes(), reference),
                  .mistakes = {},
                  .start = {schema(), {{count}, {1}}},
                  .settings = {}};
    for (std::size_t i = 0; i < count; ++i) {
        system.start.set(FieldId{0, 0}, i, static_cast<float>(i % 23) * 0.13F);
        system.start.set(FieldId{0, 1}, i, std::int32_t{1});
    }
    return system;
}

const Gl& gl() {
    static const Gl one;
    return one;
}

std::string text_of(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

/// The folder, with `file` in it, where `what` became `by`.
std::string planted(const TemporaryFolder& folder, const std::string& file, std::string text, const std::string& what,
                    const std::string& by) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    folder.write(file, text.replace(at, what.size(), by));
    return folder.path().string();
}

/// A folder with the right text of the kernel.
std::string reference_folder(const TemporaryFolder& folder) {
    folder.write("burn.comp", plain_burn);
    return folder.path().string();
}

const std::string grains_shader = "tests/consumer/grains/grains_step.vert";

int run_grains(std::vector<std::string> words) {
    words.insert(words.begin(), {"grains", "check", "--frames", "12", "--quiet"});
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    return run_system_program(
        static_cast<int>(words.size()), argv.data(), [] { return grains::system(200); }, grains::passes,
        "tests/consumer/grains");
}

} // namespace

TEST_CASE("own text: a kernel agrees with a text in another hand, without a twin in C++") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    const std::size_t count = GENERATE(1, 63, 65, 1000);
    const System system = sparks(count, reference_folder(folder));
    GlSystemSide gpu(gl(), system, passes(), "tests/package/sparks");
    const MatchResult result = match_system(gpu, system, {.frames = 40});
    INFO(result.text());
    CHECK(result.report().verdict == Verdict::agree);
    CHECK(result.report().total.compared() == std::uint64_t{30} * (2 * count + 1));
    CHECK_THAT(result.text(), !Catch::Contains("not looked into"));
    CHECK_THAT(result.text(), Catch::Contains("\ncoverage  burn.comp: "));
}

TEST_CASE("own text: what differs from the text is DIVERGENT, and notes name the line without a counterpart") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder references, shaders;
    const std::string reference = reference_folder(references);
    const auto text_for = [&](const std::string& what, const std::string& by) {
        const std::string mine = planted(shaders, "burn.comp", text_of("tests/package/sparks/burn.comp"), what, by);
        const System system = sparks(1000, reference);
        GlSystemSide gpu(gl(), system, passes(), mine);
        const MatchResult result = match_system(gpu, system, {.frames = 40, .reference = reference});
        CHECK(result.report().verdict == Verdict::divergent);
        return result.text();
    };
    CHECK_THAT(text_for("loss[0] * FACTOR", "loss[0]"),
               Catch::Contains("without a counterpart in the reference: burn.comp:13: ") &&
                   Catch::Contains("heat[i] - loss[0]"));
    CHECK_THAT(text_for("lit[i] = 0;", "lit[i] = 2;"),
               Catch::Contains("without a counterpart in the reference: burn.comp:16: lit[i] = 2;"));
    CHECK_THAT(text_for("if (left < 0.0)", "if (left < 0.1)"),
               Catch::Contains("without a counterpart in the reference: burn.comp:15: "));
}

TEST_CASE("own text: what runs of it find is a note of the match") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder references, shaders;
    const System system = sparks(1000, reference_folder(references));
    const std::string mine = planted(shaders, "burn.comp", text_of("tests/package/sparks/burn.comp"),
                                     "atomicAdd(burnt, 1u);", "burnt = burnt + 1u;");
    GlSystemSide gpu(gl(), system, passes(), mine);
    const MatchResult result = match_system(gpu, system, {.frames = 40});
    INFO(result.text());
    CHECK_FALSE(result.passed());
    CHECK_THAT(result.text(), Catch::Contains("note      burn.comp:17: "));
}

TEST_CASE("own text: a text that is missing, of no pass or not GLSL is an error that names it") {
    const TemporaryFolder empty, other, broken;
    other.write("burnt.comp", plain_burn);
    broken.write("burn.comp", "#version 430\nlayout(local_size_x = 1) in;\nvoid main() { heat = 1.0; }\n");
    CHECK_THROWS_WITH(sparks(1, (empty.path() / "nowhere").string()), Catch::Contains("nowhere"));
    CHECK_THROWS_WITH(sparks(1, empty.path().string()), Catch::Contains("burn.comp"));
    CHECK_THROWS_WITH(sparks(1, other.path().string()), Catch::Contains("burn"));
    CHECK_THROWS_WITH(sparks(1, broken.path().string()), Catch::Contains("burn.comp:3"));
}

TEST_CASE("own text: a wrong shader of a system with twins is told from the text that the program brings") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder wrong;
    const std::string slip =
        planted(wrong, "grains_step.vert", text_of(grains_shader), "u_Gravity - a_Velocity * u_Drag", "u_Gravity");
    const System system = grains::system(200);
    GlSystemSide gpu(gl(), system, grains::passes(), slip);
    const MatchResult result = match_system(gpu, system, {.frames = 12, .reference = "tests/consumer/grains"});
    INFO(result.text());
    CHECK(result.report().verdict == Verdict::divergent);
    CHECK_THAT(result.text(), Catch::Contains("without a counterpart in the reference: grains_step.vert"));
}

TEST_CASE("own text: a program of one's own asks how much of its shader's text was run") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder half;
    const std::string never =
        planted(half, "grains_step.vert", text_of(grains_shader), "void main() {",
                "void main() {\n    if (u_Tick < 0.0) {\n        gl_Position = vec4(0.0);\n        return;\n    }");
    CHECK(run_grains({"--cover-at-least", "75%"}) == 0);
    CHECK(run_grains({"--shaders", never}) == 0);
    CHECK(run_grains({"--shaders", never, "--cover-at-least", "75%"}) == 1);
}

TEST_CASE("own text: a program of one's own takes texts in the place of its twins") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder right, wrong;
    right.write("grains_step.vert", text_of(grains_shader));
    const std::string slip = planted(wrong, "grains_step.vert", text_of(grains_shader),
                                     "a_Position + velocity * u_Tick", "a_Position + velocity * 0.02001");
    CHECK(run_grains({}) == 0);
    CHECK(run_grains({"--reference", right.path().string()}) == 0);
    CHECK(run_grains({"--reference", slip}) == 1);
    CHECK(run_grains({"--shaders", slip}) == 1);
    CHECK(run_grains({"--shaders", slip, "--reference", slip}) == 0);
    CHECK(run_grains({"--reference", (right.path() / "nowhere").string()}) == 2);
}

} // namespace lockstep::test::own_text_test
