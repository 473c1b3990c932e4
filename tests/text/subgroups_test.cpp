#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "reference/model/error.hpp"
#include "tests/text/text_stage.hpp"

namespace lockstep::test::subgroups_test {

namespace {

using Words = std::vector<std::uint32_t>;

/// A group of `invocations`, each of which leaves `uint x[i]`, i being its place.
struct Subgroups {
    Subgroups(const std::string& statements, std::uint32_t invocations, std::uint32_t size)
        : kernel(R"(#extension GL_KHR_shader_subgroup_vote : require
                    #extension GL_KHR_shader_subgroup_ballot : require
                    #extension GL_KHR_shader_subgroup_shuffle : require
                    #extension GL_KHR_shader_subgroup_shuffle_relative : require
                    #extension GL_KHR_shader_subgroup_arithmetic : require
                    #extension GL_KHR_shader_subgroup_clustered : require
                    #extension GL_KHR_shader_subgroup_quad : require
                    layout(local_size_x = )" +
                 std::to_string(invocations) + R"() in;
                    layout(std430, binding = 0) buffer Out { uint x[]; };
                    void main() { uint i = gl_LocalInvocationIndex;)" +
                 statements + "}") {
        kernel.blocks["Out"].resize(invocations);
        kernel.is_watched = true;
        kernel.subgroup_size = size;
        kernel.run();
    }
    [[nodiscard]] const Words& left() const { return kernel.blocks.at("Out"); }

