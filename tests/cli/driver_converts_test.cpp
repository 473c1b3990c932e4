#include <catch2/catch.hpp>

#include <string>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::driver_converts_test {

namespace {

/// What check says of a fragment stage that stores `stored` where the shipped one calls the encoder.
test::Outcome checked(const std::string& format, const std::string& obstacles, const std::string& file,
                      const std::string& encoded, const std::string& stored) {
    const test::TemporaryFolder folder, shaders;
    test::plant(shaders, file, encoded, stored);
    if (stored.find("packHalf") != std::string::npos) // GLSL 4.20 has it, and 3.30 by an extension
        test::plant(shaders, file, "#version 330 core\n",
                    "#version 330 core\n#extension GL_ARB_shading_language_packing : require\n");
    return test::run_lockstep({"check", "data/scenes/lattice.json", "--particles", "500", "--frames", "8", "--gl",
                               test::software_gl(), "--set", "cdt_format=" + format, "--set",
                               "obstacles_in_cdt=" + obstacles, "--shaders", shaders.path().string()});
}

struct Format {
    const char* name;
    const char* stored; ///< plain floats; P stands for the position
};
constexpr Format formats[] = {{"rgba32f", "vec4(P, 1.0)"},
                              {"rgba16f", "vec4(P, 1.0)"},
                              {"rgba8", "vec4((P - u_CdtBoxMin) / (u_CdtBoxStep * 255.0), 1.0)"}};

struct Stage {
    const char *obstacles, *file, *encoded, *position;
};
constexpr Stage stages[] = {{"triangles", "collision_pass.frag", "encode_position(out_Position)", "out_Position"},
                            {"triangles", "obstacle_pass.frag",
                             "encode_position(interpolate(g_Position, fragment.shares))",
                             "interpolate(g_Position, fragment.shares)"},
                            {"vertices", "obstacle_vertices.frag", "encode_position(g_Position)", "g_Position"}};

std::string with_position(std::string text, const std::string& position) {
    return text.replace(text.find('P'), 1, position);
}

} // namespace

TEST_CASE("driver converts: a fragment stage that stores plain floats is LEGAL in every format, with a hint") {
    if (!test::have_software_gl())
        return;
    for (const Stage& stage : stages)
        for (const Format& format : formats) {
            INFO(stage.file << " " << format.name);
            const test::Outcome outcome = checked(format.name, stage.obstacles, stage.file, stage.encoded,
                                                  with_position(format.stored, stage.position));
            INFO(outcome.out << outcome.err);
            CHECK(outcome.status == 0);
            const std::string hint = "note      " + std::string(stage.file) + " leaves the rounding to " + format.name;
            if (std::string(format.name) == "rgba32f") {
                CHECK_THAT(outcome.out, Catch::Contains("verdict   AGREE"));
                CHECK_THAT(outcome.out, !Catch::Contains("leaves the rounding"));
            } else {
                CHECK_THAT(outcome.out, Catch::Contains(hint));
            }
        }
}

TEST_CASE("driver converts: components swapped, codes two off or an encoder of one's own that is off are DIVERGENT") {
    if (!test::have_software_gl())
        return;
    const auto divergent = [](const char* format, const Stage& stage, const std::string& stored) {
        INFO(stage.file << " " << format << " " << stored);
        const test::Outcome outcome = checked(format, stage.obstacles, stage.file, stage.encoded, stored);
        CHECK(outcome.status == 1);
        CHECK_THAT(outcome.out, Catch::Contains("DIVERGENT"));
    };
    for (const Stage& stage : stages) {
        const std::string p = stage.position;
        divergent("rgba16f", stage, "vec4(" + p + ".yxz, 1.0)");
        divergent("rgba16f", stage, "vec4(" + p + " * 1.002, 1.0)");
        divergent("rgba8", stage, "vec4((" + p + " - u_CdtBoxMin).zyx / (u_CdtBoxStep * 255.0).zyx, 1.0)");
        divergent("rgba8", stage, "vec4((" + p + " - u_CdtBoxMin) / (u_CdtBoxStep * 255.0) + 2.0 / 255.0, 1.0)");
        divergent("rgba16f", stage, "encode_position(" + p + " * 1.001)");
    }
}

TEST_CASE(
    "driver converts: a stage that cuts to codes itself is DIVERGENT, whatever the driver does with plain floats") {
    if (!test::have_software_gl())
        return;
    for (const Stage& stage : stages) {
        const std::string p = stage.position;
        const std::string place = "(" + p + " - u_CdtBoxMin) / u_CdtBoxStep";
        for (const auto& [format, stored] :
             {std::pair<const char*, std::string>{"rgba8", "vec4(floor(" + place + ") / 255.0, 1.0)"},
              {"rgba16f", "vec4(uintBitsToFloat(floatBitsToUint(" + p + ") & 0xffffe000u), 1.0)"}}) {
            INFO(stage.file << " " << format);
            const test::Outcome outcome = checked(format, stage.obstacles, stage.file, stage.encoded, stored);
            INFO(outcome.out << outcome.err);
            CHECK(outcome.status == 1);
            CHECK_THAT(outcome.out, Catch::Contains("DIVERGENT"));
            if (std::string(format) == "rgba16f")
                CHECK_THAT(outcome.out, !Catch::Contains("leaves the rounding"));
        }
    }
}

TEST_CASE("driver converts: a stage that rounds to the nearest code in its own way, or packs, is not DIVERGENT") {
    if (!test::have_software_gl())
        return;
    for (const Stage& stage : stages) {
        const std::string p = stage.position;
        const std::string place = "(" + p + " - u_CdtBoxMin) / u_CdtBoxStep";
        for (const auto& [format, stored] :
             {std::pair<const char*, std::string>{"rgba8", "vec4(floor(" + place + " + 0.5) / 255.0, 1.0)"},
              {"rgba8", "vec4(round(" + place + ") / 255.0, 1.0)"},
              {"rgba16f", "vec4(unpackHalf2x16(packHalf2x16(" + p + ".xy)), unpackHalf2x16(packHalf2x16(" + p +
                              ".zz)).x, 1.0)"}}) {
            INFO(stage.file << " " << format << " " << stored);
            const test::Outcome outcome = checked(format, stage.obstacles, stage.file, stage.encoded, stored);
            INFO(outcome.out << outcome.err);
            CHECK(outcome.status == 0);
        }
    }
}

TEST_CASE("driver converts: the fragment stage of the compute step may leave its floats to the driver, too") {
    if (!test::have_software_gl())
        return;
    for (const auto& [stored, status] :
         {std::pair{"vec4(after[particle].position, 1.0)", 0}, {"vec4(after[particle].position.yxz, 1.0)", 1}}) {
        const test::TemporaryFolder shaders;
        test::plant(shaders, "collision_texels.frag", "encode_position(after[particle].position)", stored);
        const test::Outcome outcome = test::run_lockstep(
            {"check", "data/scenes/lattice.json", "--particles", "500", "--frames", "4", "--gl", test::software_gl(),
             "--set", "cdt_format=rgba16f", "--set", "step=compute", "--shaders", shaders.path().string()});
        INFO(stored << outcome.out << outcome.err);
        CHECK(outcome.status == status);
    }
}

} // namespace lockstep::test::driver_converts_test
