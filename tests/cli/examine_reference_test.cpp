#include <array>
#include <fstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/cli/run_program.hpp"

namespace lockstep::test::examine_reference_test {

using Catch::Contains;

namespace {

/// Two texts, both named shader.comp, or otherwise by their stage.
class TwoTexts {
  public:
    explicit TwoTexts(std::string name = "shader.comp") : name_(std::move(name)) {
        for (const char* const side : {"today", "yesterday"})
            std::filesystem::create_directory(folder_.path() / side);
    }
    Outcome compared(const std::string& today, const std::string& yesterday,
                     const std::vector<std::string>& options = {}) {
        return run_lockstep(joined({"examine", folder_.write("today/" + name_, today).string(), "--reference",
                                    folder_.write("yesterday/" + name_, yesterday).string()},
                                   options));
    }
    [[nodiscard]] std::string path(const std::string& file) const { return (folder_.path() / file).string(); }

  private:
    TemporaryFolder folder_;
    std::string name_;
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), by);
}

const std::string step = "#version 430 core\n"
                         "layout(local_size_x = 16) in;\n"
                         "struct Ball { vec3 place; float mass; vec3 velocity; };\n"
                         "layout(std430, binding = 0) buffer Balls { Ball balls[]; };\n"
                         "uniform float u_Tick;\n"
                         "void main() {\n"
                         "    uint i = gl_GlobalInvocationID.x;\n"
                         "    if (i >= 60u)\n"
                         "        return;\n"
                         "    vec3 v = balls[i].velocity;\n"
                         "    v.y -= 9.8 * u_Tick;\n"
                         "    if (balls[i].place.y < 0.5)\n"
                         "        v.y = -v.y;\n"
                         "    balls[i].velocity = v;\n"
                         "    balls[i].place = balls[i].place + v * u_Tick;\n"
                         "}\n";
const std::vector<std::string> tick{"--uniform", "u_Tick=0.1"};

} // namespace

TEST_CASE("examine --reference: a text that leaves the same words agrees, however it is written") {
    TwoTexts texts;
    const Outcome same = texts.compared(
        replaced(replaced(step, "binding = 0) buffer Balls", "binding = 0) buffer Ball_s"),
                 "if (i >= 60u)\n        return;", "const bool is_none = i > 59u;\n    if (is_none) return;"),
        step, tick);
    INFO(same.out << same.err);
    CHECK(same.status == 0);
    CHECK(same.out == "shader.comp: no findings in 4 groups of 16 invocations\n"
                      "coverage  shader.comp: all 9 lines and 4 branch sides in 4 groups of 16 invocations\n"
                      "verdict   AGREE: all 512 words are those of " +
                          texts.path("yesterday/shader.comp") + "; 360 are written\n");
}

TEST_CASE("examine --reference: a verdict beside findings says that it is no pass") {
    TwoTexts texts;
    const std::string unset =
        replaced(step, "void main() {", "void main() {\n    vec4 kept;\n    if (kept.x > 1e30) return;");
    const Outcome agrees = texts.compared(unset, step, tick);
    INFO(agrees.out << agrees.err);
    CHECK(agrees.status == 1);
    CHECK_THAT(agrees.out, Contains("shader.comp: 1 finding in ") && Contains(", but 1 finding above: no pass: "));
}

TEST_CASE("examine --reference: what differs is DIVERGENT, with word, invocation and the line without a counterpart") {
    struct Slip {
        std::string what, by, word, line;
    };
    TwoTexts texts;
    for (const Slip& slip :
         {Slip{"9.8", "8.9", "Balls.balls[0].place.y: expected ", "shader.comp:11: v.y -= 8.9 * u_Tick;: makes "},
          Slip{"    if (i >= 60u)\n        return;\n", "\n\n", "Balls.balls[60].place.x: expected ",
               "shader.comp:8 of the reference: if (i >= 60u): compares 6"},
          Slip{"    v.y -= 9.8 * u_Tick;\n", "\n", "Balls.balls[0].place.y: expected ",
               "shader.comp:11 of the reference: v.y -= 9.8 * u_Tick;: makes "},
          Slip{"balls[i].place.y < 0.5", "balls[i].mass < 0.5", ".place.y: expected ",
               "shader.comp:12: if (balls[i].mass < 0.5)"},
          Slip{"balls[i].place + v", "v + balls[i].velocity", "Balls.balls[0].place.x: expected ",
               "shader.comp:15: "}}) {
        const Outcome differs = texts.compared(replaced(step, slip.what, slip.by), step, tick);
        INFO(slip.by << '\n' << differs.out << differs.err);
        CHECK(differs.status == 1);
        CHECK_THAT(differs.out, Contains("verdict   DIVERGENT: ") && Contains(" words differ from ") &&
                                    Contains("differs   shader.comp:1") && Contains(", invocation ") &&
                                    Contains(slip.word) &&
                                    Contains("note      without a counterpart in the reference: " + slip.line));
    }
}

