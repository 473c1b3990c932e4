#include <array>
#include <memory>
#include <string>

#include <catch2/catch.hpp>

#include "crosscheck/text/gpu_comparison.hpp"
#include "tests/skip.hpp"
#include "tests/system_run.hpp"
#include "tests/text/text_kernel.hpp"

namespace lockstep::test::gpu_comparison_test {

using Catch::Contains;

namespace {

constexpr std::array<std::uint32_t, 3> groups{2, 1, 1};

/// A kernel of 64 floats in `x[]`, from `before` its main on.
std::string kernel(const std::string& statements, const std::string& before = "") {
    return "#version 430 core\nlayout(local_size_x = 32) in;\nlayout(std430) buffer Numbers { float x[]; };\n"
           "uniform vec3 u_Weights;\n" +
           before + "void main() {\n    uint i = gl_GlobalInvocationID.x;\n" + statements + "\n}\n";
}

/// What GL makes of `on_gl`, held against `text`: of a driver without faults they are one.
GpuComparison compared(const std::string& text, const std::string& on_gl, bool is_found = false) {
    const TextKernel known(text);
    const auto source = std::make_shared<ShaderSource>();
    source->text = on_gl;
    source->stage = Stage::compute;
    source->files = {"kernel.comp"};
    for (int line = 1; line < 40; ++line)
        source->origins.push_back({0, line});
    const StageText stage{"kernel.comp", source, TextKernel::module_of(Stage::compute, text, "kernel.comp"),
                          known.program};
    MadeUpWorld world;
    world.words.emplace_back();
    for (int i = 0; i < 64; ++i)
        world.words.back().push_back(std::bit_cast<std::uint32_t>(0.1F + 0.37F * static_cast<float>(i)));
    world.bindings.blocks.emplace_back(world.words.back());
    for (const text::PlainUniform& uniform : known.program.uniforms)
        world.bindings.uniforms.push_back(uniform.name == "u_Weights" ? words_of({0.1F, 7.7F, -0.3F})
                                                                      : std::vector<std::uint32_t>{});
    for (const text::ImageUniform& image : known.program.images) {
        const TexelFormat format = format_of(image);
        std::vector<std::uint32_t>& words = world.words.emplace_back(8 * 8 * format.components);
        for (std::uint32_t w = 0; w < words.size(); ++w)
            words[w] = std::bit_cast<std::uint32_t>(static_cast<float>(w));
        world.bindings.images.push_back({.name = image.name,
                                         .size = {8, 8, 1},
                                         .components = format.components,
                                         .code = format.code,
                                         .words = words});
    }
    text::Findings findings;
    if (is_found)
        findings.add("race on a buffer", {7, 1}, [] { return "x"; });
    return compare_with_gpu({"this GL", gl().profile()}, stage, groups, world, findings);
}

} // namespace

TEST_CASE("GPU comparison: a driver that does what the text says has its bits in every word") {
    if (!gl())
        return skip(gl().missing());
    for (const std::string& text :
         {kernel("    x[i] = x[i] * u_Weights.y + u_Weights.z;"),
          kernel("    s[gl_LocalInvocationIndex] = x[i];\n    barrier();\n    x[i] = s[31u - gl_LocalInvocationIndex];",
                 "shared float s[32];\n"),
          kernel(
              "    imageStore(u_Picture, ivec2(i & 7u, i >> 3u), imageLoad(u_Picture, ivec2(i & 7u, i >> 3u)) * x[0]);",
              "layout(r32f) uniform image2D u_Picture;\n"),
          kernel("    x[i] += texelFetch(u_Source, ivec2(i & 7u, i >> 3u), 0).y;", "uniform sampler2D u_Source;\n")}) {
        const GpuComparison made = compared(text, text);
        INFO(text << made.text());
        CHECK(made.not_run.empty());
        CHECK(made.is_right());
        CHECK(made.words >= 64);
        CHECK(made.differing == made.legal);
    }
}

TEST_CASE("GPU comparison: what the text does not allow is the driver's, with line, invocation and both values") {
    if (!gl())
        return skip(gl().missing());
    const GpuComparison made =
        compared(kernel("\n    x[i] = x[i] * 2.0;"), kernel("\n    x[i] = x[i] * (i == 5u ? 3.0 : 2.0);"));
    CHECK_FALSE(made.is_right());
    CHECK(made.wrong_words == 1);
    REQUIRE(made.wrong.size() == 1);
    CHECK_THAT(made.wrong.front(),
               Contains("kernel.comp:8, invocation 5: Numbers.x[5]: expected 3.9") && Contains("the driver made 5.8"));
    CHECK_THAT(made.text(),
               Contains("on this GL: 1 of 64 words differ: 0 as GL allows, 1 as it does not, 0 not judged"));
    // Where a text writes nothing there is no line.
    const GpuComparison more = compared(kernel("    if (i < 8u) x[i] = 1.0;"), kernel("    if (i < 9u) x[i] = 1.0;"));
    CHECK(more.wrong_words == 1);
    CHECK_THAT(more.wrong.front(), Contains("Numbers.x[8]") && Contains("the text writes nothing there"));
}

TEST_CASE("GPU comparison: another order of a sum is legal without precise, and not with it") {
    if (!gl())
        return skip(gl().missing());
    const std::string one = "    float s = x[i] - u_Weights.x - u_Weights.y + u_Weights.z;\n    x[i] = s;",
                      other =
                          "    precise float s = (x[i] + u_Weights.z) - (u_Weights.y + u_Weights.x);\n    x[i] = s;";
    const GpuComparison legal = compared(kernel(one), kernel(other));
    INFO(legal.text());
    CHECK(legal.is_right());
    CHECK(legal.differing > 0);
    CHECK(legal.legal == legal.differing);
    CHECK_FALSE(compared(kernel("    precise" + one.substr(3)), kernel(other)).is_right());
}

TEST_CASE("GPU comparison: findings leave open what differs, and what is not run says why") {
    if (!gl())
        return skip(gl().missing());
    const GpuComparison open = compared(kernel("    x[i] = 1.0;"), kernel("    x[i] = 2.0;"), true);
    CHECK(open.is_right());
    CHECK(open.open == 64);
    CHECK_THAT(open.text(), Contains("64 of 64 words are not as the text has them; what was found leaves them open"));
    CHECK_THAT(compared(kernel("    x[i] = 1.0;"), kernel("    x[i] = nothing;")).not_run, Contains("kernel.comp:7"));
}

} // namespace lockstep::test::gpu_comparison_test
