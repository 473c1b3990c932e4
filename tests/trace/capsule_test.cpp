#include <catch2/catch.hpp>

#include <memory>

#include "crosscheck/collision/judge/frame_run.hpp"
#include "crosscheck/collision/record/capsule_json.hpp"
#include "crosscheck/collision/record/trace_side.hpp"
#include "crosscheck/record/root_offsets.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/trace/small_trace.hpp"

namespace lockstep::test::capsule_test {

using Catch::Contains;

namespace {

constexpr int frames = 8;

/// Particle `particle`'s step in frame `frame` of a recorded run.
Capsule cut(const TraceInfo& info, int frame, std::size_t particle, const test::Edit& edit = {}) {
    const test::TemporaryFolder folder;
    test::record(folder.path() / "run.h5", info, frames, edit);
    TraceReader trace(folder.path() / "run.h5");
    TraceSide recorded(trace);
    FrameRun run(trace.info().scene, followed_profile(trace.info()), known_operations(trace.info()), recorded);
    run.go_to(frame);
    return cut_capsule(run.judged(),
                       {run.scene(), "a renderer", "the scene's", frame, particle, run.capture(particle)});
}

nlohmann::json json_of(const Capsule& capsule) { return nlohmann::json::parse(capsule_file(capsule)); }

Capsule read(const nlohmann::json& json) { return read_capsule(JsonValue(json, "capsule.json")); }

std::string refusal(const nlohmann::json& json) {
    return test::error_of([&] { read(json); });
}

std::string text(const Capsule& capsule) { return capsule_text(capsule, NumberFormat::hexadecimal); }

} // namespace

TEST_CASE("capsule: every particle's comes back with the same text and verdict") {
    const TraceInfo info = test::small_info(true);
    for (const std::size_t particle : {0U, 7U, 31U, 59U}) {
        const Capsule capsule = cut(info, 6, particle);
        const Capsule back = read(json_of(capsule));
        CHECK(text(back) == text(capsule));
        CHECK(!judge(back).differs);
        CHECK_THAT(text(back), Contains("particle " + std::to_string(particle) + " in frame 6: every bit agrees"));
    }
}

TEST_CASE("capsule: a state that was changed is divergent in it, and named") {
    const Capsule capsule = cut(test::small_info(true), 3, 7, [](int frame, Particles& particles, CollisionImage&) {
        if (frame == 3)
            particles.speed[7] *= 1.5F;
    });
    const CapsuleVerdict verdict = judge(read(json_of(capsule)));
    CHECK(verdict.differs);
    CHECK(verdict.verdict.kind == DifferenceClass::divergent);
    CHECK_THAT(text(capsule), Contains("particle 7 in frame 3: divergent") && Contains("step speed"));
}

TEST_CASE("capsule: of the driver's tables it keeps what the verdict looks up, and no more") {
    TraceInfo info = test::small_info(false);
    info.profile = named_profile("nvidia");
    RootOffsets offsets{std::vector<std::int8_t>(reciprocal_count, 1),
                        std::vector<std::int8_t>(inverse_sqrt_count, -1)};
    info.profile->roots = std::make_shared<const RootTables>(root_tables(offsets));
    const Capsule capsule = cut(info, 5, 11);
    const std::string file = capsule_file(capsule);
    CHECK(file.size() < 20'000);
    const Capsule back = read(nlohmann::json::parse(file));
    CHECK(text(back) == text(capsule));
    REQUIRE(back.profile.roots);
    CHECK(back.profile.roots->reciprocal[3] != back.profile.roots->reciprocal[3]);
    CHECK(!judge(back).differs);
}

TEST_CASE("capsule: NaN, infinities and -0 in a state keep their bits") {
    const Capsule capsule = cut(test::small_info(true), 3, 7, [](int frame, Particles& particles, CollisionImage&) {
        if (frame == 2)
            particles.set(7, {{NAN, -0.0F, INFINITY}, {0, 1e-40F, 1}, 0.0F, -1.0F});
    });
    const Capsule back = read(json_of(capsule));
    CHECK(std::signbit(back.before.position.y));
    CHECK(back.before.position.x != back.before.position.x);
    CHECK(back.before.direction.y == 1e-40F);
    CHECK(text(back) == text(capsule));
}

TEST_CASE("capsule: what is wrong in one is named by its key") {
    const nlohmann::json good = json_of(cut(test::small_info(true), 3, 7));
    CHECK(refusal(good).empty());
    const auto with = [&](const char* pointer, const nlohmann::json& value) {
        nlohmann::json json = good;
        json[nlohmann::json::json_pointer(pointer)] = value;
        return refusal(json);
    };
    CHECK_THAT(refusal("x"), Contains("capsule.json: /: \"x\" is not an object"));
    CHECK_THAT(with("/lockstep_capsule", 2), Contains("/lockstep_capsule: 2 is not an integer from 1 to 1"));
    CHECK_THAT(with("/more", 2), Contains("unknown key \"more\""));
    CHECK_THAT(with("/before/speed", 1.5), Contains("/before/speed: 1.5 is not a text"));
    CHECK_THAT(with("/before/speed", "3f80000"), Contains("/before/speed: not groups of eight hexadecimal digits"));
    CHECK_THAT(with("/before/speed", "3f800000 3f800000"), Contains("2 groups of eight hexadecimal digits, to be 1"));
    CHECK_THAT(with("/gpu/position", "3f800000,3f800000,3f800000"), Contains("not groups of eight"));
    CHECK_THAT(with("/known", {"cosine"}), Contains("/known/0: \"cosine\" is not one of sums, divide"));
    CHECK_THAT(with("/cdt", {{24, 0, "0 0 0 0"}}), Contains("/cdt/0/0: 24 is not an integer from 0 to 23"));
    CHECK_THAT(with("/cdt", {{1, 2}}), Contains("/cdt/0: not [x, y, code]"));
    CHECK_THAT(with("/frame", -1), Contains("/frame"));
    CHECK_THAT(with("/entries", {"3f800000"}), Contains("/entries/0: 1 groups of eight hexadecimal digits, to be 3"));
    CHECK_THAT(with("/profile/dot", 1), Contains("/profile/dot"));
    CHECK_THAT(with("/roots", {{"reciprocal", {{1}}}, {"inverse_sqrt", nlohmann::json::array()}}),
               Contains("/roots/reciprocal/0: not [index, value]"));
    CHECK_THAT(with("/capture/texel", {1, -1}), Contains("/capture/texel: neither a texel nor [-1, -1]"));
    CHECK_THAT(with("/capture/texel", {1}), Contains("/capture/texel: not [x, y]"));
    CHECK_THAT(with("/capture/vertex", {{"trace_clip", "vec4", 1, "00000000"}}),
               Contains("fewer values than vec4 has"));
    CHECK_THAT(with("/capture/vertex", {{"trace_clip"}}), Contains("not [name, type, 1 for floats, words]"));
}

TEST_CASE("capsule: only of particles that there are") {
    const TraceInfo info = test::small_info(true);
    const test::TemporaryFolder folder;
    test::record(folder.path() / "run.h5", info, 2);
    TraceReader trace(folder.path() / "run.h5");
    TraceSide recorded(trace);
    FrameRun run(info.scene, followed_profile(info), known_operations(info), recorded);
    run.go_to(1);
    CHECK_THAT(test::error_of([&] {
                   cut_capsule(run.judged(), {info.scene, "", "", 1, 60, {}});
               }),
               Contains("particle 60: there are 60, counted from 0"));
}

TEST_CASE("capsule: more texels than 100 kB hold are refused") {
    Capsule capsule = cut(test::small_info(true), 3, 7);
    capsule.scene.width = capsule.scene.height = 100;
    capsule.cdt = CollisionImage(100, 100, glm::vec4(0.5F));
    CHECK_THAT(test::error_of([&] { capsule_file(capsule); }),
               Contains("particle 7 in frame 3: its capsule would be ") && Contains("right is at most 100000"));
}

} // namespace lockstep::test::capsule_test
