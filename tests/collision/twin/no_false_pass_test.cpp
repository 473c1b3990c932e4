#include <bit>
#include <cstdint>

#include <catch2/catch.hpp>

#include "gpu/gl.hpp"
#include "reference/model/error.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/twin_scenes.hpp"
#include "tests/planted_shader.hpp"
#include "tests/shader_clock.hpp"

namespace lockstep::test::no_false_pass_test {

using test::check_twins;
using test::crowded_scene;

TEST_CASE("no false pass: particles that are not passed on are an error, none or some of them") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    SECTION("none") {
        test::plant(shaders, "collision_pass.geom", "    EmitVertex();\n    EndPrimitive();\n", "");
        CHECK_THROWS_WITH(check_twins(crowded_scene(100), 2, shaders.path()),
                          "collision_pass: the shaders emitted 0 points for 100 particles; the last vertex-processing "
                          "stage must emit exactly one point a particle");
    }
    SECTION("all but one") {
        test::plant(shaders, "collision_pass.geom", "    EmitVertex();\n",
                    "    if (gl_PrimitiveIDIn != 42) EmitVertex();\n");
        CHECK_THROWS_WITH(check_twins(crowded_scene(100), 2, shaders.path()),
                          Catch::StartsWith("collision_pass: the shaders emitted 99 points for 100 particles"));
    }
    SECTION("twice, where the second finds no room in the buffer") {
        test::plant(shaders, "collision_pass.geom", "max_vertices = 1", "max_vertices = 2");
        test::plant(shaders, "collision_pass.geom", "    EmitVertex();\n",
                    "    EmitVertex();\n    out_Position = v_Position[0];\n    gl_Position = gl_in[0].gl_Position;\n"
                    "    EmitVertex();\n");
        CHECK_THROWS_WITH(check_twins(crowded_scene(1), 2, shaders.path()),
                          Catch::StartsWith("collision_pass: the shaders emitted 2 points for 1 particles"));
    }
}

TEST_CASE("no false pass: a shader that answers twice in two ways is nondeterministic") {
    if (!test::offers_shader_clock())
        return;
    const auto context = test::open_llvmpipe();
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.vert", "#version 330 core\n",
                "#version 330 core\n#extension GL_ARB_shader_clock : require\n");
    SECTION("particles") {
        test::plant(shaders, "collision_pass.vert", "v_Speed = ls_length(temp);",
                    "v_Speed = ls_length(temp) + float(clock2x32ARB().x & 0xffffu);");
    }
    SECTION("texels") {
        test::plant(
            shaders, "collision_pass.vert", "gl_Position = point_position(clip);",
            "gl_Position = point_position(clip) + vec4(float(clock2x32ARB().x & 0xffu) / 256.0, 0.0, 0.0, 0.0);");
    }
    const CheckReport report = check_twins(crowded_scene(), 4, shaders.path());
    CHECK(report.verdict == Verdict::nondeterministic);
    CHECK(report.first_frame == 0);
    CHECK(report.frames == 1);
    CHECK_FALSE(report.total.agree());
}

TEST_CASE("no false pass: an image that is neither cleared nor drawn is an error") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    gl::Enable(GL_SCISSOR_TEST);
    gl::Scissor(0, 0, 20, 20);
    Scene scene = crowded_scene();
    for (const CdtFormat format : {CdtFormat::rgba32f, CdtFormat::rgba16f, CdtFormat::rgba8})
        for (const int layers : {1, 2}) {
            scene.switches.cdt_format = format;
            scene.switches.cdt_layers = layers;
            INFO(switch_value(scene.switches, "cdt_format") << ", " << layers << " layers");
            CHECK_THROWS_WITH(check_twins(scene, 2),
                              "frame 0: the GPU neither cleared nor drew texel (20, 0) of the CDT");
        }
}