TEST_CASE("examine --reference: what the reference's text leaves open is LEGAL, and with precise it is not") {
    TwoTexts texts;
    const std::string sum = "#version 430 core\nlayout(local_size_x = 64) in;\n"
                            "buffer Numbers { float x[]; };\nuniform vec3 u_By;\n"
                            "void main() {\n    uint i = gl_GlobalInvocationID.x;\n"
                            "    float s = x[i] - u_By.x - u_By.y + u_By.z;\n    x[i] = s;\n}\n",
                      other = replaced(sum, "x[i] - u_By.x - u_By.y + u_By.z", "(x[i] + u_By.z) - (u_By.y + u_By.x)");
    const std::vector<std::string> by{"--uniform", "u_By=0.1,7.7,-0.3"};
    const Outcome legal = texts.compared(other, sum, by);
    INFO(legal.out << legal.err);
    CHECK(legal.status == 0);
    CHECK_THAT(legal.out, Contains("verdict   LEGAL: ") && Contains(", as its text allows\n"));
    const Outcome precise = texts.compared(other, replaced(sum, "float s", "precise float s"), by);
    INFO(precise.out);
    CHECK(precise.status == 1);
    CHECK_THAT(precise.out, Contains("verdict   DIVERGENT: ") && Contains(": 0 as its text allows, "));
}

TEST_CASE("examine --reference: texels of images differ by their place") {
    TwoTexts texts;
    const std::string blur = "#version 430 core\nlayout(local_size_x = 8, local_size_y = 8) in;\n"
                             "layout(rgba32f, binding = 0) readonly uniform image2D u_Source;\n"
                             "layout(rgba32f, binding = 1) writeonly uniform image2D u_Target;\n"
                             "void main() {\n    ivec2 at = ivec2(gl_GlobalInvocationID.xy);\n"
                             "    vec4 sum = vec4(0.0);\n    for (int dx = -1; dx <= 1; ++dx)\n"
                             "        sum += imageLoad(u_Source, at + ivec2(dx, 0));\n"
                             "    imageStore(u_Target, at, sum / 3.0);\n}\n";
    const Outcome differs = texts.compared(replaced(blur, "sum / 3.0", "sum / 2.0"), blur, {"--groups", "2,2"});
    INFO(differs.out << differs.err);
    CHECK(differs.status == 1);
    CHECK_THAT(differs.out, Contains("verdict   DIVERGENT: ") &&
                                Contains("differs   shader.comp:10, invocation 0: "
                                         "u_Target(0, 0).x: expected ") &&
                                Contains("without a counterpart in the reference: shader.comp:10: "));
    CHECK(texts.compared(blur, blur, {"--groups", "2,2"}).status == 0);
}

