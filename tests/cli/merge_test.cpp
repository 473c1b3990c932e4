#include <catch2/catch.hpp>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::merge_test {

using Catch::Contains;
using test::joined;
using test::refusal;
using test::run_lockstep;

namespace {

constexpr int frames = 12;

std::string content(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// A recording, and parts of its check.
struct Setting {
    test::SceneSetting scene{"record"};
    std::filesystem::path folder = scene.folder.path();
    std::string recording = (folder / "run.h5").string();

    void record(const std::vector<std::string>& options = {}) const {
        REQUIRE(run_lockstep(scene.command(joined({"-o", recording, "--frames", std::to_string(frames)}, options)))
                    .status == 0);
    }
    /// Plants a bug by which many particles diverge in most frames.
    void plant_speed() const {
        test::plant(scene.shaders, "collision_pass.vert", "v_Speed = product(a_Speed, u_SpeedFactor);",
                    "v_Speed = product(a_Speed, 0.5);");
    }
    [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }
    [[nodiscard]] test::Outcome check(const std::vector<std::string>& options,
                                      const test::Surroundings& surroundings = {}) const {
        return run_lockstep(joined({"check", "--trace", recording}, options), surroundings);
    }
    /// Gives the part's file.
    [[nodiscard]] std::string part(const std::string& which, const std::string& value,
                                   const std::vector<std::string>& options = {}) const {
        std::string file = path("part_" + value + ".json");
        std::replace(file.begin() + static_cast<std::ptrdiff_t>(folder.string().size()) + 1, file.end(), '/', '_');
        const test::Outcome outcome = check(joined({which, value, "--json", file}, options));
        CHECK(outcome.status < 2);
        CHECK_THAT(outcome.out, Contains("note      part of a run: frames "));
        return file;
    }
    [[nodiscard]] std::vector<std::string> shards(int count, const std::vector<std::string>& options = {}) const {
        std::vector<std::string> files;
        for (int k = 1; k <= count; ++k)
            files.push_back(part("--shard", std::to_string(k) + "/" + std::to_string(count), options));
        return files;
    }
    /// A report but for its last line, the names of files.
    static std::string without_written(const std::string& report) {
        const std::size_t end = report.find("\nwritten   ");
        CHECK(end != std::string::npos);
        return report.substr(0, end);
    }

    /// Holds the merged parts against one check of all frames; gives the report.
    std::string expect_whole(const std::vector<std::string>& parts,
                             const std::vector<std::string>& options = {}) const {
        const test::Outcome whole =
            check(joined({"--json", path("whole.json"), "--junit", path("whole.xml")}, options));
        const test::Outcome merged = run_lockstep(
            joined(joined({"merge"}, parts), {"--json", path("merged.json"), "--junit", path("merged.xml")}));
        CHECK(merged.status == whole.status);
        CHECK(merged.err == whole.err);
        CHECK(without_written(merged.out) == without_written(whole.out));
        CHECK(content(path("merged.json")) == content(path("whole.json")));
        CHECK(content(path("merged.xml")) == content(path("whole.xml")));
        return merged.out;
    }
};

} // namespace

TEST_CASE("merge: the parts of a run that agrees come to the report of one check, byte for byte") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    for (const std::vector<std::string>& options : {std::vector<std::string>{}, {"--cdt"}}) {
        setting.record(options);
        for (const int count : {1, 5, frames})
            CHECK_THAT(setting.expect_whole(setting.shards(count)),
                       Contains("AGREE: every bit of 300 particles") && !Contains("part of a run"));
    }
    CHECK_THAT(setting.expect_whole(setting.shards(3, {"--frames", "7"}), {"--frames", "7"}),
               Contains("note      7 of the 12 frames recorded were compared"));
}

TEST_CASE("merge: what diverges in several parts has the cause, the first item and the hint of one check") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    setting.plant_speed();
    setting.record({"--cdt"});
    CHECK_THAT(setting.expect_whole(setting.shards(4)), Contains("DIVERGENT") && Contains("are explained by"));
    CHECK_THAT(setting.expect_whole(setting.shards(2, {"--legal", "glsl"}), {"--legal", "glsl"}),
               Contains("DIVERGENT") && Contains("--legal glsl"));
}

