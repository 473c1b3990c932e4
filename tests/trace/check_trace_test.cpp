#include <catch2/catch.hpp>

#include <bit>
#include <cmath>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/collision/record/trace_side.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/state_hash.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/trace/small_trace.hpp"

namespace lockstep::test::check_trace_test {

using test::check_trace;
using test::record;
using test::small_info;

namespace {

constexpr int frames = 8;

float next_float(float x) { return std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) + 1U); }

} // namespace

TEST_CASE("check trace: what the reference computed agrees, with and without the CDT, in both modes") {
    const test::TemporaryFolder folder;
    for (const bool has_cdt : {true, false}) {
        const auto file = folder.path() / "run.h5";
        record(file, small_info(has_cdt), frames);
        for (const CheckMode mode : {CheckMode::resync, CheckMode::free}) {
            const CheckReport report = check_trace(file, mode);
            CHECK(report.verdict == Verdict::agree);
            CHECK(report.frames == frames);
            CHECK(report.hits > 0);
            CHECK(report.total[collision::position].compared == 60 * 3 * frames);
            CHECK(report.total[collision::texel].compared == (has_cdt ? 24 * 20 * 4 * frames : 0));
            CHECK(report.gpu_hash == report.reference_hash);
        }
    }
}

TEST_CASE("check trace: one unit in the last place in any field of any frame is found where it is") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5";
    for (const int field : {0, 1, 2, 3, 4}) {
        record(file, small_info(true), frames, [&](int frame, Particles& particles, CollisionImage& cdt) {
            if (frame != 5)
                return;
            float* const values[] = {&particles.position[7].y, &particles.direction[7].x, &particles.speed[7],
                                     &particles.collide_time[7], &cdt.texels[99].z};
            *values[field] = next_float(*values[field]);
        });
        const CheckReport report = check_trace(file);
        INFO("field " << field);
        CHECK(report.verdict == Verdict::divergent);
        CHECK(report.first_frame == 5);
        REQUIRE(!report.worst.empty());
        CHECK(report.worst.front().difference.index == (field == 4 ? 99U : 7U));
    }
}

TEST_CASE("check trace: without the CDT a changed particle is found, and no texel is spoken of") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5";
    record(file, small_info(false), frames, [](int frame, Particles& particles, CollisionImage&) {
        if (frame == 3)
            particles.position[11].x = next_float(particles.position[11].x); // drawn elsewhere, too
    });
    const CheckReport report = check_trace(file);
    CHECK(report.verdict == Verdict::divergent);
    CHECK(report.first_frame == 3);
    REQUIRE(report.verdicts);
    CHECK(report.verdicts->classes[0][3] >= 1);
    for (const std::uint64_t texels : report.verdicts->classes[1])
        CHECK(texels == 0);
    CHECK(check_trace(file, CheckMode::free).verdict == Verdict::differ);
}

TEST_CASE("check trace: a run of the octree and one with remedies can be recorded without a CDT too") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5";
    TraceInfo info = small_info(false);
    info.scene.switches.search = Search::octree;
    record(file, info, 4);
    CHECK(check_trace(file).verdict == Verdict::agree);
    info = small_info(false);
    info.scene.switches.cdt_layers = 2;
    info.scene.switches.response = Response::mutual;
    record(file, info, 4);
    CHECK(check_trace(file).verdict == Verdict::agree);
    info.has_cdt = true;
    record(file, info, 4);
    CHECK(check_trace(file).verdict == Verdict::agree);
}

TEST_CASE("check trace: a driver nobody measured is judged by GLSL's rules alone") {
    TraceInfo info = small_info(false);
    CHECK(known_operations(info).divide);
    info.profile.reset();
    CHECK(!known_operations(info).divide);
    CHECK(followed_profile(info).name == "strict");
    CHECK(notes_on(info).size() == 2);
}

TEST_CASE("check trace: beyond its last frame a trace has nothing to give") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5";
    record(file, small_info(false), 2);
    TraceReader trace(file);
    TraceSide recorded(trace);
    const FrameParams params = frame_params(trace.info().scene, 0);
    recorded.step(params);
    recorded.step(params);
    CHECK_THAT(test::error_of([&] { recorded.step(params); }), Catch::Contains("holds 2 frames, and no more"));
}

} // namespace lockstep::test::check_trace_test