TEST_CASE("examine --reference: what groups share is held to the reference's bits") {
    TwoTexts texts;
    const std::string count =
        "#version 430 core\nlayout(local_size_x = 32) in;\n"
        "layout(std430) buffer Numbers { uint x[]; };\nlayout(std430) buffer Counts { uint many; uint all; };\n"
        "shared uint own;\nvoid main() {\n    if (gl_LocalInvocationIndex == 0u)\n        own = 0u;\n"
        "    barrier();\n    if (x[gl_GlobalInvocationID.x] > 49u)\n        atomicAdd(own, 1u);\n"
        "    barrier();\n    if (gl_LocalInvocationIndex == 0u)\n        atomicAdd(many, own);\n"
        "    atomicAdd(all, 1u);\n}\n";
    const std::vector<std::string> integers{"--integers", "100"};
    const Outcome differs = texts.compared(replaced(count, "> 49u", "> 59u"), count, integers);
    INFO(differs.out << differs.err);
    CHECK(differs.status == 1);
    CHECK_THAT(differs.out, Contains("verdict   DIVERGENT: 1 of 130 words differ from ") &&
                                Contains("differs   Counts.many: expected "));
    const Outcome alike = texts.compared(count, count, integers);
    CHECK(alike.status == 0);
    CHECK_THAT(alike.out, Contains("2 are written\n") && !Contains("note"));
    // Where all are 0 the slip cannot show, and the report says so.
    CHECK_THAT(texts.compared(replaced(count, "> 49u", "> 59u"), count).out,
               Contains("verdict   AGREE") &&
                   Contains("note      integers of arrays and images are 0; --integers 100 makes up others\n"));
    const std::string sums = "#version 430 core\nlayout(local_size_x = 32) in;\nbuffer Numbers { float x[]; };\n"
                             "shared float s[32];\nvoid main() {\n    uint i = gl_LocalInvocationIndex;\n"
                             "    s[i] = x[gl_GlobalInvocationID.x];\n    barrier();\n"
                             "    x[gl_GlobalInvocationID.x] = s[i] + s[31u - i];\n}\n";
    const Outcome wrong = texts.compared(replaced(sums, "31u - i", "30u - min(i, 30u)"), sums);
    INFO(wrong.out << wrong.err);
    CHECK(wrong.status == 1);
    CHECK_THAT(wrong.out, Contains("verdict   DIVERGENT: ") && !Contains("held to the reference's bits"));
    // What lies behind a barrier is any of its legal words: here products that may be fused with the sum.
    const std::string products = replaced(sums, "= x[gl_GlobalInvocationID.x];", "= x[gl_GlobalInvocationID.x] * 1.1;");
    const Outcome fused = texts.compared(replaced(products, "s[i] + s[31u - i]", "s[31u - i] + s[i]"), products);
    CHECK(fused.status == 0);
    const std::string order = replaced(sums, "    barrier();\n",
                                       "    barrier();\n    if (atomicAdd(n, 1u) > 90u)\n"
                                       "        s[i] *= 3.0;\n    barrier();\n");
    const std::string counted = replaced(order, "shared float", "buffer Counts { uint n; };\nshared float");
    const Outcome bits = texts.compared(replaced(counted, "s[i] + s[31u - i]", "s[i] + s[30u - min(i, 30u)]"), counted);
    INFO(bits.out << bits.err);
    CHECK(bits.status == 1);
    CHECK_THAT(bits.out, Contains("note      ") && Contains(" words are held to the reference's bits: shader "));
}

TEST_CASE("examine --reference: the line without a counterpart is found where the invocations of a group share") {
    TwoTexts texts;
    const std::string scan = "#version 430 core\n"
                             "layout(local_size_x = 32) in;\n"
                             "layout(std430) buffer Numbers { float x[]; };\n"
                             "layout(std430) buffer Counts { uint many; };\n"
                             "shared float part[32];\n"
                             "void main() {\n"
                             "    uint i = gl_LocalInvocationIndex;\n"
                             "    part[i] = x[gl_GlobalInvocationID.x];\n"
                             "    for (uint d = 1u; d < 32u; d <<= 1u) {\n"
                             "        barrier();\n"
                             "        float left = i >= d ? part[i - d] : 0.0;\n"
                             "        barrier();\n"
                             "        part[i] += left;\n"
                             "    }\n"
                             "    if (part[i] > 4.0)\n"
                             "        atomicAdd(many, 1u);\n"
                             "    x[gl_GlobalInvocationID.x] = part[i] * 0.5;\n"
                             "}\n";
    struct Slip {
        std::string what, by, line;
    };
    for (const Slip& slip : {Slip{"part[i] += left;", "part[i] -= left;", "shader.comp:13: part[i] -= left;"},
                             Slip{"part[i] = x[gl", "part[i] = 2.0 * x[gl", "shader.comp:8: part[i] = 2.0 * x["},
                             Slip{"part[i] * 0.5", "part[i] * 0.25", "shader.comp:17: "},
                             Slip{"many, 1u", "many, 2u", "shader.comp:16: atomicAdd(many, 2u);"}}) {
        const Outcome differs = texts.compared(replaced(scan, slip.what, slip.by), scan);
        INFO(slip.by << '\n' << differs.out << differs.err);
        CHECK(differs.status == 1);
        CHECK_THAT(differs.out, Contains("note      without a counterpart in the reference: " + slip.line));
    }
    CHECK(texts.compared(scan, scan).status == 0);
}