TEST_CASE("merge: other searches have parts, too, and one in which no mistake was tried") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    for (const char* search : {"search=octree", "search=depth"}) {
        setting.record({"--set", search, "--cdt"});
        CHECK_THAT(setting.expect_whole(setting.shards(6)), Contains("verdict   AGREE"));
    }
}

TEST_CASE("merge: parts may be ranges of any length, and come in any order") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    setting.plant_speed();
    setting.record();
    setting.expect_whole({setting.part("--frames", "9..11"), setting.part("--frames", "0..0"),
                          setting.part("--frames", "2..8"), setting.part("--frames", "1..1")});
    CHECK_THAT(refusal(setting.check({"--frames", "3..12"})), Contains("holds 12 frames, 0 to 11"));
    for (const char* range : {"5..3", "-1..3", "..3", "3..", "1..2..3", "a..b", "3...5", "0..100000001"})
        CHECK_THAT(refusal(setting.check({"--frames", range})), Contains("is no range of frames"));
    for (const char* number : {"0", "1.5", "-3", ""})
        CHECK_THAT(refusal(setting.check({"--frames", number})), Contains("is not an integer from 1 to"));
}

TEST_CASE("merge: a recording that lies elsewhere now is named, and no other is taken for it") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    setting.plant_speed();
    setting.record();
    const std::vector<std::string> parts = setting.shards(2);
    const std::string whole = setting.check({}).out, moved = setting.path("moved.h5");
    std::filesystem::rename(setting.recording, moved);
    CHECK_THAT(refusal(run_lockstep(joined({"merge"}, parts))), Contains("right is --trace FILE"));
    CHECK(run_lockstep(joined({"merge", "--trace", moved}, parts)).out == whole);
    setting.record({"--set", "tick=0.02"});
    CHECK_THAT(refusal(run_lockstep(joined({"merge"}, parts))), Contains("not the recording that the parts are of"));
}

TEST_CASE("merge: parts that are missing, there twice, or of another run are refused, and nothing is written") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    setting.record();
    const std::vector<std::string> parts = setting.shards(3);
    const std::string output = setting.path("out.json");
    const auto refused = [&](const std::vector<std::string>& some, const std::string& why) {
        CHECK_THAT(refusal(run_lockstep(joined({"merge", "--json", output, "--junit", setting.path("out.xml")}, some))),
                   Contains(why));
        CHECK(!std::filesystem::exists(output));
        CHECK(!std::filesystem::exists(setting.path("out.xml")));
    };
    refused({parts[0], parts[2]}, "frames 4 to 7 of 12, of " + setting.recording + ": in no part");
    refused({parts[1], parts[2]}, "frames 0 to 3 of 12");
    refused({parts[0], parts[1]}, "frames 8 to 11 of 12");
    refused({parts[0], parts[1], parts[2], parts[1]}, "frames 4 to 7 are in");
    refused(joined(parts, {setting.part("--frames", "7..7")}), "frame 7 are in");
    refused(joined({parts[0], parts[1]}, {setting.part("--frames", "8..11", {"--legal", "glsl"})}),
            "judged with --legal glsl, there without options of its own");
    refused(joined({parts[0], parts[1]}, {setting.part("--frames", "8..11", {"--require-hits"})}), "--require-hits");
    refused({parts[0], parts[1], setting.part("--shard", "2/2", {"--frames", "11"})},
            "11 frames are shared out, there 12");
    refused({setting.path("none.json")}, "cannot be read");
    refused({setting.scene.scene}, "holds no part of a run");
    REQUIRE(setting.check({"--json", setting.path("whole.json")}).status == 0);
    refused({setting.path("whole.json")}, "holds no part of a run");
    refused({setting.path("part.xml")}, "right is the part's JSON");
    for (const std::string& input : {parts[0], setting.recording})
        CHECK_THAT(refusal(run_lockstep(joined({"merge", "--json", input}, parts))), Contains(input));
    const std::string last = parts[2], kept = content(last);
    setting.record({"--set", "tick=0.02"});
    refused({parts[0], parts[1], setting.part("--frames", "8..11")}, "recording ");

    nlohmann::json older = nlohmann::json::parse(kept);
    older["part"]["program"] = "lockstep 0.0.9";
    std::ofstream(last) << older;
    refused(parts, "was written by 'lockstep 0.0.9'");
    CHECK_THAT(refusal(run_lockstep({"merge"})), Contains("PART is missing: "));
}

