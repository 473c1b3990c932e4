#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "reference/model/error.hpp"
#include "tests/text/text_stage.hpp"

namespace lockstep::test::dialects_test {

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

TEST_CASE("text: GLSL 1.10, 1.20 and GLSL ES 1.00, and a text that does not say its version") {
    for (const std::string version :
         {"#version 100\n", "#version 110\n", "#version 120\n", "#version 130\n", "#version 140\n"}) {
        INFO(version);
        TextStage stage(Stage::fragment, version + "#ifdef GL_ES\nprecision mediump float;\n#endif\n"
                                                   "varying vec2 v_Place;\nuniform float u_By;\n"
                                                   "void main() { gl_FragColor = vec4(v_Place * u_By, 0.0, 1.0); }\n");
        stage.uniforms["u_By"] = words_of({2.0F});
        stage.inputs["v_Place"] = words_of({0.5F, 3.0F});
        CHECK(floats_of(stage.run(1).outputs.at("ls_FragColor")) == std::vector{1.0F, 6.0F, 0.0F, 1.0F});
    }
    auto unsaid = std::make_shared<ShaderSource>();
    unsaid->stage = Stage::fragment;
    unsaid->text = "varying vec2 v_Place;\nvoid main() { gl_FragColor = v_Place.xyxy; }\n";
    unsaid->files = {"old.frag"};
    unsaid->origins.resize(3);
    CHECK(program_of(unsaid).stage_outputs.front().name == "ls_FragColor");
    TextStage vertex(Stage::vertex, "#version 120\nattribute vec3 a_Place;\nvarying vec4 v_Colour;\n"
                                    "void main() {\n    v_Colour = gl_Color + gl_MultiTexCoord0;\n"
                                    "    gl_Position = ftransform() + vec4(a_Place, 0.0);\n}\n");
    vertex.uniforms["ls_ModelViewProjectionMatrix"] = words_of({2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1});
    vertex.inputs["a_Place"] = words_of({10, 20, 30});
    vertex.inputs["ls_Vertex"] = words_of({1, 2, 3, 1});
    vertex.inputs["ls_Color"] = words_of({0.5F, 0, 0, 1});
    vertex.inputs["ls_MultiTexCoord0"] = words_of({1, 2, 0, 0});
    const text::StageResult made = vertex.run(1);
    CHECK(floats_of(made.outputs.at("gl_Position")) == std::vector{12.0F, 24.0F, 36.0F, 1.0F});
    CHECK(floats_of(made.outputs.at("v_Colour")) == std::vector{1.5F, 2.0F, 0.0F, 1.0F});
    CHECK_THAT(refusal(Stage::fragment, "#version 120\nvarying vec2 v;\nvoid main() {\n    gl_FragColor = w;\n}\n"),
               Catch::Contains("shader stage:4: 'w' : undeclared identifier"));
}

TEST_CASE("text: old functions that sample, beside a variable of the later function's name") {
    for (const std::string name : {"u_Image", "texture"}) {
        INFO(name);
        TextStage stage(Stage::fragment, "#version 100\nprecision mediump float;\nuniform sampler2D " + name +
                                             ";\nvoid main() { gl_FragColor = texture2D(" + name +
                                             ", vec2(0.75, 0.5)); }\n");
        text::TexelMemory two;
        two.size = {2, 1, 1};
        stage.images[name] = {two, words_of({1, 2, 3, 4, 5, 6, 7, 8})};
        CHECK(floats_of(stage.run(1).outputs.at("ls_FragColor")) == std::vector{5.0F, 6.0F, 7.0F, 8.0F});
    }
}

} // namespace lockstep::test::dialects_test
