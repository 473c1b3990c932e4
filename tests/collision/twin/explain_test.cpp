#include <algorithm>
#include <optional>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "crosscheck/collision/judge/frame_run.hpp"
#include "crosscheck/collision/judge/step_table.hpp"
#include "crosscheck/collision/judge/texel_table.hpp"
#include "crosscheck/collision/report/explain_text.hpp"
#include "reference/model/same_bits.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/twin_scenes.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::explain_test {

namespace {

constexpr int frames = 10;

Scene busy_scene(std::string_view preset_name = "corrected") {
    Scene scene = test::crowded_scene(600, 61, 47);
    scene.switches = preset(preset_name);
    scene.constants.tick = 1.0F / 64.0F;
    scene.constants.collision_time = 3.0F / 64.0F;
    return scene;
}

FrameRun run_of(const Scene& scene, const std::filesystem::path& shaders = {}) {
    const Profile profile = test::llvmpipe_profile(shaders);
    return {scene, profile, measured_operations(profile), shaders};
}

/// The table of the first divergent particle, or of the first owner of the first divergent texel.
std::optional<StepTable> first_divergent(FrameRun& run) {
    const auto divergent = [](const std::vector<ItemVerdict>& verdicts) {
        return std::find_if(verdicts.begin(), verdicts.end(),
                            [](const ItemVerdict& v) { return v.kind == DifferenceClass::divergent; });
    };
    for (int frame = 0; frame < frames; ++frame) {
        run.go_to(frame);
        const FrameVerdicts& verdicts = run.verdicts();
        if (const auto found = divergent(verdicts.particles); found != verdicts.particles.end())
            return step_table(run, found->index);
        for (auto found = divergent(verdicts.texels); found != verdicts.texels.end(); ++found)
            for (const std::size_t particle : texel_table(run, found->index).particles)
                return step_table(run, particle);
    }
    return {};
}

} // namespace

TEST_CASE("explain: the trace build changes no output, and every row of a right shader is the reference's") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    for (const char* name : {"corrected", "paper", "exact"})
        for (const CdtFormat format : {CdtFormat::rgba32f, CdtFormat::rgba16f, CdtFormat::rgba8}) {
            CAPTURE(name, static_cast<int>(format));
            Scene scene = busy_scene(name);
            scene.cdt_box = {glm::vec3(-1.0F), glm::vec3(1.0F)};
            scene.switches.cdt_format = format;
            FrameRun run = run_of(scene);
            run.go_to(3);
            const JudgedFrame frame = run.judged();
            int hits = 0;
            for (std::size_t i = 0; i < frame.gpu.size(); i += 4) {
                CAPTURE(i);
                const StepCapture capture = run.capture(i);
                CHECK(same_bits(capture.state, frame.gpu[i]));
                REQUIRE(capture.vertex_state);
                CHECK(same_bits(*capture.vertex_state, frame.gpu[i]));
                hits += capture.vertex.integer("trace_hit").value_or(0);
                if (i % 20 != 0)
                    continue;
                const StepTable table = step_table(run, i);
                CHECK(table.warning.empty());
                for (const StepRow& row : table.rows) {
                    CAPTURE(row.label);
                    CHECK_FALSE(row.differs());
                }
            }
            CHECK(hits > 2);
        }
}

TEST_CASE("explain: outputs of a foreign shader are shown under their names") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.vert", "precise out vec3 v_Position;",
                "precise out vec3 v_Position;\nout vec2 trace_my_pair;\nflat out int trace_my_count[2];");
    test::plant(shaders, "collision_pass.vert", "    START_TRACE();\n",
                "    START_TRACE();\n    trace_my_pair = vec2(a_Speed, 0.5);\n"
                "    trace_my_count[0] = 7;\n    trace_my_count[1] = -8;\n");
    test::plant(shaders, "collision_pass.geom", "out float out_Speed;", "out float out_Speed;\nout float trace_late;");
    test::plant(shaders, "collision_pass.geom", "out_Speed = v_Speed[0];",
                "out_Speed = v_Speed[0];\n    trace_late = 2.5;");
    FrameRun run = run_of(busy_scene(), shaders.path());
    run.go_to(1);
    const StepTable table = step_table(run, 5);
    const auto gpu_of = [&](const std::string& label) {
        const auto row =
            std::find_if(table.rows.begin(), table.rows.end(), [&](const StepRow& r) { return r.label == label; });
        REQUIRE(row != table.rows.end());
        CHECK(row->verdict == RowVerdict::untold);
        return row->gpu;
    };
    CHECK(gpu_of("trace_my_pair.x").number == run.judged().before.speed[5]);
    CHECK(gpu_of("trace_my_pair.y").number == 0.5F);
    CHECK(gpu_of("trace_my_count.x").text == "7");
    CHECK(gpu_of("trace_my_count.y").text == "-8");
    CHECK(gpu_of("trace_late").number == 2.5F);
}