TEST_CASE("merge: parts of --stress join only where every input was the same") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder, shaders;
    const auto path = [&](const char* name) { return (folder.path() / name).string(); };
    const auto part = [&](const char* which, const char* name, const std::vector<std::string>& options = {}) {
        CHECK(run_lockstep(joined({"check", "--stress", "--frames", "3", "--gl", test::software_gl(), "--shard", which,
                                   "--json", path(name), "--quiet"},
                                  options))
                  .status == 0);
        return path(name);
    };
    const auto whole = [](const std::vector<std::string>& parts) { return run_lockstep(joined({"merge"}, parts)); };
    const std::vector<std::string> own{"--shaders", shaders.path().string()};
    test::plant(shaders, "collision_pass.vert", "void main() {", "// Mine.\nvoid main() {");
    const std::string first = part("1/2", "first.json", own), second = part("2/2", "second.json", own);
    CHECK(whole({first, second}).status == 0);

    const std::string vertex = (shaders.path() / "collision_pass.vert").string();
    SECTION("another text of a shader") {
        test::plant(shaders, "collision_pass.vert", "// Mine.", "// Mine, later.");
        CHECK_THAT(refusal(whole({first, part("2/2", "later.json", own)})),
                   Contains("later.json: not of the same run as ") && Contains(vertex + " is ") &&
                       Contains("..., there it is "));
    }
    SECTION("a file more beside it, or one that it includes") {
        shaders.write("collision_pass.geom", content("shaders/collision/collision_pass.geom"));
        CHECK_THAT(refusal(whole({first, part("2/2", "later.json", own)})),
                   Contains("collision_pass.geom is ") && Contains("..., there it is absent"));
        std::filesystem::remove(shaders.path() / "collision_pass.geom");
        shaders.write("clip_volume.glsl", content("shaders/collision/clip_volume.glsl"));
        CHECK_THAT(refusal(whole({first, part("2/2", "later.json", own)})), Contains("clip_volume.glsl is "));
    }
    SECTION("a file bindings.json") {
        shaders.write("bindings.json", "{}");
        CHECK_THAT(refusal(whole({first, part("2/2", "later.json", own)})), Contains("bindings.json is "));
    }
    SECTION("another profile, in a part that was forged") {
        nlohmann::json forged = nlohmann::json::parse(content(second));
        forged["part"]["stress"]["profile"] = "{}";
        std::ofstream(second) << forged;
        CHECK_THAT(refusal(whole({first, second})), Contains("second.json: was changed after lockstep wrote it"));
    }
}