TEST_CASE("no false pass: a record that was not written is an error that names the particle") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const float canary = std::bit_cast<float>(std::uint32_t{0xca7ca7ca});
    const Scene scene = crowded_scene(5);
    const GpuSimulation gpu(scene, {});
    const CollisionImage cdt(4, 4);
    CHECK_NOTHROW(gpu.find_canary(scene.start, cdt, 1));
    const std::string message =
        "frame 1: the GPU did not write particle 3: its record still holds what was laid there before the draw";
    Particles particles = scene.start;
    particles.position[3].z = canary;
    CHECK_THROWS_WITH(gpu.find_canary(particles, cdt, 1), message);
    particles = scene.start;
    particles.direction[3].x = canary;
    CHECK_THROWS_WITH(gpu.find_canary(particles, cdt, 1), message);
    particles = scene.start;
    particles.speed[3] = canary;
    CHECK_THROWS_WITH(gpu.find_canary(particles, cdt, 1), message);
    particles = scene.start;
    particles.collide_time[3] = canary;
    CHECK_THROWS_WITH(gpu.find_canary(particles, cdt, 1), message);
}

TEST_CASE("no false pass: the canary is laid, and every frame writes over it") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const Scene scene = crowded_scene();
    GpuSimulation gpu(scene, {});
    Particles particles;
    CollisionImage cdt;
    gpu.lay_canary();
    gpu.step(frame_params(scene, 0));
    gpu.read(particles);
    gpu.read(cdt);
    CHECK_NOTHROW(gpu.find_canary(particles, cdt, 0));
}

TEST_CASE("no false pass: a GL error ends the run") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const Scene scene = crowded_scene(10);
    GpuSimulation gpu(scene, {});
    gl::Enable(0x1234);
    CHECK_THROWS_WITH(gpu.step(frame_params(scene, 0)), Catch::EndsWith("GL_INVALID_ENUM"));
    GpuSimulation next(scene, {});
    CHECK_NOTHROW(next.step(frame_params(scene, 0)));
}

TEST_CASE("no false pass: a run that compared nothing is an error") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const std::atomic<bool> stop{true};
    const Scene scene = crowded_scene(10);
    GpuSimulation gpu(scene, {});
    CheckOptions options;
    options.stop = &stop;
    CHECK_THROWS_WITH(check(scene, test::llvmpipe_profile(), gpu, options),
                      "crowded: nothing was compared: 0 frames of 10 particles");
}

namespace {

/// What a check of these shaders is refused with.
std::string refusal(const test::TemporaryFolder& shaders, const Switches& switches = {}) {
    Scene scene = crowded_scene(100);
    scene.switches = switches;
    try {
        check_twins(scene, 2, shaders.path());
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("no false pass: a block that nobody binds is an error with its name") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    const std::string file = (shaders.path() / "collision_pass.vert").string();
    SECTION("uniform block, whose member has a name that is set") {
        test::plant(shaders, "collision_pass.vert", "uniform float u_Tick;", "uniform Step { float u_Tick; };");
        CHECK(refusal(shaders) ==
              "shader " + file +
                  ":23: nothing is given for uniform block Step; bindings.json beside the shader binds its members "
                  "(docs/own_shader.md)");
    }
    SECTION("storage buffer") {
        test::plant(shaders, "collision_pass.vert", "#version 330 core", "#version 430 core");
        test::plant(shaders, "collision_pass.vert", "uniform float u_Tick;", "buffer Step { float u_Tick; };");
        CHECK(refusal(shaders) ==
              "shader " + file +
                  ":23: nothing is given for storage buffer Step; storage buffers are bound in compute shaders alone "
                  "(docs/own_shader.md)");
    }
}

TEST_CASE("no false pass: a geometry stage's input that the vertex stage does not write is an error with its name") {
    const auto context = test::open_context("osmesa");
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    std::ifstream stream("tests/collision/right_shaders/components.vert"); // which has outputs of its own
    shaders.write("collision_pass.vert", std::string{std::istreambuf_iterator<char>(stream), {}});
    CHECK_THAT(refusal(shaders),
               Catch::StartsWith("shader shaders/collision/collision_pass.geom:9: input v_Position is written "
                                 "by no stage before it (") &&
                   Catch::EndsWith("; an empty collision_pass.geom leaves the geometry stage out"));
}

TEST_CASE("no false pass: a fragment stage's input that no stage writes is an error with its name") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.frag", "flat in vec3 out_Position;",
                "flat in vec3 v_Place;\n#define out_Position v_Place");
    CHECK_THAT(refusal(shaders), Catch::StartsWith("shader " + (shaders.path() / "collision_pass.frag").string() +
                                                   ":7: input v_Place is written by no stage before it ("));
}