TEST_CASE("examine --reference: findings of the reference are named as its own, and make no status of 0") {
    TwoTexts texts;
    const std::string right = "#version 430 core\nlayout(local_size_x = 32) in;\nbuffer Numbers { float x[]; };\n"
                              "uniform float u_By;\nvoid main() {\n"
                              "    x[gl_GlobalInvocationID.x] = pow(abs(u_By), 2.0);\n}\n",
                      wrong = replaced(right, "abs(u_By)", "u_By"),
                      race = replaced(right, "x[gl_GlobalInvocationID.x]", "x[gl_GlobalInvocationID.x / 2u]");
    const Outcome found = texts.compared(right, wrong, {"--uniform", "u_By=-2"});
    INFO(found.out << found.err);
    CHECK(found.status == 1);
    CHECK_THAT(found.out, Contains("shader.comp: no findings in ") &&
                              Contains("in the reference: shader.comp:6: pow of a negative base"));
    const Outcome races = texts.compared(race, right, {"--uniform", "u_By=2"});
    CHECK(races.status == 1);
    CHECK_THAT(races.out, Contains("shader.comp:6: race on a buffer") && !Contains("\nin the reference:"));
}

TEST_CASE("examine --reference: interfaces that differ are one line, with file and what is expected") {
    TwoTexts texts;
    const std::string text = "#version 430 core\nlayout(local_size_x = 16) in;\n"
                             "layout(std430) buffer Numbers { float x[]; };\nlayout(r32f) uniform image2D u_Image;\n"
                             "uniform float u_By;\n#define MORE\nvoid main() {\n    uint i = gl_GlobalInvocationID.x;\n"
                             "    x[i] = imageLoad(u_Image, ivec2(i, 0)).x * u_By MORE;\n}\n";
    struct Change {
        std::string what, by, message;
    };
    for (const Change& one :
         {Change{"local_size_x = 16", "local_size_x = 32",
                 "today/shader.comp: local_size 32, 1, 1; expected local_size 16, 1, 1, as "},
          Change{"buffer Numbers", "buffer More { float m[]; };\nlayout(std430) buffer Numbers",
                 "yesterday/shader.comp: no storage block More; expected one of this name, as "},
          Change{
              "{ float x[]; }", "{ float first; float x[]; }",
              "today/shader.comp: storage block Numbers: an array without a length of 4 bytes an element, from byte 4; "
              "expected an array without a length of 4 bytes an element, from byte 0, as "},
          Change{"float x[]; };\n",
                 "int x[]; };\n#define imageLoad(a, b) ivec4(imageLoad(a, b))\n#define u_By int(u_By)\n",
                 "today/shader.comp: storage block Numbers, an element: number 0 is the integer of word 0; expected "
                 "the float"},
          Change{"layout(r32f)", "layout(rgba32f)",
                 "today/shader.comp: image u_Image of another type; expected the same"},
          Change{"uniform float u_By", "uniform int u_By",
                 "today/shader.comp: uniform u_By of 1 integer; expected 1 float, as "},
          Change{"#define MORE\n", "uniform float u_More;\n#define MORE * u_More\n",
                 "today/shader.comp: uniform u_More is in this text alone; expected its value"}}) {
        const std::string changed = one.what.starts_with("float x[]; };")
                                        ? "#version 430 core\nlayout(local_size_x = 16) in;\n"
                                          "layout(std430) buffer Numbers { int x[]; };\n"
                                          "layout(r32f) uniform image2D u_Image;\nuniform float u_By;\nvoid main() {\n"
                                          "    uint i = gl_GlobalInvocationID.x;\n    x[i] = int(u_By);\n}\n"
                                        : replaced(text, one.what, one.by);
        CHECK_THAT(refusal(texts.compared(changed, text)), Contains(one.message));
    }
    CHECK(texts
              .compared(replaced(text, "#define MORE\n", "uniform float u_More;\n#define MORE * u_More\n"), text,
                        {"--uniform", "u_More=1", "--uniform", "u_By=2"})
              .status == 0);
    CHECK_THAT(refusal(texts.compared(text, replaced(text, "layout(r32f) uniform",
                                                     "layout(r32f) uniform image2D u_Other;\nlayout(r32f) uniform"))),
               Contains("today/shader.comp: no image u_Other; expected one of this name, as "));
    const std::string nothing = replaced(text, "    x[i] =", "    if (u_By > 1.0)\n        x[i] =");
    CHECK_THAT(refusal(texts.compared(nothing, nothing)), Contains("writes anything with these inputs"));
    CHECK_THAT(
        refusal(run_lockstep({"examine", texts.path("today/shader.comp"), "--reference", texts.path("none.comp")})),
        Contains("none.comp: no such file"));
}