TEST_CASE("merge: parts that are cut off or forged are refused in one line") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    setting.plant_speed();
    setting.record();
    const std::vector<std::string> parts = setting.shards(2);
    const std::string good = content(parts[1]);
    const auto refused = [&](const std::string& text) {
        std::ofstream(parts[1], std::ios::trunc) << text;
        CAPTURE(text.substr(0, 200));
        refusal(run_lockstep(joined({"merge", "--json", setting.path("out.json")}, parts)));
        CHECK(!std::filesystem::exists(setting.path("out.json")));
    };
    for (std::size_t i = 0; i < 8; ++i)
        refused(good.substr(0, i * good.size() / 8));
    const nlohmann::json whole = nlohmann::json::parse(good);
    const auto forge = [&](const char* place, const nlohmann::json& value) {
        nlohmann::json forged = whole;
        forged[nlohmann::json::json_pointer(std::string("/part") + place)] = value;
        refused(forged.dump());
    };
    forge("", 3);
    forge("/version", 1);
    forge("/of", 0);
    forge("/report", nlohmann::json::object());
    forge("/report/first", -1);
    forge("/report/frames", 1'000'000'000);
    forge("/report/frames_asked", 1);
    forge("/report/particles", 299);
    forge("/report/first_frame", nullptr);
    forge("/report/total/0/extent", {0, 1, 1});
    forge("/report/total/0/differing", -1);
    forge("/report/total", nlohmann::json::array());
    forge("/report/worst/0/1/0", 7);
    forge("/report/worst/0/1/3", 3);
    forge("/report/verdicts/first", nullptr);
    forge("/report/verdicts/divergent_frames", nlohmann::json::array());
    forge("/report/verdicts/divergent_frames", {7, 3});
    forge("/report/verdicts/divergent_frames", {100});
    forge("/report/verdicts/classes", {{0, 0, 0, 0}, {0, 0, 0, 0}});
    forge("/report/verdicts/ties_beyond_rounding", 3);
    forge("/report/verdicts/leans", {{0, 127}});
    forge("/report/power/mistakes", nlohmann::json::array());
    forge("/report/power/mistakes/0/name", "other");
    forge("/request/legal", 9);
    forge("/request/power_at_least", "2");
    forge("/run/width", 0);
    forge("/more", 1);
    forge("/report/hashes/0", "0000000000000000");
    const nlohmann::json beside{{"verdict", "AGREE"}, {"differing_particles", 1}, {"more", 1}};
    for (const auto& [place, value] : beside.items()) {
        nlohmann::json forged = whole; // what stands beside the part
        forged[place] = value;
        refused(forged.dump());
    }
    std::string deep;
    for (int i = 0; i < 100'000; ++i)
        deep += '[';
    refused(deep);
}

TEST_CASE("check: a shard is one of N that there are, and none is empty") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    setting.record();
    for (const char* shard : {"0/0", "5/4", "0/4", "1", "1/", "/4", "a/b", "1/4/2", "-1/4", "1/-4", " 1/4", "1.0/4",
                              "99999999999999999999/4", ""})
        CHECK_THAT(refusal(setting.check({"--shard", shard})), Contains("is no part; right is K/N with K from 1 to N"));
    CHECK_THAT(refusal(setting.check({"--shard", "3/13"})),
               Contains("--shard 3/13: 12 frames make 12 parts at most, and none may be empty"));
    CHECK_THAT(refusal(setting.check({"--shard", "1/2", "--frames", "0..3"})),
               Contains("does not go with --frames 0..3"));
    for (const std::vector<std::string>& part : {std::vector<std::string>{"--shard", "1/2"}, {"--frames", "3..4"}})
        CHECK_THAT(refusal(setting.check(joined({"--mode", "free"}, part))),
                   Contains("with --mode free a frame follows from all before it"));
    CHECK_THAT(refusal(setting.check({"--shard", "1/2", "--report", setting.path("page")})),
               Contains("--report shows a whole run"));
    CHECK(!std::filesystem::exists(setting.path("page")));
    test::SceneSetting live("check");
    CHECK_THAT(refusal(run_lockstep(live.command({"--shard", "1/2"}))),
               Contains("shares out the frames of a recording"));
}

