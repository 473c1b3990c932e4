#include <catch2/catch.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "crosscheck/text/keeping_text.hpp"
#include "tests/text/text_stage.hpp"

namespace lockstep::test::stage_capture_test {

using Catch::Contains;

TEST_CASE("stage capture: members of a block are kept by its instance's name, or by their own where it has none") {
    const std::string head =
        "#version 450 core\nin vec2 a_Place;\nout Result {\n    vec2 place;\n    float pace[2];\n}";
    const std::string body = ";\nvoid main() {\n    PLACE = a_Place;\n    PACE[1] = 3.0;\n"
                             "    gl_Position = vec4(a_Place, 0.0, 1.0);\n}\n";
    const auto kept = [&](const std::string& instance) {
        std::string text = head + (instance.empty() ? "" : " " + instance) + body;
        const std::string prefix = instance.empty() ? "" : instance + ".";
        text.replace(text.find("PLACE"), 5, prefix + "place").replace(text.find("PACE"), 4, prefix + "pace");
        const TextStage stage(Stage::vertex, text);
        return keeping_text(InvocationRecord(stage.program), text, 8);
    };
    const std::string named = kept("result"), bare = kept("");
    CHECK_THAT(named, Contains("ls_keep(3u, floatBitsToUint(a_Place[0]))"));
    CHECK_THAT(named, Contains("floatBitsToUint(result.place[1])") && Contains("floatBitsToUint(result.pace[1])"));
    CHECK_THAT(named, Contains("void ls_main() {") && Contains("void main() {\n    ls_at = atomicAdd(ls_count, 1u);"));
    CHECK_THAT(bare, Contains("floatBitsToUint(place[1])") && Contains("floatBitsToUint(pace[1])"));
}

TEST_CASE("stage capture: records are the inputs and outputs of each invocation, and the strips of each") {
    const TextStage stage(Stage::geometry,
                          "#version 450 core\nlayout(points) in;\nlayout(triangle_strip, max_vertices = 4) out;\n"
                          "in float v_Size[];\nout float g_Size;\nvoid main() {\n    for (int i = 0; i < 3; ++i) {\n"
                          "        g_Size = v_Size[0] + float(i);\n        gl_Position = vec4(0.0);\n"
                          "        EmitVertex();\n    }\n    EndPrimitive();\n}\n");
    const InvocationRecord record(stage.program);
    REQUIRE(record.vertices == 4);
    REQUIRE(record.inputs.size() == 1);
    const std::size_t outputs = record.outputs.size();
    std::vector<std::uint32_t> words(2 * record.words());
    for (std::uint32_t i = 0; i < 2; ++i) {
        std::uint32_t* const one = words.data() + i * record.words();
        one[0] = 1, one[1] = 3, one[2] = 1U << 2U; // a strip of two vertices and one of one
        one[InvocationRecord::first_input] = 70 + i;
        for (std::uint32_t v = 0; v < 3; ++v)
            for (std::size_t k = 0; k < outputs; ++k)
                one[record.first_output() + v * outputs + k] =
                    record.outputs[k].first->name == "g_Size" ? 10 * i + v : 0;
    }
    const text::StageRun run = run_of(record, words);
    CHECK(run.invocations == 2);
    CHECK(run.inputs.at("v_Size") == std::vector<std::uint32_t>{70, 71});
    const text::StageResult made = result_of(record, words);
    CHECK(made.vertices == 6);
    CHECK(made.outputs.at("g_Size") == std::vector<std::uint32_t>{0, 1, 2, 10, 11, 12});
    REQUIRE(made.strips.size() == 4);
    CHECK(made.strips[1].first == 2);
    CHECK(made.strips[1].count == 1);
    CHECK(made.strips[2].invocation == 1);
    CHECK(made.strips[2].first == 3);
    CHECK(made.is_discarded == std::vector<std::uint8_t>{0, 0});
}

} // namespace lockstep::test::stage_capture_test