TEST_CASE("examine --reference: vertices, fragments and vertices that are emitted are compared by their outputs") {
    TwoTexts vertices("stage.vert");
    const std::string place =
        "#version 430 core\nin vec3 a_Place;\nin float a_Size;\nout vec2 v_Shade;\nvoid main() {\n"
        "    v_Shade = a_Place.xy * 2.0 - 1.0;\n    gl_Position = vec4(a_Place * a_Size, 1.0);\n}\n";
    CHECK(vertices.compared(place, place).status == 0);
    const Outcome moved = vertices.compared(replaced(place, "a_Place.xy", "a_Place.yx"), place);
    INFO(moved.out << moved.err);
    CHECK(moved.status == 1);
    CHECK_THAT(moved.out, Contains("differs   stage.vert:6, invocation 0: v_Shade.x: expected ") &&
                              Contains("without a counterpart in the reference: stage.vert:6: "));
    CHECK_THAT(refusal(vertices.compared(replaced(place, "in float a_Size;\n", "const float a_Size = 1.0;\n"), place)),
               Contains("today/stage.vert: no input a_Size; expected one of this name, as "));

    TwoTexts fragments("stage.frag");
    const std::string shade = "#version 430 core\nin vec3 v_Normal;\nout vec4 o_Colour;\nvoid main() {\n"
                              "    if (v_Normal.z < 0.5)\n        discard;\n"
                              "    o_Colour = vec4(v_Normal * 0.5, 1.0);\n}\n";
    const Outcome kept = fragments.compared(replaced(shade, "discard;", ";"), shade);
    INFO(kept.out << kept.err);
    CHECK(kept.status == 1);
    CHECK_THAT(kept.out, Contains("verdict   DIVERGENT: ") && Contains("o_Colour.x: expected 0 "));
    CHECK(fragments.compared(shade, shade).status == 0);

    TwoTexts strips("stage.geom");
    const std::string strip =
        "#version 430 core\nlayout(points) in;\nlayout(line_strip, max_vertices = 3) out;\n"
        "void main() {\n    for (int i = 0; i < 2; ++i) {\n"
        "        gl_Position = gl_in[0].gl_Position + vec4(float(i));\n        EmitVertex();\n    }\n}\n";
    CHECK(strips.compared(strip, strip).status == 0);
    CHECK_THAT(strips.compared(replaced(strip, "i < 2", "i < 3"), strip).out,
               Contains("verdict   DIVERGENT: other vertices than those of ") &&
                   Contains("differs   192 vertices in 64 strips are emitted; expected 128 in 64\n"));
    CHECK_THAT(strips.compared(replaced(strip, "+ vec4", "- vec4"), strip).out,
               Contains("verdict   DIVERGENT: ") && Contains("a geometry stage is not followed by sets"));
}