TEST_CASE("check: a shard may be asked for by the environment, of which half is refused") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    setting.record();
    using Variables = std::vector<std::pair<std::string, std::string>>;
    const auto part = [&](const Variables& variables, const std::vector<std::string>& options = {}) {
        return setting.check(options, {.environment = variables});
    };
    const Variables test{{"TEST_SHARD_INDEX", "1"}, {"TEST_TOTAL_SHARDS", "3"}},
        mpi{{"OMPI_COMM_WORLD_RANK", "0"}, {"OMPI_COMM_WORLD_SIZE", "2"}};
    CHECK_THAT(part(test).out, Contains("frames 4 to 7 of 12, by TEST_SHARD_INDEX=1 of TEST_TOTAL_SHARDS=3"));
    CHECK_THAT(part(test).out, Contains("verdict   AGREE (part: frames 4 to 7 of 12, by TEST_SHARD_INDEX=1 of "
                                        "TEST_TOTAL_SHARDS=3)"));
    CHECK_THAT(part(mpi).out, Contains("frames 0 to 5 of 12, by OMPI_COMM_WORLD_RANK=0"));
    CHECK_THAT(part({test[0], test[1], mpi[0], mpi[1]}).out, Contains("frames 4 to 7 of 12"));
    CHECK_THAT(part(test, {"--shard", "1/12"}).out, Contains("frames 0 to 0 of 12, by --shard 1/12"));
    CHECK_THAT(part(test, {"--frames", "2..3"}).out, Contains("frames 2 to 3 of 12; lockstep"));
    for (const Variables& wrong : {Variables{test[0]},
                                   {test[1]},
                                   {mpi[0]},
                                   {{"TEST_SHARD_INDEX", "3"}, {"TEST_TOTAL_SHARDS", "3"}},
                                   {{"TEST_SHARD_INDEX", "0"}, {"TEST_TOTAL_SHARDS", "0"}},
                                   {{"TEST_SHARD_INDEX", "one"}, {"TEST_TOTAL_SHARDS", "3"}},
                                   {{"TEST_SHARD_INDEX", ""}, {"TEST_TOTAL_SHARDS", "3"}},
                                   {{"TEST_SHARD_INDEX", "-1"}, {"TEST_TOTAL_SHARDS", "3"}}})
        CHECK_THAT(refusal(part(wrong)), Contains("the environment: "));
    CHECK_THAT(refusal(part(test, {"--mode", "free"})), Contains("TEST_SHARD_INDEX=1"));
    CHECK_THAT(refusal(part({{"TEST_SHARD_INDEX", "12"}, {"TEST_TOTAL_SHARDS", "13"}})), Contains("none may be empty"));
}

TEST_CASE("merge: what is asked of a run as a whole no part has to have") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    setting.record();
    const std::vector<std::string> rules{"--require-hits", "--power-at-least", "99%"};
    for (const std::string& file : setting.shards(frames, rules))
        CHECK(nlohmann::json::parse(content(file)).at("verdict") == "AGREE");
    CHECK(setting.check(joined({"--shard", "1/12"}, rules)).status == 0);
    CHECK_THAT(setting.expect_whole(setting.shards(2, rules), rules), Contains("expected at least 99 %"));
    CHECK(run_lockstep(joined({"merge", "--quiet"}, setting.shards(2, rules))).status == 1);
}

TEST_CASE("check: of a run here, too, some frames are judged alone") {
    if (!test::have_software_gl())
        return;
    test::SceneSetting live("check");
    test::plant(live.shaders, "collision_pass.vert", "v_Speed = product(a_Speed, u_SpeedFactor);",
                "v_Speed = product(a_Speed, 0.5);");
    const auto counts = [&](const std::string& range, int from) {
        const std::string file = (live.folder.path() / "report.json").string();
        CHECK(run_lockstep(live.command({"--frames", range, "--json", file})).status == 1);
        const nlohmann::json report = nlohmann::json::parse(content(file));
        nlohmann::json late = nlohmann::json::array();
        for (const nlohmann::json& row : report.at("counts").at("rows"))
            if (row.at(0).get<int>() >= from)
                late.push_back(row);
        return std::pair(late, report.at("hash"));
    };
    const auto whole = counts("10", 6);
    CHECK(!whole.first.empty());
    CHECK(counts("6..9", 0) == whole);
    CHECK_THAT(refusal(run_lockstep(live.command({"--frames", "6..9", "--mode", "free"}))), Contains("--mode free"));
}

} // namespace lockstep::test::merge_test
