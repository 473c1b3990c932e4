#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "reference/text/coverage.hpp"
#include "tests/text/text_kernel.hpp"
#include "tests/text/text_stage.hpp"

namespace lockstep::test::coverage_test {

namespace {

/// The lines of a text, its first being 1, that were not reached, and what was not taken, as "LINE what".
std::vector<std::string> gaps(const text::Program& program, const text::Coverage& coverage) {
    std::vector<std::string> all;
    for (const auto& [line, is_reached] : text::covered_lines(program, coverage))
        if (!is_reached)
            all.push_back(std::to_string(line) + " line");
    for (const text::Decision& decision : program.decisions)
        for (const text::DecisionSide& side : text::sides_of(program, decision, coverage))
            if (!side.is_taken)
                all.push_back(std::to_string(decision.line) + " " + side.never);
    return all;
}

/// Those of a kernel of 32 invocations, whose x[i] is i, with this from line 7 on.
std::vector<std::string> gaps_of(const std::string& statements, std::uint32_t mode = 0, bool is_watched = false) {
    TextKernel kernel("#version 450 core\n"
                      "layout(local_size_x = 32) in;\n"
                      "layout(std430, binding = 0) buffer Out { float x[]; };\n"
                      "uniform int u_Mode; shared float parts[32];\n"
                      "void main() {\n"
                      "    uint i = gl_GlobalInvocationID.x; float v = x[i];\n" +
                      statements + "\n    x[i] = v;\n}\n");
    std::vector<float> floats(32);
    for (std::size_t i = 0; i < floats.size(); ++i)
        floats[i] = static_cast<float>(i);
    kernel.blocks["Out"] = words_of(floats);
    kernel.uniforms["u_Mode"] = {mode};
    kernel.is_watched = is_watched;
    text::Coverage coverage(kernel.program);
    kernel.coverage = &coverage;
    kernel.run();
    return gaps(kernel.program, coverage);
}

using Gaps = std::vector<std::string>;

} // namespace

TEST_CASE("coverage: both sides of a branch, whichever lanes take them, are no gap") {
    for (const bool is_watched : {false, true}) {
        CHECK(gaps_of("if (v > 20.0)\n v = 1.0;\nelse\n v = 2.0;", 0, is_watched).empty());
        CHECK(gaps_of("if (v >= 0.0)\n v = 1.0;\nelse\n v = 2.0;", 0, is_watched) ==
              Gaps{"10 line", "7 was never false"});
        CHECK(gaps_of("if (v < 0.0)\n v = 1.0;", 0, is_watched) == Gaps{"8 line", "7 was never true"});
    }
}

TEST_CASE("coverage: a return, a break and a continue are lines, and what merges behind a branch is none") {
    CHECK(gaps_of("for (int k = 0; k < 3; ++k) {\n"
                  "    if (v < 0.0)\n"
                  "        continue;\n"
                  "    if (v < 0.0) {\n"
                  "        v = 1.0;\n"
                  "        break;\n"
                  "    }\n"
                  "}\n"
                  "if (v < 0.0)\n"
                  "    return;\n") == Gaps{"9 line", "11 line", "12 line", "16 line", "8 was never true",
                                           "10 was never true", "15 was never true"});
}

TEST_CASE("coverage: loops that never turn, and that never end by their condition") {
    const std::string counted = "for (int k = 0; k < u_Mode; ++k)\n v += 1.0;";
    CHECK(gaps_of(counted) == Gaps{"8 line", "7 loop never turned"});
    CHECK(gaps_of(counted, 2).empty());
    CHECK(gaps_of("while (u_Mode == 0) {\n v += 1.0;\n if (v > 3.0)\n break;\n}") ==
          Gaps{"7 loop never ended by its condition"});
    CHECK(gaps_of("do {\n v += 1.0;\n} while (v < 0.0);") == Gaps{"9 loop never turned again"});
    CHECK(gaps_of("do {\n v += 1.0;\n if (v > 0.0)\n break;\n} while (v < 0.0);") ==
          Gaps{"11 line", "9 was never false", "11 loop never turned again", "11 loop never ended by its condition"});
    CHECK(gaps_of("while (true) {\n v += 1.0;\n if (v > 3.0)\n break;\n}").empty());
}

TEST_CASE("coverage: each case of a switch is a side, and so is the way past all of them") {
    const std::string cases = "switch (u_Mode) {\n"
                              "case 0:\n"
                              "    v = 1.0;\n"
                              "    break;\n"
                              "case -1:\n"
                              "case 2:\n"
                              "    v = 2.0;\n";
    CHECK(gaps_of(cases + "}", 2) == Gaps{"9 line", "10 line", "7 case 0 was never taken", "7 case -1 was never taken",
                                          "7 one of the cases was always taken"});
    CHECK(gaps_of(cases + "default:\n    v = 3.0;\n}", 2) == Gaps{"9 line", "10 line", "7 case 0 was never taken",
                                                                  "7 case -1 was never taken",
                                                                  "7 default was never taken"});
    CHECK(gaps_of(cases + "    break;\ndefault:\n    v = 3.0;\n}", 7) ==
          Gaps{"9 line", "10 line", "13 line", "14 line", "7 case 0 was never taken", "7 case -1 was never taken",
               "7 case 2 was never taken"});
}

TEST_CASE("coverage: the left sides of && and || where the right one is left out") {
    CHECK(gaps_of("if (v < 9.0 && x[i] > 5.0)\n v = 1.0;").empty());
    CHECK(gaps_of("if (v >= 0.0 && x[i] > 5.0)\n v = 1.0;") == Gaps{"7 left side of && was never false"});
    CHECK(gaps_of("if (v < 0.0 || x[i] > 5.0)\n v = 1.0;") == Gaps{"7 left side of || was never true"});
    CHECK(gaps_of("if (!(v < 0.0) && x[i] > 5.0)\n v = 1.0;") == Gaps{"7 left side of && was never false"});
    CHECK(gaps_of("v = v < 0.0 ? sqrt(x[i]) : 1.0;") == Gaps{"7 was never true"});
}

TEST_CASE("coverage: what constants decide is no decision, but its lines count") {
    CHECK(gaps_of("const int kind = 2;\nif (kind == 2)\n v = 1.0;\nelse\n v = 2.0;") == Gaps{"11 line"});
}

TEST_CASE("coverage: barriers part no lines, and functions count where they stand") {
    // Nobody goes on behind a barrier that not all come to.
    CHECK(gaps_of("if (i < 16u) {\n    barrier();\n    v = 2.0;\n}", 0, true) == Gaps{"9 line"});
    CHECK(gaps_of("parts[i] = v;\nbarrier();\nv = parts[31u - i];\nbarrier();\nif (v > 50.0)\n v = 0.0;") ==
          Gaps{"12 line", "11 was never true"});
    TextKernel kernel("#version 450 core\n"
                      "layout(local_size_x = 4) in;\n"
                      "layout(std430, binding = 0) buffer Out { float x[]; };\n"
                      "float of_one_block(float a) {\n"
                      "    return a * 2.0;\n"
                      "}\n"
                      "float of_several(float a) {\n"
                      "    if (a > 100.0)\n"
                      "        return of_one_block(a);\n"
                      "    return a;\n"
                      "}\n"
                      "void main() {\n"
                      "    x[gl_LocalInvocationIndex] = of_several(x[gl_LocalInvocationIndex]);\n"
                      "}\n");
    kernel.blocks["Out"] = words_of({1, 2, 3, 4});
    text::Coverage coverage(kernel.program);
    kernel.coverage = &coverage;
    kernel.run();
    CHECK(gaps(kernel.program, coverage) == Gaps{"5 line", "9 line", "8 was never true"});
    kernel.blocks["Out"] = words_of({1, 2, 3, 400}); // a second run adds to the first
    kernel.run();
    CHECK(gaps(kernel.program, coverage).empty());
}

TEST_CASE("coverage: a vertex stage, and a fragment stage that discards") {
    TextStage vertex(Stage::vertex, "#version 450 core\n"
                                    "in float a_Size;\n"
                                    "out float v_Size;\n"
                                    "void main() {\n"
                                    "    v_Size = a_Size;\n"
                                    "    if (a_Size > 2.0)\n"
                                    "        v_Size = 2.0;\n"
                                    "    gl_Position = vec4(0.0);\n"
                                    "}\n");
    vertex.inputs["a_Size"] = words_of({1.0F});
    text::Coverage of_vertex(vertex.program);
    vertex.coverage = &of_vertex;
    vertex.run(20);
    CHECK(gaps(vertex.program, of_vertex) == Gaps{"7 line", "6 was never true"});
    TextStage fragment(Stage::fragment, "#version 450 core\n"
                                        "in float v_Size;\n"
                                        "out vec4 colour;\n"
                                        "void main() {\n"
                                        "    if (v_Size > 0.0)\n"
                                        "        discard;\n"
                                        "    colour = vec4(1.0); }\n"); // newer glslang returns on the brace's line
    fragment.inputs["v_Size"] = words_of({1.0F});
    text::Coverage of_fragment(fragment.program);
    fragment.coverage = &of_fragment;
    fragment.run(20);
    CHECK(gaps(fragment.program, of_fragment) == Gaps{"7 line", "5 was never false"});
}

} // namespace lockstep::test::coverage_test