TEST_CASE("no false pass: a fragment stage that writes no output 0 is an error") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    const std::string file = (shaders.path() / "collision_pass.frag").string();
    SECTION("nothing is written") {
        test::plant(shaders, "collision_pass.frag", "void main() { o_Texel = encode_position(out_Position); }",
                    "void main() {}");
        CHECK(refusal(shaders) == "shader " + file + ": no output at location 0 is written; that is what is drawn");
    }
    SECTION("another is") {
        test::plant(shaders, "collision_pass.frag", "precise out vec4 o_Texel;",
                    "layout(location = 1) out vec4 o_Texel;");
        CHECK(refusal(shaders) == "shader " + file + ": no output at location 0 is written; that is what is drawn");
    }
    SECTION("there is no fragment stage") {
        shaders.write("collision_pass.frag", " \n");
        CHECK(refusal(shaders) == "shader " + file + ": is empty; only a geometry stage can be left out");
    }
}

TEST_CASE("no false pass: an output named like a captured one that nobody captures is an error") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.geom", "out float out_Speed;", "out float out_Speed; out float out_Mass;");
    test::plant(shaders, "collision_pass.geom", "    EmitVertex();\n",
                "    out_Mass = v_Speed[0];\n    EmitVertex();\n");
    CHECK_THAT(refusal(shaders), Catch::Contains("collision_pass.geom:") &&
                                     Catch::Contains("output out_Mass is captured by nobody and compared with nothing; "
                                                     "what is compared is out_Position, out_Speed, out_Dir"));
    test::plant(shaders, "collision_pass.frag", "void main() { o_Texel = encode_position(out_Position); }",
                "flat in float out_Mass;\nvoid main() { o_Texel = encode_position(out_Position + 0.0 * out_Mass); }");
    CHECK_THAT(refusal(shaders), !Catch::Contains("captured by nobody"));
}

TEST_CASE("no false pass: the layered passes, too, are refused uniforms and attributes that nobody sets") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    Switches layered;
    layered.cdt_layers = 2;
    SECTION("uniform") {
        test::plant(shaders, "layered_collision_pass.vert", "uniform float u_Tick;",
                    "uniform float u_Tik;\n#define u_Tick u_Tik");
        CHECK_THAT(refusal(shaders, layered), Catch::Contains("nothing is given for uniform u_Tik"));
    }
    SECTION("sampler") {
        test::plant(shaders, "layered_cdt.vert", "uniform isampler2D u_KeyBefore;",
                    "uniform isampler2D u_KeyBefor;\n#define u_KeyBefore u_KeyBefor\n");
        CHECK_THAT(refusal(shaders, layered), Catch::Contains("nothing is given for uniform u_KeyBefor"));
    }
    SECTION("attribute") {
        test::plant(shaders, "layered_collision_pass.vert", "in float a_Speed;",
                    "in float a_Sped;\n#define a_Speed a_Sped");
        CHECK_THAT(refusal(shaders, layered), Catch::Contains("nothing is given for attribute a_Sped"));
    }
}

} // namespace lockstep::test::no_false_pass_test