TEST_CASE("explain: a shader that traces nothing is judged by what it hands on") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.vert", "#ifdef LOCKSTEP_TRACE", "#ifdef NEVER");
    test::plant(shaders, "trace.glsl", "#ifdef LOCKSTEP_TRACE", "#ifdef NEVER");
    SECTION("right") {
        FrameRun run = run_of(busy_scene(), shaders.path());
        run.go_to(2);
        for (std::size_t i = 0; i < 100; ++i) {
            const StepTable table = step_table(run, i);
            CHECK(table.gpu.vertex.outputs.empty());
            CHECK(table.first_divergent() == nullptr);
        }
        CHECK_THAT(explain_particle(run, 1, NumberFormat::decimal), Catch::Contains("has no trace_* outputs"));
    }
    SECTION("wrong") {
        test::plant(shaders, "collision_pass.vert", "v_Dir = ls_normalize(temp);", "v_Dir = temp;");
        FrameRun run = run_of(busy_scene(), shaders.path());
        const auto table = first_divergent(run);
        REQUIRE(table);
        CHECK_THAT(table->first_divergent()->label, Catch::StartsWith("direction"));
    }
}

TEST_CASE("explain: a trace build that does something else is told") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.vert", "    v_Speed = ls_length(temp);\n",
                "    v_Speed = ls_length(temp);\n#ifdef LOCKSTEP_TRACE\n    v_Speed *= 2.0;\n#endif\n");
    FrameRun run = run_of(busy_scene(), shaders.path());
    run.go_to(0);
    CHECK_THAT(explain_particle(run, 1, NumberFormat::decimal), Catch::Contains("warning the trace build's outputs"));
}

TEST_CASE("explain: a texel tells who wanted it and who won it") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    FrameRun run = run_of(busy_scene());
    run.go_to(2);
    const JudgedFrame frame = run.judged();
    int contested = 0;
    for (std::size_t texel = 0; texel < frame.gpu_cdt.texels.size(); texel += 7) {
        const TexelTable table = texel_table(run, texel);
        for (const StepRow& row : table.rows) {
            CAPTURE(texel, row.label);
            CHECK_FALSE(row.differs());
        }
        const auto depths = std::count_if(table.rows.begin(), table.rows.end(), [](const StepRow& row) {
            return row.label.ends_with("'s depth") && row.label.starts_with("particle");
        });
        contested += depths > 1 ? 1 : 0;
        CHECK(table.particles.size() <= 1);
        const bool empty = frame.gpu_cdt.texels[texel].a == 0.0F;
        CHECK((!empty || table.particles.empty()));
    }
    CHECK(contested > 0);
}

TEST_CASE("explain: the picture shows both sides' picks") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.vert", "if (u_CollisionRange > len && len < particle_min_length)",
                "if (u_CollisionRange > len)");
    FrameRun run = run_of(busy_scene(), shaders.path());
    const auto table = first_divergent(run);
    REQUIRE(table);
    const std::string picture = neighbourhood_picture(run.judged(), *table);
    const std::string texels = picture.substr(0, picture.find("  . empty"));
    CHECK(std::count(texels.begin(), texels.end(), 'R') == 1);
    CHECK(std::count(texels.begin(), texels.end(), 'G') == 1);
    CHECK(std::count(texels.begin(), texels.end(), '[') == 1);
    CHECK(std::count(texels.begin(), texels.end(), '\n') == 4);
}

TEST_CASE("explain: more outputs than one draw can capture are captured by several") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    std::string declared, written;
    for (int i = 0; i < 8; ++i) {
        declared += fmt::format("out vec4 trace_more{};\n", i);
        written += fmt::format("    trace_more{0} = vec4({0}.0, 0.0, 0.0, {0}.5);\n", i);
    }
    test::plant(shaders, "collision_pass.vert", "precise out vec3 v_Position;",
                declared + "precise out vec3 v_Position;");
    test::plant(shaders, "collision_pass.vert", "    START_TRACE();\n", "    START_TRACE();\n" + written);
    FrameRun run = run_of(busy_scene(), shaders.path());
    run.go_to(1);
    const StepCapture capture = run.capture(3);
    for (int i = 0; i < 8; ++i) {
        const auto value = capture.vertex.vec4(fmt::format("trace_more{}", i));
        REQUIRE(value);
        CHECK(*value == glm::vec4(static_cast<float>(i), 0.0F, 0.0F, static_cast<float>(i) + 0.5F));
    }
    CHECK(capture.vertex.vec4("trace_clip").has_value());
    REQUIRE(capture.vertex_state);
    CHECK(same_bits(*capture.vertex_state, run.judged().gpu[3]));
    CHECK(capture.vertex.integer("trace_neighbour_count").value_or(-1) ==
          static_cast<int>(capture.neighbours.size()) * capture.vertex.integer("trace_searches").value_or(0));
}

TEST_CASE("explain: an output that cannot be captured is named") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.vert", "precise out vec3 v_Position;",
                "precise out vec3 v_Position;\nflat out double trace_long;");
    test::plant(shaders, "collision_pass.vert", "#version 330 core\n",
                "#version 330 core\n#extension GL_ARB_gpu_shader_fp64 : require\n");
    test::plant(shaders, "collision_pass.vert", "    START_TRACE();\n",
                "    START_TRACE();\n    trace_long = double(a_Speed);\n");
    FrameRun run = run_of(busy_scene(), shaders.path());
    run.go_to(1);
    CHECK_THROWS_WITH(run.capture(3), "trace build of collision_pass, vertex stage: output trace_long is double, which "
                                      "cannot be captured; scalars, vectors and matrices of float, int and uint can");
}

} // namespace lockstep::test::explain_test
