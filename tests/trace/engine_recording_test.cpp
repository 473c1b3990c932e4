#include <catch2/catch.hpp>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/collision/record/trace_side.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/trace/small_trace.hpp"

namespace lockstep::test::engine_recording_test {

using Catch::Contains;

namespace {

/// What data/examples/engine.cpp records of itself, with a bug of its own.
class EngineRecording {
  public:
    explicit EngineRecording(const std::string& bug = "") {
        REQUIRE(std::system((LOCKSTEP_EXAMPLE_ENGINE " " + file_.string() + " " + bug).c_str()) == 0);
    }

    /// Texts of the same length.
    EngineRecording& replace(const std::string& text, const std::string& other) {
        test::tamper(file_, [&](std::string& bytes) {
            REQUIRE(text.size() == other.size());
            REQUIRE(bytes.find(text) != std::string::npos);
            bytes.replace(bytes.find(text), text.size(), other);
        });
        return *this;
    }

    [[nodiscard]] TraceInfo info() const { return TraceReader(file_).info(); }

    [[nodiscard]] CheckReport check(CheckMode mode = CheckMode::resync) const { return test::check_trace(file_, mode); }

  private:
    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "run.h5";
};

std::string bytes_of(std::int32_t first, std::int32_t second) {
    std::string bytes(8, '\0');
    std::memcpy(bytes.data(), &first, 4);
    std::memcpy(bytes.data() + 4, &second, 4);
    return bytes;
}

/// The name of the best cause, if it explains all.
std::string cause_of(const CheckReport& report, std::size_t resource) {
    if (!report.verdicts || !report.verdicts->causes[resource].explains_all())
        return "";
    return report.verdicts->causes[resource].best.front().name();
}

} // namespace

TEST_CASE(
    "engine recording: reversed depth, rows downwards, a matrix and a tick a frame, velocities: every bit agrees") {
    const EngineRecording recording;
    const TraceInfo info = recording.info();
    CHECK(info.warnings == std::vector<std::string>{});
    CHECK(info.has_cdt);
    CHECK(info.counts.front() == 2000);
    CHECK(info.counts.back() == 3000);
    CHECK(info.scene.switches.velocity == Velocity::vector);
    CHECK(info.scene.clip_space == ClipSpace{1.0F, {1.0F, 0.0F}});
    CHECK(info.scene.frames.size() == 36);
    CHECK(frame_params(info.scene, 3).constants.tick == 1.0F / 60.0F);
    CHECK(frame_params(info.scene, 4).constants.tick == 1.0F / 30.0F);
    CHECK(frame_params(info.scene, 30).collision_proj_view[3].w == 1.0F); // no perspective

    const CheckReport report = recording.check();
    CHECK(report.verdict == Verdict::agree);
    CHECK(report.total.agree());
    CHECK(report.frames == 36);
    CHECK(report.particles == 3000);
    CHECK(report.hits > 500);
    CHECK(report.untried.empty());
}

TEST_CASE("engine recording: a bug in the engine is named") {
    struct Planted {
        const char* bug;
        std::size_t resource;
        const char* cause;
    };
    for (const Planted& planted : {Planted{"late_matrix", collision::particles, "matrix_of_earlier_frame"},
                                   Planted{"upside_down", collision::particles, "y_flipped"},
                                   Planted{"last_neighbour", collision::particles, "last_found_instead_of_nearest"},
                                   Planted{"depth_not_reversed", collision::cdt, "point_depth_reversed"}}) {
        INFO(planted.bug);
        const CheckReport report = EngineRecording(planted.bug).check();
        CHECK(report.verdict == Verdict::divergent);
        CHECK(cause_of(report, planted.resource) == planted.cause);
    }
}

TEST_CASE("engine recording: what it says of its clip space is believed, and shows") {
    EngineRecording upwards, forwards, other_tick;
    CHECK(upwards.replace("\"first_row\": 1", "\"first_row\":-1").check().verdict == Verdict::divergent);
    CHECK(forwards.replace("[1, 0]", "[0, 1]").check().verdict == Verdict::divergent);
    CHECK(other_tick.replace("0.0333333351", "0.0333333313").check().verdict == Verdict::divergent);
}

TEST_CASE("engine recording: what does not fit is refused by its place") {
    const auto refusal = [](const std::string& text, const std::string& other) {
        EngineRecording recording;
        recording.replace(text, other);
        return test::error_of([&] { static_cast<void>(recording.info()); });
    };
    CHECK_THAT(refusal("[1, 0]", "[2, 0]"),
               Contains("/clip_space/depth: [2, 0]; right is z / w at the near and at the far plane"));
    CHECK_THAT(refusal("\"first_row\": 1", "\"first_row\": 0"),
               Contains("/clip_space/first_row: 0; right is y / w at the image's first row in memory"));
    CHECK_THAT(refusal("\"proj_view\"", "\"proj-view\""), Contains("/frames/0") && Contains("proj_view"));
    CHECK_THAT(refusal("[1.33333337, 0, ", "[ 1.33333337,   "),
               Contains("/frames/0/proj_view: 15 elements; right is 16 numbers"));
    CHECK_THAT(refusal("\"tick\": 0.0166", "\"tick\":-0.0166"), Contains("/frames/0/constants/tick"));
}

TEST_CASE("engine recording: particles that are not there yet are not compared, and those that are, are") {
    EngineRecording one_more, too_many, whole;
    const CheckReport report = one_more.replace(bytes_of(2000, 2040), bytes_of(2000, 2041)).check();
    CHECK(report.verdict == Verdict::divergent);
    CHECK(report.first_frame == 1);
    too_many.replace(bytes_of(2000, 2040), bytes_of(2000, 3001));
    CHECK_THAT(test::error_of([&] { static_cast<void>(too_many.info()); }),
               Contains("observables/count/value: frame 1: 3001; right is 0 to 3000, the particles"));
    CHECK_THAT(test::error_of([&] { static_cast<void>(whole.check(CheckMode::free)); }),
               Contains("frame 0 has 2000 of 3000 particles; --mode free needs all in every frame"));
}

} // namespace lockstep::test::engine_recording_test
