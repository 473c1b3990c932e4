#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "reference/model/error.hpp"
#include "tests/text/text_stage.hpp"

using namespace lockstep;
using namespace lockstep::test;

namespace {

const std::string layout = "layout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer Out { float x[]; };\n";

/// What a whole text leaves in `float x[4]`.
std::vector<float> left_by(const std::string& text) {
    TextKernel kernel(text);
    kernel.blocks["Out"].resize(4);
    kernel.run();
    return floats_of(kernel.blocks["Out"]);
}

std::string refusal(Stage stage, const std::string& text) {
    try {
        const BoundText bound(stage, text, "stage");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_CASE("text: GLSL ES, also of versions that have no SPIR-V") {
    CHECK(left_by("#version 310 es\nprecision highp float;\n" + layout +
                  "void main() { x[1] = float(gl_WorkGroupSize.x) + 2.0; }\n") == std::vector{0.0F, 3.0F, 0.0F, 0.0F});
    TextStage stage(Stage::fragment,
                    "#version 300 es\nprecision mediump float;\nin vec2 v_Place;\nuniform float u_By;\n"
                    "out vec4 colour;\nvoid main() { colour = vec4(v_Place * u_By, 0.0, 1.0); }\n");
    stage.uniforms["u_By"] = words_of({2.0F});
    stage.inputs["v_Place"] = words_of({0.5F, 3.0F});
    CHECK(floats_of(stage.run(1).outputs.at("colour")) == std::vector{1.0F, 6.0F, 0.0F, 1.0F});
    CHECK_THAT(
        refusal(Stage::fragment, "#version 100\nprecision highp float;\nvarying vec2 v_Place;\nvoid main() {}\n"),
        Catch::Contains("shader stage:3: 'varying'"));
}

TEST_CASE("text: desktop versions without SPIR-V or compute stages mean the same in 4.60, unless they ask for theirs") {
    const std::string old = "#version 330\n#extension GL_ARB_compute_shader : require\n"
                            "#extension GL_ARB_shader_storage_buffer_object : require\n";
    CHECK(left_by(old + layout + "void main() { x[0] = 4.0; }\n") == std::vector{4.0F, 0.0F, 0.0F, 0.0F});
    CHECK(left_by("// 4.60 where there is no #version\n" + layout + "void main() { x[0] = 5.0; }\n") ==
          std::vector{5.0F, 0.0F, 0.0F, 0.0F});
    CHECK_THAT(refusal(Stage::compute, old + "#if __VERSION__ < 430\n#define TWO 2.0\n#endif\n" + layout +
                                           "void main() { x[0] = 4.0; }\n"),
               Catch::Contains("shader stage: ERROR: #version: compute shaders require"));
    CHECK_THAT(refusal(Stage::compute, old + layout + "void main() {\n    x[0] = y;\n}\n"),
               Catch::Contains("shader stage:7: 'y' : undeclared identifier"));
}

TEST_CASE("text: GLSL for Vulkan, with sets, push constants, plain uniforms and samplers apart from their images") {
    TextKernel kernel(R"(layout(local_size_x = 1) in;
        layout(std430, set = 1, binding = 0) buffer Out { float x[]; };
        layout(push_constant) uniform Push { int count; vec2 by; } push;
        layout(set = 2, binding = 1) uniform texture2D u_Image;
        layout(set = 2, binding = 2) uniform sampler u_Sampler;
        layout(set = 0, binding = 7) uniform Light { mat2 turned; layout(offset = 64) float colour[2]; };
        uniform float u_Plain;
        void main() {
            x[0] = float(push.count) * push.by.y;
            x[1] = texture(sampler2D(u_Image, u_Sampler), vec2(0.75, 0.5)).x;
            x[2] = turned[1][0] + colour[1];
            x[3] = u_Plain;
        })");
    kernel.blocks["Out"].resize(4);
    kernel.blocks["Push"] = {3, 0, words_of({1.0F})[0], words_of({5.0F})[0]};
    kernel.blocks["Light"].resize(24);
    kernel.blocks["Light"][4] = words_of({7.0F})[0];
    kernel.blocks["Light"][20] = words_of({0.5F})[0];
    kernel.blocks["gl_DefaultUniformBlock"] = words_of({9.0F});
    kernel.images["u_Image"] = {{.size = {2, 1, 1}, .components = 1}, words_of({1.0F, 2.0F})};
    kernel.run();
    CHECK(floats_of(kernel.blocks["Out"]) == std::vector{15.0F, 2.0F, 7.5F, 9.0F});
    std::vector<std::string> names;
    for (const text::Block& block : kernel.program.blocks)
        for (const text::Block::Member& member : block.members)
            names.push_back(member.name + " " + std::to_string(member.leaves.front().word) + " " +
                            std::to_string(member.leaves.size()));
    CHECK_THAT(names, Catch::Matchers::UnorderedEquals(std::vector<std::string>{
                          "Push.count 0 1", "Push.by 2 2", "turned 0 4", "colour 16 2", "u_Plain 0 1"}));
}

TEST_CASE("text: atomic counters count, each in words of its own") {
    TextKernel kernel(R"(layout(local_size_x = 1) in;
        layout(std430, binding = 0) buffer Out { uint x[]; };
        layout(binding = 0, offset = 4) uniform atomic_uint one;
        layout(binding = 0, offset = 8) uniform atomic_uint many[3];
        uint taken(atomic_uint from) { return atomicCounterIncrement(from); }
        void main() {
            x[0] = taken(one);
            x[1] = atomicCounterIncrement(many[2]) + atomicCounterIncrement(many[1 + int(x[3])]);
            x[2] = atomicCounterDecrement(many[1]);
            x[3] = atomicCounter(many[2]);
        })");
    kernel.blocks["Out"].resize(4);
    kernel.blocks["one"] = {7};
    kernel.blocks["many"] = {1, 20, 30};
    kernel.run();
    CHECK(kernel.blocks["Out"] == std::vector<std::uint32_t>{7, 50, 20, 31});
    CHECK(kernel.blocks["one"] == std::vector<std::uint32_t>{8});
    CHECK(kernel.blocks["many"] == std::vector<std::uint32_t>{1, 20, 31});
}

TEST_CASE("text: buffers are read as images of one dimension") {
    TextKernel kernel(R"(layout(local_size_x = 1) in;
        layout(std430, binding = 0) buffer Out { float x[]; };
        uniform samplerBuffer u_From;
        layout(r32f) uniform imageBuffer u_To;
        void main() {
            x[0] = texelFetch(u_From, 2).x;
            x[1] = float(textureSize(u_From)) + 10.0 * float(imageSize(u_To));
            imageStore(u_To, 1, imageLoad(u_To, 0) * 2.0);
        })");
    kernel.blocks["Out"].resize(4);
    kernel.images["u_From"] = {{.size = {3, 1, 1}, .components = 1}, words_of({1.0F, 2.0F, 3.0F})};
    kernel.images["u_To"] = {{.size = {2, 1, 1}, .components = 1}, words_of({4.0F, 0.0F})};
    kernel.run();
    CHECK(floats_of(kernel.blocks["Out"]) == std::vector{3.0F, 23.0F, 0.0F, 0.0F});
    CHECK(floats_of(kernel.images["u_To"].words) == std::vector{4.0F, 8.0F});
}
