#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/cli/run_program.hpp"

namespace lockstep::test::check_file_test {

using Catch::Contains;
using Catch::EndsWith;
using nlohmann::json;

namespace {

namespace fs = std::filesystem;

/// A copy of a shipped example, to be changed.
class Example {
  public:
    explicit Example(const std::string& name) : name_(name) {
        fs::copy(fs::path("data/checks") / name, folder_.path() / name, fs::copy_options::recursive);
    }
    [[nodiscard]] std::string file() const { return (folder_.path() / name_ / (name_ + ".json")).string(); }
    [[nodiscard]] std::string beside(const std::string& file) const { return (folder_.path() / file).string(); }

    void edit(const std::string& shader, const std::string& from, const std::string& to) const {
        const fs::path path = folder_.path() / name_ / shader;
        std::ifstream stream(path);
        std::string text{std::istreambuf_iterator<char>(stream), {}};
        const std::size_t at = text.find(from);
        REQUIRE(at != std::string::npos);
        std::ofstream(path) << text.replace(at, from.size(), to);
    }

  private:
    TemporaryFolder folder_;
    std::string name_;
};

Outcome run(const std::string& verb, const std::string& file, const std::vector<std::string>& more = {}) {
    return run_lockstep(joined({verb, file, "--gl", software_gl()}, more));
}

/// One line of a report.
std::string line(const Outcome& outcome, const std::string& label) {
    const std::size_t at = outcome.out.find("\n" + label);
    return at == std::string::npos ? outcome.out + outcome.err
                                   : outcome.out.substr(at + 1, outcome.out.find('\n', at + 1) - at - 1);
}

/// A check file and its shaders in a folder of their own.
struct Made {
    TemporaryFolder folder;
    std::string file;

