#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "reference/model/collision/collision_state.hpp"
#include "tests/collision/twin/compute_scenes.hpp"
#include "tests/collision/twin/told_causes.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::not_searching_twin_test {

namespace {

/// The crowd, two in three of whom search, and wait for ever after a hit.
Scene standing_scene(const char* base, NotSearching not_searching = NotSearching::stands) {
    Scene scene = test::crowded_scene(1200);
    scene.switches = preset(base);
    scene.switches.not_searching = not_searching;
    for (std::size_t i = 0; i < scene.start.size(); ++i)
        scene.start.collide_time[i] = i % 3 == 0 ? 0.01F : -0.01F;
    return scene;
}

constexpr const char* guard = "#if NOT_SEARCHING == NOT_SEARCHING_STANDS";

} // namespace

TEST_CASE("not searching twin: who stands has the same bits in either step and with either velocity") {
    const auto context = test::open_compute();
    if (!context)
        return;
    for (const std::string_view base : preset_names())
        for (const Step step : {Step::transform_feedback, Step::compute})
            for (const Velocity velocity : {Velocity::direction_and_speed, Velocity::vector}) {
                Scene scene = standing_scene(base.data());
                scene.switches.step = step;
                scene.switches.velocity = velocity;
                INFO(base << " " << static_cast<int>(step) << static_cast<int>(velocity));
                const CheckReport report = test::check_twins(scene, 30);
                CHECK(report.verdict == Verdict::agree);
                CHECK(report.total.differing(collision::particles) == 0);
                CHECK(report.total.differing(collision::cdt) == 0);
                CHECK(report.hits > 50);
            }
}

TEST_CASE("not searching twin: left to themselves in exact arithmetic, both sides stay together") {
    const auto context = test::open_compute();
    if (!context)
        return;
    for (const Step step : {Step::transform_feedback, Step::compute}) {
        Scene scene = standing_scene("exact");
        scene.switches.step = step;
        const CheckReport report = test::check_twins(scene, 60, {}, CheckMode::free);
        CHECK(report.verdict == Verdict::agree);
        CHECK(report.reference_hash == report.gpu_hash);
        CHECK(report.hits > 50);
    }
}

TEST_CASE("not searching twin: the other reading in a shader is found and named") {
    const auto context = test::open_compute();
    if (!context)
        return;
    for (const auto& [file, step] :
         {std::pair{"collision_pass.vert", Step::transform_feedback}, std::pair{"collision_pass.comp", Step::compute}})
        for (const auto& [not_searching, replacement, cause] :
             std::vector<std::tuple<NotSearching, std::string, std::string>>{
                 {NotSearching::stands, "#if 0", "moves_without_search"},
                 {NotSearching::moves, "#if 1", "stands_unless_it_searches"}}) {
            const test::TemporaryFolder shaders;
            test::plant(shaders, file, guard, replacement);
            Scene scene = standing_scene("corrected", not_searching);
            scene.switches.step = step;
            INFO(file << " " << cause);
            const CheckReport report = test::check_twins(scene, 6, shaders.path());
            CHECK(report.verdict == Verdict::divergent);
            CHECK_THAT(test::told_causes(report), Catch::VectorContains(cause));
        }
}

TEST_CASE("not searching twin: who searches without a hit and stands is not said never to collide") {
    const auto context = test::open_compute();
    if (!context)
        return;
    constexpr const char* step =
        "    if (ls_flush(a_CollideTime) < 0.0 && visible && nearest_collision(texel_base, away))\n"
        "        collide(away);\n    else\n        integrate();\n";
    const auto told = [&](const std::string& replacement) {
        const test::TemporaryFolder shaders;
        test::plant(shaders, "collision_pass.vert", step, replacement);
        const CheckReport report = test::check_twins(standing_scene("corrected"), 6, shaders.path());
        CHECK(report.verdict == Verdict::divergent);
        return test::told_causes(report);
    };
    const std::vector<std::string> stands = told("    if (visible && nearest_collision(texel_base, away))\n        "
                                                 "collide(away);\n    else\n        stand();\n");
    CHECK(stands == std::vector<std::string>{"no_fall_after_missed_search"});
    CHECK_THAT(told("    integrate();\n"), Catch::VectorContains(std::string("never_collides")));
}

} // namespace lockstep::test::not_searching_twin_test