    TextKernel kernel;
};

Words left_by(const std::string& statements, std::uint32_t invocations, std::uint32_t size) {
    const Subgroups made(statements, invocations, size);
    CHECK(made.kernel.findings.all().empty());
    return made.left();
}

} // namespace

TEST_CASE("text: subgroups are of invocations in a row, the last of what is left") {
    CHECK(left_by("x[i] = gl_SubgroupID * 100u + gl_SubgroupInvocationID * 10u + gl_NumSubgroups;", 6, 4) ==
          Words{2, 12, 22, 32, 102, 112});
    CHECK(left_by("x[i] = gl_SubgroupSize;", 2, 32) == Words{32, 32});
    CHECK(left_by("x[i] = gl_SubgroupGeMask.x * 100u + gl_SubgroupLtMask.x;", 4, 4) == Words{1500, 1401, 1203, 807});
}

TEST_CASE("text: votes, ballots and elections are of the invocations that come there together") {
    CHECK(left_by("if (i % 2u == 1u) x[i] = subgroupBallot(i > 2u).x * 10u + (subgroupElect() ? 1u : 0u);", 8, 4) ==
          Words{0, 1 + 80, 0, 80, 0, 101, 0, 100});
    CHECK(left_by("x[i] = (subgroupAll(i < 4u) ? 1u : 0u) + (subgroupAny(i == 5u) ? 2u : 0u) +"
                  "       (subgroupAllEqual(float(i / 4u)) ? 4u : 0u);",
                  8, 4) == Words{5, 5, 5, 5, 6, 6, 6, 6});
    CHECK(left_by("uvec4 b = subgroupBallot(i != 1u); x[i] = subgroupBallotBitCount(b) * 1000u +"
                  "subgroupBallotInclusiveBitCount(b) * 100u + subgroupBallotFindMSB(b) * 10u + "
                  "(subgroupInverseBallot(b) ? 1u : 0u);",
                  4, 4) == Words{3131, 3130, 3231, 3331});
}

TEST_CASE("text: values go from invocation to invocation, and those of the absent are findings") {
    CHECK(
        left_by("x[i] = subgroupShuffleXor(i, 3u) * 100u + subgroupBroadcastFirst(i) * 10u + subgroupBroadcast(i, 2u);",
                8, 4) == Words{302, 202, 102, 2, 746, 646, 546, 446});
    CHECK(left_by("x[i] = subgroupQuadSwapHorizontal(i) * 100u + subgroupQuadSwapVertical(i) * 10u + "
                  "subgroupQuadBroadcast(i, 1u);",
                  4, 32) == Words{121, 31, 301, 211});
    const Subgroups down("x[i] = subgroupShuffleDown(i, 1u);", 4, 4);
    CHECK(down.left() == Words{1, 2, 3, 0});
    REQUIRE(down.kernel.findings.all().size() == 1);
    CHECK_THAT(down.kernel.findings.all().front().rule, Catch::Contains("not active in the subgroup"));
    CHECK(down.kernel.findings.all().front().place.invocation == 3);
    const Subgroups unset("uint v; if (i == 2u) v = 7u; uint w = subgroupBroadcast(v, 2u); x[i] = w;", 4, 4);
    CHECK(unset.kernel.findings.all().empty());
    const Subgroups used("uint v; if (i != 2u) v = 7u; x[i] = subgroupAdd(v);", 4, 4);
    CHECK(used.kernel.findings.all().size() == 1);
}

TEST_CASE("text: reductions and scans, of integers, floats and clusters") {
    CHECK(left_by("x[i] = subgroupAdd(i) * 1000u + subgroupExclusiveAdd(i) * 100u + subgroupInclusiveMax(i + 1u);", 4,
                  4) == Words{6001, 6002, 6103, 6304});
    CHECK(left_by("x[i] = uint(subgroupMul(vec2(float(i + 1u), 2.0)).x) + uint(subgroupExclusiveMin(float(i)) > 1e30 ? "
                  "100 : 0);",
                  4, 4) == Words{124, 24, 24, 24});
    CHECK(left_by("x[i] = subgroupClusteredAdd(i, 2u) * 10u + subgroupXor(i);", 8, 8) ==
          Words{10, 10, 50, 50, 90, 90, 130, 130});
    CHECK(left_by("x[i] = uint(subgroupMin(int(i) - 2) + 2) + 100u * uint(subgroupMax(int(i) - 3) + 3) + "
                  "(subgroupAnd(i < 3u) ? 10u : 20u);",
                  4, 4) == Words{320, 320, 320, 320});
}

TEST_CASE("text: subgroups of fragments, and inputs between their places, are of examined runs") {
    const std::string text =
        "#extension GL_KHR_shader_subgroup_arithmetic : require\n"
        "in vec2 v_At; out vec4 colour;\n"
        "void main() { colour = vec4(interpolateAtCentroid(v_At), interpolateAtOffset(v_At.y, vec2(0.1)),\n"
        "    float(subgroupAdd(1u) + 10u * gl_SubgroupInvocationID)); }\n";
    TextStage stage(Stage::fragment, text);
    stage.inputs["v_At"] = words_of({3.0F, 4.0F});
    CHECK_THROWS_WITH(stage.run(4),
                      Catch::Contains("is the driver's choice; such a text is interpreted by examine alone"));
    stage.subgroup_size = 4;
    const std::vector<float> made = floats_of(stage.run(8).outputs.at("colour"));
    CHECK(std::vector(made.begin() + 20, made.begin() + 28) ==
          std::vector{3.0F, 4.0F, 4.0F, 14.0F, 3.0F, 4.0F, 4.0F, 24.0F});
}

TEST_CASE("text: compute stages have neighbours where they say so") {
    const auto left = [](const std::string& how) {
        TextKernel kernel("#extension GL_NV_compute_shader_derivatives : require\n"
                          "layout(local_size_x = 4, local_size_y = 2, " +
                          how +
                          ") in;\nlayout(binding = 0) buffer Out { float x[8]; };\n"
                          "void main() { uint i = gl_LocalInvocationIndex;\n"
                          "    x[i] = dFdx(float(i * i)) + 100.0 * dFdy(float(i * i)); }\n");
        kernel.blocks["Out"].resize(8);
        kernel.run();
        return floats_of(kernel.blocks["Out"]);
    };
    CHECK(left("derivative_group_linearNV") ==
          std::vector{401.0F, 801.0F, 405.0F, 805.0F, 2009.0F, 2409.0F, 2013.0F, 2413.0F});
    CHECK(left("derivative_group_quadsNV") ==
          std::vector{1601.0F, 2401.0F, 3205.0F, 4005.0F, 1609.0F, 2409.0F, 3213.0F, 4013.0F});
    // Older glslang says so itself.
    CHECK_THROWS_AS(TextKernel("#extension GL_NV_compute_shader_derivatives : require\n"
                               "layout(local_size_x_id = 1, local_size_y_id = 2, derivative_group_quadsNV) in;\n"
                               "buffer Out { float x[]; };\nvoid main() { x[0] = dFdx(1.0); }\n"),
                    Error);
}

TEST_CASE("text: subgroups need a size, which is given") {
    const auto refused = [](const std::string& statements, std::uint32_t size) {
        try {
            const Subgroups made(statements, 4, size);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK_THAT(refused("\nx[i] = gl_SubgroupSize;", 0),
               Catch::Contains("kernel.comp:11: the size of subgroups is the driver's choice"));
    CHECK_THAT(refused("\nsubgroupBarrier();", 4),
               Catch::Contains("kernel.comp:11: a barrier of another scope than a group is not interpreted"));
}

} // namespace lockstep::test::subgroups_test