TEST_CASE("examine --reference: the JSON file has what the report says") {
    TwoTexts texts;
    const std::string json = texts.path("found.json");
    REQUIRE(texts.compared(replaced(step, "9.8", "8.9"), step, joined(tick, {"--json", json})).status == 1);
    const nlohmann::json found = nlohmann::json::parse(std::ifstream(json))["reference"];
    CHECK(found["verdict"] == "DIVERGENT");
    CHECK(found["words"] == 512);
    CHECK(found["differing"].get<int>() > 0);
    CHECK(found["legal"] == 0);
    CHECK(found["first"].size() == 3);
    CHECK(found["findings"].empty());
    CHECK(found["without_counterpart"][0]["where"] == "shader.comp:11");
}

TEST_CASE("examine --reference: a text of groups is held against a plain one, from an invocation's start to its end") {
    TwoTexts texts;
    const std::string plain = "#version 430 core\n"
                              "layout(local_size_x = 32) in;\n"
                              "layout(std430) buffer Numbers { float x[128]; };\n"
                              "layout(std430) buffer Sums { float made[128]; };\n"
                              "void main() {\n"
                              "    uint i = gl_GlobalInvocationID.x;\n"
                              "    float sum = 0.0;\n"
                              "    for (uint j = 0u; j < 128u; ++j)\n"
                              "        sum += x[j] * 0.5;\n"
                              "    made[i] = sum * x[i];\n"
                              "}\n";
    const std::string tiled = "#version 430 core\n"
                              "layout(local_size_x = 32) in;\n"
                              "layout(std430) buffer Numbers { float x[128]; };\n"
                              "layout(std430) buffer Sums { float made[128]; };\n"
                              "shared float tile[32];\n"
                              "void main() {\n"
                              "    uint i = gl_GlobalInvocationID.x;\n"
                              "    uint k = gl_LocalInvocationIndex;\n"
                              "    float sum = 0.0;\n"
                              "    for (uint t = 0u; t < 128u; t += 32u) {\n"
                              "        tile[k] = x[t + k];\n"
                              "        barrier();\n"
                              "        for (uint j = 0u; j < 32u; ++j)\n"
                              "            sum += tile[j] * 0.5;\n"
                              "        barrier();\n"
                              "    }\n"
                              "    made[i] = sum * x[i];\n"
                              "}\n";
    const Outcome right = texts.compared(tiled, plain, {"--groups", "4"});
    INFO(right.out << right.err);
    CHECK(right.status == 0);
    CHECK_THAT(right.out, Contains("verdict   AGREE"));
    for (const auto& [what, by, line] :
         {std::array<std::string, 3>{"made[i] = sum * x[i]", "made[i] = sum + x[i]",
                                     "shader.comp:17: made[i] = sum + x[i];"},
          {"tile[j] * 0.5", "tile[j] * 0.25", "shader.comp:14: sum += tile[j] * 0.25;"}}) {
        const Outcome wrong = texts.compared(replaced(tiled, what, by), plain, {"--groups", "4"});
        INFO(by << '\n' << wrong.out << wrong.err);
        CHECK(wrong.status == 1);
        CHECK_THAT(wrong.out, Contains("note      without a counterpart in the reference: " + line));
    }
}

TEST_CASE("examine --reference: a store or an atomic operation that is missing is the reference's line") {
    TwoTexts texts;
    const std::string both = "#version 430 core\n"
                             "layout(local_size_x = 32) in;\n"
                             "layout(std430, binding = 0) buffer Numbers { float x[64]; };\n"
                             "layout(std430, binding = 1) buffer Counts { uint many; };\n"
                             "void main() {\n"
                             "    uint i = gl_GlobalInvocationID.x;\n"
                             "    float a = x[i] * 1.5;\n"
                             "    atomicAdd(many, 1u);\n"
                             "    x[i] = a;\n"
                             "}\n";
    for (const auto& [what, line] :
         {std::array<std::string, 2>{"    atomicAdd(many, 1u);",
                                     "shader.comp:8 of the reference: atomicAdd(many, 1u);: writes 1"},
          {"    x[i] = a;", "shader.comp:9 of the reference: x[i] = a;: writes "}}) {
        const Outcome wrong = texts.compared(replaced(both, what, ""), both, {"--groups", "2"});
        INFO(what << '\n' << wrong.out << wrong.err);
        CHECK(wrong.status == 1);
        CHECK_THAT(wrong.out, Contains("note      without a counterpart in the reference: " + line));
    }
}

} // namespace lockstep::test::examine_reference_test