    Made(const json& document, const std::vector<std::pair<std::string, std::string>>& shaders)
        : file(folder.write("mine.json", document.dump()).string()) {
        for (const auto& [name, text] : shaders)
            folder.write(name, "#version 450 core\n" + text);
    }
    [[nodiscard]] Outcome check(const std::vector<std::string>& more = {}) const {
        return run("check", file, joined({"--frames", "3"}, more));
    }
};

constexpr const char* doubling = "layout(local_size_x = 8) in;\n"
                                 "layout(std430) buffer Data { float x[]; };\n"
                                 "uniform float u_By;\n"
                                 "void main() {\n"
                                 "    if (gl_GlobalInvocationID.x < x.length())\n"
                                 "        x[gl_GlobalInvocationID.x] *= u_By;\n"
                                 "}\n";

json doubled() {
    return {{"state", {{"Data", {{"count", 20}, {"start", {{"index", {1, 0.5}}}}}}}},
            {"passes", {{{"shader", "double.comp"}, {"uniforms", {{"u_By", 2}}}}}}};
}

} // namespace

TEST_CASE("check file: the shipped examples agree with their references, or differ as GL allows") {
    if (!have_software_gl())
        return;
    for (const std::string name : {"boids", "scan", "heat"}) {
        const Outcome said = run("check", "data/checks/" + name + "/" + name + ".json", {"--frames", "6"});
        INFO(name << "\n" << said.out << said.err);
        CHECK(said.status == 0);
        CHECK_THAT(said.out,
                   Contains("note      reference of " + name + ": its text in data/checks/" + name + "/reference"));
    }
}

TEST_CASE("check file: a slip is DIVERGENT, and its line is named") {
    if (!have_software_gl())
        return;
    const Example heat("heat");
    heat.edit("heat.comp", "4.0 * own", "3.0 * own");
    const Outcome said = run("check", heat.file(), {"--frames", "2"});
    CHECK(said.status == 1);
    CHECK_THAT(line(said, "verdict"), Contains("DIVERGENT from frame 0 on"));
    CHECK_THAT(said.out, Contains("heat.comp:20: float heat = own + rate * (sum - 3.0 * own);"));
    const Example scan("scan");
    scan.edit("scan.comp", "        barrier();\n        tile[at] += left;", "        tile[at] += left;");
    const Outcome raced = run("check", scan.file(), {"--frames", "2"});
    CHECK_THAT(raced.out, Contains("scan.comp:16: race on shared memory"));
}

TEST_CASE("check file: records of any layout hold what the shader has there") {
    if (!have_software_gl())
        return;
    for (const std::string layout : {"std430", "std140"}) {
        const Made made(
            {{"state",
              {{"Records",
                {{"count", 13},
                 {"start",
                  {{"place", {{"random", {-1, 1}}}},
                   {"size", 0.5},
                   {"turned", {1, 2, 3}},
                   {"turned_0", {1, 0, 0}},
                   {"kinds",
                    {{"values",
                      {{1, -2},
                       {3, 4},
                       {5, 6},
                       {7, 8},
                       {9, 10},
                       {1, 2},
                       {3, 4},
                       {5, 6},
                       {7, 8},
                       {1, 2},
                       {3, 4},
                       {5, 6},
                       {7, 8}}}}},
                   {"steps_2", 7}}}}},
               {"total", {{"count", 1}}},
               {"fixed", {{"count", 13}, {"start", {{"index", {0, 3}}}}}}}},
             {"uniforms",
              {{"Frame.tick", {{"frame", 0.25}, {"from", 1}}},
               {"Frame.turn", {1, 0, 0, 0, 0, 1, 0, -1, 0}},
               {"u_On", true},
               {"u_Kind", {{"frames", {3, 5}}}},
               {"u_Weights", {0.5, 0.25, 0.125}},
               {"u_Mask", {1, 2, 4, 8}}}},
             {"passes",
              {{{"shader", "records.comp"}, {"bind", {{"Sum", "total"}, {"Fixed", "fixed"}}}, {"invocations", 13}}}}},
            {{"records.comp",
              "layout(local_size_x = 4) in;\n"
              "struct Record { vec3 place; float size; mat3 turned; ivec2 kinds; uint steps[3]; };\n"
              "layout(" +
                  layout +
                  ") buffer Records { Record records[]; };\n"
                  "layout(" +
                  layout +
                  ") buffer Sum { uint sum; int least; vec4 last; } total;\n"
                  "layout(" +
                  layout +
                  ") readonly buffer Fixed { float fixed_[13]; };\n"
                  "layout(std140) uniform Block { float tick; mat3 turn; } Frame;\n"
                  "uniform bool u_On; uniform int u_Kind; uniform float u_Weights[3]; uniform uvec4 u_Mask;\n"
                  "void main() {\n"
                  "    uint i = gl_GlobalInvocationID.x;\n"
                  "    if (i >= records.length())\n"
                  "        return;\n"
                  "    records[i].place = Frame.turn * records[i].place;\n"
                  "    records[i].size = u_On ? records[i].size * Frame.tick : -1.0;\n"
                  "    records[i].turned[1][2] = fixed_[i] * u_Weights[1];\n"
                  "    records[i].kinds += ivec2(u_Kind, -u_Kind);\n"
                  "    records[i].steps[i % 3u] += u_Mask[i % 4u];\n"
                  "    atomicAdd(total.sum, records[i].steps[2]);\n"
                  "    atomicMin(total.least, records[i].kinds.y);\n"
                  "    if (i == 5u)\n"
                  "        total.last = vec4(Frame.tick, u_Weights[2], 2.0, 1.0);\n"
                  "}\n"}});
        const std::string text = [&] {
            std::ifstream stream(made.file);
            return std::string{std::istreambuf_iterator<char>(stream), {}};
        }();
        INFO(layout);
        // "Frame" is the instance's name; GL knows members by the block's.
        CHECK_THAT(refusal(made.check()), Contains("/uniforms/Frame.tick: no pass has a uniform of this name; expected "
                                                   "one of Block.tick, Block.turn, u_Kind, u_Mask, u_On, u_Weights"));
        json right = json::parse(text);
        for (const std::string member : {"tick", "turn"}) {
            right["uniforms"]["Block." + member] = right["uniforms"]["Frame." + member];
            right["uniforms"].erase("Frame." + member);
        }
        std::ofstream(made.file) << right.dump();
        // "turned" is no field: its columns are.
        CHECK_THAT(refusal(made.check()),
                   Contains("/state/Records/start/turned: its shaders declare no field turned; they have place, size, "
                            "turned_0, turned_1, turned_2, kinds, steps_0"));
        right["state"]["Records"]["start"].erase("turned");
        std::ofstream(made.file) << right.dump();
        const Outcome said = made.check();
        INFO(said.out << said.err);
        CHECK(said.status == 0);
        CHECK_THAT(line(said, "verdict"), Contains("AGREE: every bit of"));
        const Outcome cpu = run_lockstep({"hash", made.file, "--frames", "3"}),
                      gpu = run("hash", made.file, {"--frames", "3", "--side", "gpu"});
        CHECK(cpu.out == gpu.out);
    }
}

TEST_CASE("check file: images in place, of three dimensions, filtered, and of codes") {
    if (!have_software_gl())
        return;
    const Made made(
        {{"state",
          {{"volume", {{"size", {5, 4, 3}}, {"format", "rgba32f"}, {"start", {{"random", {0, 1}}}}}},
           {"shade", {{"size", {4, 4}}, {"format", "rgba8"}, {"start", {10, 20, 30, 255}}}},
           {"smooth_", {{"size", {8, 8}}, {"format", "r32f"}, {"filter", "linear"}, {"start", {{"index", {0, 0.5}}}}}},
           {"made", {{"size", {8, 8}}, {"format", "r32f"}}}}},
         {"passes",
          {{{"shader", "volume.comp"}, {"bind", {{"u_Volume", "volume"}}}, {"groups", {5, 4, 1}}},
           {{"shader", "shade.comp"}, {"bind", {{"from", "shade"}, {"to", "shade"}}}},
           {{"shader", "smooth.comp"}, {"bind", {{"u_From", "smooth_"}, {"u_To", "made"}}}}}}},
        {{"volume.comp", "layout(local_size_x = 1) in;\n"
                         "layout(rgba32f) uniform image3D u_Volume;\n"
                         "void main() {\n"
                         "    ivec3 p = ivec3(gl_WorkGroupID.xy, 1);\n"
                         "    imageStore(u_Volume, p, imageLoad(u_Volume, p).gbar + 1.0);\n"
                         "}\n"},
         {"shade.comp", "layout(local_size_x = 2, local_size_y = 2) in;\n"
                        "uniform sampler2D from;\n"
                        "layout(rgba8) writeonly uniform image2D to;\n"
                        "void main() {\n"
                        "    ivec2 p = ivec2(gl_GlobalInvocationID.xy);\n"
                        "    imageStore(to, p, texelFetch(from, ivec2(3) - p, 0).brga * 0.5);\n"
                        "}\n"},
         {"smooth.comp", "layout(local_size_x = 8, local_size_y = 8) in;\n"
                         "uniform sampler2D u_From;\n"
                         "layout(r32f) writeonly uniform image2D u_To;\n"
                         "void main() {\n"
                         "    vec2 at = (vec2(gl_GlobalInvocationID.xy) + 1.0) / 8.0;\n"
                         "    imageStore(u_To, ivec2(gl_GlobalInvocationID.xy), textureLod(u_From, at, 0.0));\n"
                         "}\n"}});
    const Outcome said = made.check();
    INFO(said.out << said.err);
    CHECK(said.status == 0);
    CHECK_THAT(line(said, "verdict"), Contains("AGREE") || Contains("LEGAL"));
}

TEST_CASE("check file: a fragment stage draws an image, texel by texel") {
    if (!have_software_gl())
        return;
    const json document{{"state",
                         {{"cells", {{"size", {7, 5}}, {"format", "r32f"}, {"start", {{"random", {0, 1}}}}}},
                          {"slopes", {{"size", {7, 5}}, {"format", "rgba32f"}}}}},
                        {"uniforms", {{"u_Step", 0.5}}},
                        {"passes",
                         {{{"shader", "spread.frag"}, {"bind", {{"u_Cells", "cells"}, {"colour", "cells"}}}},
                          {{"shader", "slope.frag"}, {"bind", {{"u_Cells", "cells"}, {"slope", "slopes"}}}}}}};
    const std::string spread =
        "uniform sampler2D u_Cells; uniform float u_Step;\n"
        "out vec4 colour;\n"
        "void main() {\n"
        "    ivec2 p = ivec2(gl_FragCoord.xy);\n"
        "    if (p.x == 3)\n"
        "        discard;\n"
        "    float own = texelFetch(u_Cells, p, 0).r;\n"
        "    colour = vec4(own + u_Step * (texelFetch(u_Cells, max(p - 1, ivec2(0)), 0).r - own));\n"
        "}\n";
    const std::string slope = "uniform sampler2D u_Cells;\n"
                              "out vec4 slope;\n"
                              "void main() {\n"
                              "    float own = texelFetch(u_Cells, ivec2(gl_FragCoord.xy), 0).r;\n"
                              "    slope = vec4(dFdx(gl_FragCoord.x), own, gl_FragCoord.zw);\n"
                              "}\n";
    const Made made(document, {{"spread.frag", spread}, {"slope.frag", slope}});
    const Outcome said = made.check();
    INFO(said.out << said.err);
    CHECK(said.status == 0);
    CHECK_THAT(line(said, "verdict"), Contains("AGREE") || Contains("LEGAL"));
    CHECK_THAT(said.out, Contains("compared  105 floats of cells texels, 420 of slopes texels"));
    fs::create_directory(made.folder.path() / "reference");
    std::string other = spread;
    other.replace(other.find("p - 1"), 5, "p - 2");
    made.folder.write("reference/spread.frag", "#version 450 core\n" + other);
    made.folder.write("reference/slope.frag", "#version 450 core\n" + slope);
    const Outcome wrong = made.check({"--reference", (made.folder.path() / "reference").string()});
    INFO(wrong.out << wrong.err);
    CHECK(wrong.status == 1);
    CHECK_THAT(line(wrong, "verdict"), Contains("DIVERGENT"));
    CHECK_THAT(wrong.out, Contains("without a counterpart in the reference: spread.frag:9:"));
    const Outcome explained = run("explain", made.file, {"--frame", "1", "--item", "2,2", "--pass", "spread"});
    CHECK_THAT(explained.out, Contains("spread.frag, run by lockstep: it ends in the GPU's bits"));
    json inputs = document;
    inputs["passes"].erase(1);
    inputs["state"].erase("slopes");
    CHECK_THAT(refusal(Made(inputs, {{"spread.frag", "in vec2 v_At;\n" + spread.substr(0, spread.find("colour = ")) +
                                                         "colour = vec4(v_At, u_Step, own);\n}\n"}})
                           .check()),
               Contains("/passes/0: nothing is given for input v_At of "));
    inputs["state"]["cells"]["format"] = "rgba8";
    CHECK_THAT(refusal(Made(inputs, {{"spread.frag", spread}}).check()),
               Contains("/state/cells: is what colour of ") &&
                   Contains("expected an image of two sides in a format of 32 bits"));
    inputs["state"]["cells"]["format"] = "r32f";
    inputs["passes"][0]["groups"] = {1};
    CHECK_THAT(refusal(Made(inputs, {{"spread.frag", spread}}).check()),
               Contains("/passes/0/groups: is of a compute stage"));
}

TEST_CASE("check file: shaders of WebGL and of Vulkan run unchanged, and their lines are named") {
    if (!have_software_gl())
        return;
    struct Whole : Made { ///< of a text with its own #version, or none
        Whole(const json& document, const std::string& name, const std::string& text) : Made(document, {}) {
            folder.write(name, text);
        }
    };
    const auto wrong_at = [](const Made& made, const std::string& name, const std::string& right) {
        fs::create_directory(made.folder.path() / "reference");
        made.folder.write("reference/" + name, right);
        return made.check({"--reference", (made.folder.path() / "reference").string()});
    };
    const json image{{"size", {8, 6}}, {"format", "rgba32f"}, {"filter", "linear"}, {"start", {{"random", {0, 1}}}}};
    const json drawn{{"state", {{"cells", image}, {"screen", {{"size", {8, 6}}, {"format", "rgba32f"}}}}},
                     {"passes",
                      {{{"shader", "blur.frag"},
                        {"bind", {{"u_Cells", "cells"}, {"colour", "screen"}}},
                        {"inputs", {{"v_uv", "uv"}}},
                        {"uniforms", {{"u_Texel", {0.125, 0.1666}}}}}}}};
    const std::string blur = "#version 300 es\n"
                             "precision highp float;\n"
                             "uniform sampler2D u_Cells;\n"
                             "uniform vec2 u_Texel;\n"
                             "in vec2 v_uv;\n"
                             "out vec4 colour;\n"
                             "void main() {\n"
                             "    vec4 sum = texture(u_Cells, v_uv);\n"
                             "    sum += texture(u_Cells, v_uv + 0.5 * u_Texel);\n"
                             "    colour = 0.5 * sum + vec4(v_uv, 0.0, 1.0);\n"
                             "}\n";
    const Whole web(drawn, "blur.frag", blur);
    const Outcome said = web.check();
    INFO(said.out << said.err);
    CHECK(said.status == 0);
    CHECK_THAT(line(said, "verdict"), Contains("AGREE") || Contains("LEGAL"));
    std::string slip = blur;
    slip.replace(slip.find("0.5 * u_Texel"), 3, "0.4");
    web.folder.write("blur.frag", slip);
    const Outcome wrong = wrong_at(web, "blur.frag", blur);
    CHECK(wrong.status == 1);
    CHECK_THAT(wrong.out, Contains("blur.frag:9: "));
    CHECK_THAT(refusal(Whole(drawn, "blur.frag", blur + "oops\n").check()), Contains("blur.frag:1"));
    json old = drawn;
    old["passes"][0]["bind"] = {{"u_Cells", "cells"}, {"gl_FragColor", "screen"}};
    const Outcome first = Whole(old, "blur.frag",
                                "precision mediump float;\nvarying vec2 v_uv;\nuniform sampler2D u_Cells;\n"
                                "uniform vec2 u_Texel;\nvoid main() {\n"
                                "    gl_FragColor = texture2D(u_Cells, v_uv + u_Texel);\n}\n")
                              .check();
    INFO(first.out << first.err);
    CHECK(first.status == 0);
    const json buffer{
        {"state", {{"points", {{"count", 40}, {"start", {{"random", {-1, 1}}}}}}}},
        {"passes", {{{"shader", "move.comp"}, {"bind", {{"Points", "points"}}}, {"uniforms", {{"step", 0.25}}}}}}};
    const std::string move = "#version 450\n"
                             "layout(local_size_x = 16) in;\n"
                             "layout(set = 1, binding = 0, std430) buffer Points { vec4 p[]; };\n"
                             "layout(push_constant) uniform Push { float step; } push;\n"
                             "void main() {\n"
                             "    uint i = gl_GlobalInvocationID.x;\n"
                             "    if (i < uint(p.length()))\n"
                             "        p[i].xyz += push.step * p[i].yzx;\n"
                             "}\n";
    json pushed = buffer;
    pushed["passes"][0]["uniforms"] = {{"Push.step", 0.25}};
    const Whole vulkan(pushed, "move.comp", move);
    const Outcome moved = vulkan.check();
    INFO(moved.out << moved.err);
    CHECK(moved.status == 0);
    CHECK_THAT(line(moved, "verdict"), Contains("40 points items"));
    std::string other = move;
    other.replace(other.find("yzx"), 3, "zxy");
    const Outcome differs = wrong_at(vulkan, "move.comp", other);
    CHECK(differs.status == 1);
    CHECK_THAT(differs.out, Contains("move.comp:8: "));
}

TEST_CASE("check file: start values from a table, and states that were recorded") {
    if (!have_software_gl())
        return;
    json document = doubled();
    document["state"]["Data"]["start"] = {{"table", "start.csv"}};
    document["state"]["Data"]["count"] = 3;
    const Made made(document, {{"double.comp", doubling}});
    made.folder.write("start.csv", "x\n0.5\n-2\n0x1p-3\n");
    CHECK_THAT(line(made.check(), "verdict"), Contains("AGREE: every bit of 3 Data items"));
    const std::string recording = (made.folder.path() / "run.h5").string();
    CHECK(run("record", made.file, {"--frames", "3", "-o", recording}).status == 0);
    const Outcome recorded = run_lockstep({"check", made.file, "--trace", recording});
    CHECK(recorded.status == 0);
    CHECK_THAT(recorded.out, Contains("recorded: ") && Contains("AGREE: every bit of 3 Data items in 3 frames"));
    CHECK_THAT(refusal(run_lockstep({"check", "--trace", recording})),
               Contains("expected that file beside --trace: lockstep check FILE.json --trace "));
    // Another reference does not explain them.
    made.folder.write("double.comp",
                      std::string("#version 450 core\n") +
                          "layout(local_size_x = 8) in;\nlayout(std430) buffer Data { float x[]; };\n"
                          "uniform float u_By;\nvoid main() { x[gl_GlobalInvocationID.x] *= u_By + 0.5; }\n");
    CHECK_THAT(line(run_lockstep({"check", made.file, "--trace", recording}), "verdict"), Contains("DIVERGENT"));
    made.folder.write("start.csv", "x\n0.5\n-2\n");
    CHECK_THAT(refusal(made.check()), Contains("/state/Data/start/table: ") && Contains("has 2 rows; expected 3"));
}

TEST_CASE("check file: explain, debug, bench and the page know it") {
    if (!have_software_gl())
        return;
    const Example boids("boids");
    const Outcome explained = run("explain", boids.file(), {"--frame", "1", "--item", "3"});
    CHECK(explained.status == 0);
    CHECK_THAT(explained.out, Contains("run by lockstep: it ends in the GPU's bits") && Contains("boids.comp:43"));
    const Outcome walked =
        run_lockstep({"debug", boids.file(), "--gl", software_gl()}, {.standard_input = "frame 1\nitem 3\nquit\n"});
    CHECK(walked.status == 0);
    CHECK_THAT(walked.out, Contains("frame 1: boids: none differ"));
    const Outcome timed = run("bench", boids.file(), {"--frames", "2"});
    CHECK(timed.status == 0);
    CHECK_THAT(timed.out, Contains("boids") && Contains("AGREE"));
    const Outcome free =
        run("check", boids.file(), {"--frames", "3", "--mode", "free", "--json", boids.beside("r.json")});
    CHECK(free.status == 0);
    CHECK(fs::exists(boids.beside("r.json")));
}

TEST_CASE("check file: an item that is not written in two copies is found, and a guard that is missing") {
    if (!have_software_gl())
        return;
    const Example boids("boids");
    boids.edit("boids.comp", "    after[i].velocity = velocity;",
               "    if (i != 7u)\n        after[i].velocity = velocity;");
    const Outcome said = run("check", boids.file(), {"--frames", "2"});
    CHECK_THAT(refusal(said), Contains("frame 0: boids did not write boids item 7"));
    const Made made({{"state", {{"Data", {{"count", 20}, {"start", 1}}}}}, {"passes", {{{"shader", "double.comp"}}}}},
                    {{"double.comp", "layout(local_size_x = 64) in;\nlayout(std430) buffer Data { float x[]; };\n"
                                     "void main() { x[gl_GlobalInvocationID.x] = 2.0; }\n"}});
    const Outcome outside = made.check();
    CHECK(outside.status != 0);
    CHECK_THAT(outside.out + outside.err, Contains("past the end") || Contains("outside"));
}

TEST_CASE(
    "check file: a group that shares memory is followed by sets, and what it has no value for limits the verdict") {
    if (!have_software_gl())
        return;
    const auto tile = [](const std::string& statements) {
        return std::pair<std::string, std::string>{
            "tile.comp",
            "layout(local_size_x = 16) in;\nlayout(std430) buffer Data { float x[]; };\nshared float t[16];\n"
            "void main() {\n    uint l = gl_LocalInvocationID.x, i = gl_GlobalInvocationID.x;\n" +
                statements + "}\n"};
    };
    const json document{{"state", {{"Data", {{"count", 64}, {"start", {{"random", {0.1, 2}}}}}}}},
                        {"passes", {{{"shader", "tile.comp"}}}}};
    // A power is not rounded as the text's is, and goes on through the memory of the group.
    const std::string powers = "    t[l] = pow(x[i], 0.7);\n    barrier();\n"
                               "    x[i] = t[l] * 0.5 + t[(l + 1u) % 16u] * 0.25 + pow(t[(l + 2u) % 16u], 1.3);\n";
    const Outcome legal = Made(document, {tile(powers)}).check();
    INFO(legal.out << legal.err);
    CHECK(legal.status == 0);
    CHECK_THAT(line(legal, "verdict"), Contains("LEGAL") || Contains("AGREE"));
    CHECK_THAT(line(legal, "verdict"), !Contains("but"));
    const Made slip(document,
                    {tile("    t[l] = pow(x[i], 0.7);\n    barrier();\n"
                          "    x[i] = t[l] * 0.5 + t[(l + 2u) % 16u] * 0.25 + pow(t[(l + 2u) % 16u], 1.3);\n")});
    fs::create_directory(slip.folder.path() / "reference");
    slip.folder.write("reference/tile.comp", "#version 450 core\n" + tile(powers).second);
    const Outcome wrong = slip.check({"--reference", (slip.folder.path() / "reference").string()});
    CHECK(wrong.status == 1);
    CHECK_THAT(line(wrong, "verdict"), Contains("DIVERGENT"));
    const Outcome unset =
        Made(document, {tile("    if (l != 3u)\n        t[l] = x[i];\n    barrier();\n    x[i] = t[15u - l];\n")})
            .check();
    CHECK_THAT(line(unset, "verdict"),
               Contains("but tile.comp:10 has a result that GLSL leaves open: use of a shared variable"));
    CHECK(unset.status == 0);
    const Outcome strict =
        Made(document, {tile("    if (l != 3u)\n        t[l] = x[i];\n    barrier();\n    x[i] = t[15u - l];\n")})
            .check({"--werror-shaders"});
    CHECK(strict.status == 1);
    CHECK_THAT(line(strict, "verdict"), Contains("FAILED: tile.comp:10 has a result that GLSL leaves open"));
}

TEST_CASE("check file: two copies of which some items are not made are refused") {
    if (!have_software_gl())
        return;
    const Example boids("boids");
    json document = json::parse(std::ifstream(boids.file()));
    document["passes"][0]["groups"] = {2};
    std::ofstream(boids.file()) << document.dump();
    CHECK_THAT(refusal(run("check", boids.file(), {"--frames", "2"})),
               Contains("frame 0: boids did not write boids item 128"));
    // A reference of another group size runs as many invocations.
    document["passes"][0]["groups"] = {4};
    std::ofstream(boids.file()) << document.dump();
    CHECK(run("check", boids.file(), {"--frames", "2"}).status == 0);
}

TEST_CASE("check file: uniform blocks without an instance, truths in them, and fields of one name in two buffers") {
    if (!have_software_gl())
        return;
    const json document{{"state",
                         {{"old", {{"count", 8}, {"start", {{"place", {{"index", {1, 2}}}}, {"kind", 3}}}}},
                          {"made", {{"count", 8}, {"start", {{"place", 1}, {"made_kind", 4}}}}}}},
                        {"uniforms", {{"dt", 0.5}, {"Params.scale", {2, 4}}, {"is_on", true}, {"turn", {0, 1, -1, 0}}}},
                        {"passes", {{{"shader", "step.comp"}, {"bind", {{"Old", "old"}, {"Made", "made"}}}}}}};
    const Made made(document,
                    {{"step.comp", "layout(local_size_x = 8) in;\n"
                                   "struct Item { float place; int kind; };\n"
                                   "layout(std430) readonly buffer Old { Item old[]; };\n"
                                   "layout(std430) buffer Made { Item made[]; };\n"
                                   "layout(std140) uniform Params { float dt; vec2 scale; bool is_on; mat2 turn; };\n"
                                   "void main() {\n"
                                   "    uint i = gl_GlobalInvocationID.x;\n"
                                   "    vec2 at = turn * scale;\n"
                                   "    made[i].place += is_on ? old[i].place * dt + at.y : -1.0;\n"
                                   "    made[i].kind += old[i].kind;\n"
                                   "}\n"}});
    const Outcome said = made.check();
    INFO(said.out << said.err);
    CHECK(said.status == 0);
    CHECK_THAT(line(said, "verdict"), Contains("AGREE: every bit of") || Contains("LEGAL"));
    const std::string json_file = (made.folder.path() / "r.json").string();
    CHECK(made.check({"--json", json_file}).status == 0);
    CHECK_THAT(json::parse(std::ifstream(json_file)).dump(), Contains("made_place"));
}

TEST_CASE("check file: 8-bit and half formats are legal where GL rounds as it likes") {
    if (!have_software_gl())
        return;
    const Made made({{"state",
                      {{"codes", {{"size", {16, 16}}, {"format", "rgba8"}, {"start", {{"random", {0, 256}}}}}},
                       {"sums", {{"count", 256}}},
                       {"halves", {{"size", {16, 16}}, {"format", "r16f"}, {"start", 0.1}}}}},
                     {"passes",
                      {{{"shader", "sums.comp"}, {"bind", {{"u_Codes", "codes"}, {"Sums", "sums"}}}},
                       {{"shader", "codes.comp"}, {"bind", {{"u_Codes", "codes"}}}},
                       {{"shader", "halves.comp"}, {"bind", {{"u_Halves", "halves"}}}}}}},
                    {{"sums.comp", "layout(local_size_x = 16) in;\n"
                                   "layout(rgba8) readonly uniform image2D u_Codes;\n"
                                   "layout(std430) buffer Sums { vec4 sums[]; };\n"
                                   "void main() { uint i = gl_GlobalInvocationID.x;\n"
                                   "    sums[i] = imageLoad(u_Codes, ivec2(i % 16u, i / 16u)) + 1.0; }\n"},
                     {"codes.comp", "layout(local_size_x = 8, local_size_y = 8) in;\n"
                                    "layout(rgba8) uniform image2D u_Codes;\n"
                                    "void main() { ivec2 p = ivec2(gl_GlobalInvocationID.xy);\n"
                                    "    vec4 own = imageLoad(u_Codes, p);\n"
                                    "    imageStore(u_Codes, p, own.yxwz * 0.9 + own * 0.05); }\n"},
                     {"halves.comp", "layout(local_size_x = 8, local_size_y = 8) in;\n"
                                     "layout(r16f) uniform image2D u_Halves;\n"
                                     "void main() { ivec2 p = ivec2(gl_GlobalInvocationID.xy);\n"
                                     "    imageStore(u_Halves, p, imageLoad(u_Halves, p) + 0.3); }\n"}});
    const Outcome said = made.check();
    INFO(said.out << said.err);
    CHECK(said.status == 0);
}

TEST_CASE("check file: what it has no meaning for is refused") {
    const Made made(doubled(), {{"double.comp", doubling}});
    CHECK_THAT(refusal(run_lockstep({"check", made.file, "--power-at-least", "50%"})),
               Contains("expected --cover-at-least"));
    CHECK_THAT(
        refusal(run_lockstep({"capsule", "cut", made.file, "--frame", "0", "--item", "1", "-o", made.file + ".c"})),
        Contains("an item of a check file has no capsule"));
    for (const char* option : {"--particles", "--preset"})
        CHECK_THAT(
            refusal(run_lockstep({"check", made.file, option, std::string(option) == "--preset" ? "paper" : "5"})),
            Contains(option));
    CHECK_THAT(refusal(run_lockstep({"check", made.folder.write("empty.json", R"({"state": {}})").string()})),
               Contains("the key \"passes\"") || Contains("/state: has no entry"));
}

TEST_CASE("new check: a file from what shaders declare, which runs at once") {
    if (!have_software_gl())
        return;
    const Example boids("boids"), scan("scan");
    const std::string first = boids.beside("boids/boids.comp"), file = boids.beside("mine.json");
    CHECK_THAT(refusal(run_lockstep({"new", "check", first})),
               EndsWith("boids.json exists; expected a file that does not exist "
                        "yet, by --output FILE"));
    fs::remove(boids.file());
    const Outcome written = run_lockstep({"new", "check", first});
    CHECK(written.status == 0);
    CHECK_THAT(written.out, Contains("lockstep check " + boids.file()));
    const json made = json::parse(std::ifstream(boids.file()));
    CHECK(made["passes"][0]["bind"] == json{{"BoidsIn", "boids"}, {"BoidsOut", "boids"}});
    CHECK(made["state"]["boids"]["count"] == 256);
    CHECK(made["todo"].size() == 6);
    const Outcome said = run("check", boids.file(), {"--frames", "2"});
    CHECK(said.status == 0);
    CHECK_THAT(said.out,
               Contains("the same that the GPU runs: this says what the driver does, not whether the shader is right"));
    fs::remove(scan.file());
    CHECK(run_lockstep({"new", "check", scan.beside("scan/scan.comp"), scan.beside("scan/add.comp")}).status == 0);
    CHECK(run("check", scan.file(), {"--frames", "2"}).status == 0);
    CHECK_THAT(refusal(run_lockstep({"new", "check", scan.beside("scan/none.comp")})), Contains("there is no file"));
    CHECK_THAT(refusal(run_lockstep({"new", "check", scan.beside("scan/other.frag")})), Contains("there is no file"));
    CHECK_THAT(refusal(run_lockstep({"new", "check", scan.beside("scan/scan.comp"), first, "-o", file})),
               Contains("lies in another folder than the first shader"));
}

TEST_CASE("check file: what does not fit is refused with its place, and nothing is written") {
    if (!have_software_gl())
        return;
    struct Slip {
        std::string path; ///< JSON pointer; of a key that is not there: it is added
        json value;       ///< null: the key goes
        std::string said;
    };
    const std::vector<Slip> slips{
        {"/state", {}, "the key \"state\" is missing"},
        {"/passes", json::array(), "/passes: 0 passes; expected 1 to 255"},
        {"/frame", 3, "unknown key \"frame\""},
        {"/shaders", "none", "/shaders: "},
        {"/reference", "none", "is no folder; expected one beside the file"},
        {"/state/Data/count", 0, "/state/Data/count: 0 is not"},
        {"/state/Data/count", 1e30, "/state/Data/count: "},
        {"/state/Data/count", "20", "/state/Data/count: "},
        {"/state/Data/size",
         {4, 4},
         "/state/Data: has count and size; expected count for a buffer, or size for an image"},
        {"/state/Data/format", "r32f", "/state/Data/format: is of an image"},
        {"/state/Data/start",
         {{"speed", 1}},
         "/state/Data/start/speed: its shaders declare no field speed; they have x"},
        {"/state/Data/start", {1, 2}, "/state/Data/start: "},
        {"/state/Data/start", {{"values", {1, 2}}}, "/state/Data/start/values: 2 values; expected 20, one an item"},
        {"/state/Data/start", {{"random", {1}}}, "/state/Data/start/random: 1 numbers; expected 2"},
        {"/state/other",
         {{"count", 4}},
         "/state/other: no pass has it; expected a block, sampler or image of this name"},
        {"/state/other", {{"size", {99999, 99999}}, {"format", "r32f"}}, "/state/other/size/0: 99999 is not"},
        {"/passes/0/shader", "none.comp", "none.comp"},
        {"/passes/0/shader", "double.frag", "double.frag"},
        {"/passes/0/shader", "../double.comp", "/passes/0/shader: names a folder"},
        {"/passes/0/bind", {{"Data", "date"}}, "/passes/0/bind/Data: 'date' is no entry of the state; there are Data"},
        {"/passes/0/bind", {{"Dato", "Data"}}, "/passes/0/bind/Dato: "},
        {"/passes/0/groups", {1, 2, 3, 4}, "/passes/0/groups: 4 numbers; expected 1 to 3"},
        {"/passes/0/groups", 4, "/passes/0/groups: "},
        {"/passes/0/groups", {0}, "/passes/0/groups/0: 0 is not"},
        {"/passes/0/groups",
         {65535, 65535, 65535},
         "/passes/0/groups: 281462092005375 groups; expected at most 100000000"},
        {"/reference", "", "is no folder; expected one beside the file"},
        {"/passes/0/uniforms/u_By", {1, 2}, "/passes/0/uniforms/u_By: "},
        {"/passes/0/uniforms/u_By", true, "/passes/0/uniforms/u_By: "},
        {"/passes/0/uniforms/u_By", {{"frames", json::array()}}, "/passes/0/uniforms/u_By/frames: has no value"},
        {"/passes/0/uniforms/u_Bx", 1, "/passes/0/uniforms/u_Bx: "},
        {"/passes/0/uniforms", {}, "nothing is given for uniform u_By; \"uniforms\" of the check file gives it"},
    };
    for (const Slip& slip : slips) {
        json document = doubled();
        const json::json_pointer place(slip.path);
        if (slip.value.is_null())
            document[place.parent_pointer()].erase(place.back());
        else
            document[place] = slip.value;
        const Made made(document, {{"double.comp", doubling}});
        INFO(slip.path << " " << slip.value);
        const std::string page = (made.folder.path() / "page").string();
        CHECK_THAT(refusal(made.check({"--report", page})), Contains(slip.said));
        CHECK(!fs::exists(page));
    }
}

TEST_CASE("check file: two layouts of one buffer, and blocks that are no one array, are refused") {
    if (!have_software_gl())
        return;
    json document = doubled();
    document["passes"].push_back({{"shader", "other.comp"}});
    const Made layouts(document,
                       {{"double.comp", doubling},
                        {"other.comp", "layout(local_size_x = 8) in;\nlayout(std140) buffer Data { float x[]; };\n"
                                       "void main() { x[gl_GlobalInvocationID.x] = 1.0; }\n"}});
    CHECK_THAT(refusal(layouts.check()),
               Contains("/state/Data: Data of ") && Contains("declare other records; expected one layout"));
    const Made head(
        doubled(), {{"double.comp", "layout(local_size_x = 8) in;\nlayout(std430) buffer Data { uint n; float x[]; };\n"
                                    "uniform float u_By;\nvoid main() { x[n] = u_By; }\n"}});
    CHECK_THAT(refusal(head.check()), Contains("has members beside an array without a size; expected the array alone"));
}

} // namespace lockstep::test::check_file_test
