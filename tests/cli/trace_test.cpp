#include <catch2/catch.hpp>

#include <chrono>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::trace_test {

using Catch::Contains;
using test::refusal;
using test::run_lockstep;

namespace {

struct Setting {
    test::TemporaryFolder folder;
    test::TemporaryFolder shaders;
    std::string scene = folder.write("scene.json", test::small_scene).string();
    std::string file = (folder.path() / "run.h5").string();

    [[nodiscard]] test::Outcome record(const std::vector<std::string>& options = {}) const {
        return run_lockstep(
            test::joined(test::joined({"record", scene, "--gl", test::software_gl(), "-o", file, "--frames", "6"},
                                      test::shader_options(shaders)),
                         options));
    }
    [[nodiscard]] test::Outcome check(std::vector<std::string> options = {}) const {
        std::vector<std::string> arguments{"check", "--trace", file};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return run_lockstep(arguments);
    }
    [[nodiscard]] test::Outcome check_live() const {
        return run_lockstep(test::joined({"check", scene, "--gl", test::software_gl(), "--frames", "6"},
                                         test::shader_options(shaders)));
    }
};

/// The lines of a report that start with one of these words.
std::string lines(const std::string& report, const std::vector<std::string>& words) {
    std::istringstream stream(report);
    std::string line, kept;
    while (std::getline(stream, line))
        for (const std::string& word : words)
            if (line.starts_with(word))
                kept += line + "\n";
    return kept;
}

} // namespace

TEST_CASE("record: what was recorded here is checked there, with the verdict of a live check") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const test::Outcome recorded = setting.record({"--cdt"});
    CHECK(recorded.status == 0);
    CHECK_THAT(recorded.out, Contains("run.h5: 300 particles, 6 frames with the CDT, ") && Contains("llvmpipe"));
    const test::Outcome checked = setting.check();
    CHECK(checked.status == 0);
    CHECK(checked.err.empty());
    const std::vector<std::string> same{"switches", "profile", "compared", "hash", "verdict"};
    CHECK(lines(checked.out, same) == lines(setting.check_live().out, same));
    CHECK_THAT(checked.out, Contains("GL        recorded: llvmpipe"));
    CHECK_THAT(checked.out, Contains("shaders   recorded: shipped: collision_pass.vert, "));
    CHECK(test::names_in(setting.folder.path()) == std::vector<std::string>{"run.h5", "scene.json"});

    const test::Outcome told = run_lockstep({"trace", setting.file});
    CHECK(told.status == 0);
    CHECK_THAT(told.out, Contains("scene     scene: 300 particles, 6 frames, 2 triangles of obstacles\n") &&
                             Contains("CDT       64x48 texels\n") && Contains("sealed, every value read"));
}

TEST_CASE("record: a planted bug is found in the trace as it is live") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    test::plant(setting.shaders, "collision_pass.vert", "v_Speed = product(a_Speed, u_SpeedFactor);",
                "v_Speed = product(a_Speed, 0.5);");
    const test::Outcome live = setting.check_live();
    CHECK(live.status == 1);
    REQUIRE(setting.record({"--cdt"}).status == 0);
    const test::Outcome whole = setting.check();
    CHECK(whole.status == 1);
    const std::vector<std::string> same{"hash", "verdict", "classes", "outcomes", "cause", "first", "  frame"};
    CHECK(lines(whole.out, same) == lines(live.out, same));

    REQUIRE(setting.record().status == 0);
    const test::Outcome particles = setting.check();
    CHECK(particles.status == 1);
    CHECK_THAT(particles.out,
               Contains("0 of texels") && Contains("note      no CDT was recorded") && Contains("texels: none"));
    CHECK(lines(particles.out, {"cause"}) == lines(live.out, {"cause"}));
    CHECK(setting.check({"--mode", "free"}).status == 1);
}

TEST_CASE("check trace: takes frames, mode, legal and files, and no option of a run here") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    REQUIRE(setting.record().status == 0);
    const std::string hashes = (setting.folder.path() / "hashes").string();
    const test::Outcome checked =
        setting.check({"--frames", "3", "--hashes", hashes, "--legal", "glsl", "--threads", "1"});
    CHECK(checked.status == 0);
    CHECK_THAT(checked.out, Contains("AGREE: every bit of 300 particles in 3 frames"));
    CHECK(std::filesystem::exists(hashes));
    CHECK_THAT(refusal(setting.check({"--frames", "7"})), Contains("--frames 7: ") && Contains("holds 6 frames"));
    CHECK_THAT(refusal(setting.check({setting.scene})), Contains("a scene does not go with --trace"));
    CHECK_THAT(refusal(run_lockstep({"check"})), Contains("a scene or --trace FILE is needed"));
    for (const std::vector<std::string>& option : std::vector<std::vector<std::string>>{{"--particles", "5"},
                                                                                        {"--preset", "paper"},
                                                                                        {"--set", "tick=1"},
                                                                                        {"--gl", test::software_gl()},
                                                                                        {"--shaders", "."},
                                                                                        {"--images", "pictures"}})
        CHECK_THAT(refusal(setting.check(option)), Contains(option.front() + " goes with a scene that is run here"));
}

TEST_CASE("check trace: what is no trace, or was damaged, is refused in a line") {
    const test::TemporaryFolder folder;
    const std::string scene = folder.write("scene.json", test::small_scene).string();
    for (const char* verb : {"trace", "check"}) {
        const auto told = [&](const std::string& file) {
            return verb == std::string("trace") ? refusal(run_lockstep({"trace", file}))
                                                : refusal(run_lockstep({"check", "--trace", file}));
        };
        CHECK_THAT(told(scene), Contains("scene.json: not a trace"));
        CHECK_THAT(told((folder.path() / "none").string()), Contains("none: cannot be opened"));
        CHECK_THAT(told(folder.path().string()), Contains("a folder, not a recording"));
    }
}

TEST_CASE("record: what cannot be written is told before the run, and nothing is left") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    CHECK_THAT(refusal(run_lockstep({"record", setting.scene, "--gl", test::software_gl(), "-o", "/dev/null"})),
               Contains("/dev/null: cannot be written: a trace is a regular file"));
    CHECK_THAT(
        refusal(run_lockstep({"record", setting.scene, "--gl", test::software_gl(), "-o", setting.folder.path()})),
        Contains("it names a folder"));
    CHECK_THAT(refusal(run_lockstep({"record", setting.scene})), Contains("--output FILE is missing: "));
    CHECK(test::names_in(setting.folder.path()) == std::vector<std::string>{"scene.json"});
}

TEST_CASE("record: a GPU that gives two answers is not recorded") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    test::plant(setting.shaders, "collision_pass.vert", "#version 330 core\n",
                "#version 330 core\n#extension GL_ARB_shader_clock : require\n");
    test::plant(setting.shaders, "collision_pass.vert", "v_Speed = ls_length(temp);",
                "v_Speed = ls_length(temp) + float(clock2x32ARB().x & 0xffffu);");
    CHECK_THAT(refusal(setting.record()), Contains("the GPU gave two answers to frame 0, so nothing was recorded"));
    CHECK(test::names_in(setting.folder.path()) == std::vector<std::string>{"scene.json"});
}

TEST_CASE("explain trace: the first divergence step by step, the GPU's values where they were recorded") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    test::plant(setting.shaders, "collision_pass.vert", "v_Speed = product(a_Speed, u_SpeedFactor);",
                "v_Speed = product(a_Speed, 0.5);");
    for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{{"--cdt"}, {}}) {
        REQUIRE(setting.record(options).status == 0);
        const std::string checked = setting.check().out;
        const std::size_t at = checked.find("lockstep explain --trace ") + 9;
        std::istringstream words(checked.substr(at, checked.find('\n', at) - at));
        std::vector<std::string> arguments;
        for (std::string word; words >> word;)
            arguments.push_back(word);
        const test::Outcome told = run_lockstep(arguments);
        CHECK(told.status == 0);
        CHECK_THAT(told.out, Contains("GL        recorded: llvmpipe") &&
                                 Contains("intermediate values are the reference's alone"));
        CHECK_THAT(lines(told.out, {"> speed "}), Catch::EndsWith("DIVERGENT\n"));
        CHECK_THAT(lines(told.out, {"> "}), Catch::StartsWith("> speed "));
        CHECK_THAT(lines(told.out, {"  owner of texel"}), Contains("particle"));
        CHECK_THAT(lines(told.out, {"  clip.x"}), Catch::EndsWith(" -\n"));
    }
    CHECK_THAT(refusal(run_lockstep({"explain", "--trace", setting.file, "--frame", "6", "--particle", "0"})),
               Contains("--frame 6: ") && Contains("holds frames 0 to 5"));
    CHECK_THAT(refusal(run_lockstep({"explain", "--trace", setting.file, "--frame", "1", "--particle", "300"})),
               Contains("300"));
    CHECK_THAT(
        refusal(run_lockstep({"explain", setting.scene, "--trace", setting.file, "--frame", "1", "--particle", "0"})),
        Contains("explain: a scene does not go with --trace"));
    CHECK_THAT(refusal(run_lockstep({"explain", "--trace", setting.file, "--gl", test::software_gl(), "--frame", "1",
                                     "--particle", "0"})),
               Contains("explain: --gl goes with a scene that is run here"));
}

TEST_CASE("explain trace: the reference's steps are those of a live run, with the CDT recorded or not, at any frame") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    // What the particle started from, and the reference's two columns of what it looked at.
    const auto reference_of = [](const test::Outcome& told) {
        std::istringstream stream(lines(told.out, {"  before", "  clip", "  image", "  base", "  own", "  texel ("}));
        std::string line, kept;
        while (std::getline(stream, line))
            kept += line.substr(0, 76) + "\n";
        return kept;
    };
    for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{{"--cdt"}, {}}) {
        REQUIRE(setting.record(options).status == 0);
        for (const char* frame : {"0", "1", "2", "5"}) {
            CAPTURE(options, frame);
            const std::vector<std::string> at{"--frame", frame, "--particle", "4"};
            std::vector<std::string> live{"explain", setting.scene, "--gl", test::software_gl()};
            std::vector<std::string> recorded{"explain", "--trace", setting.file};
            live.insert(live.end(), at.begin(), at.end());
            recorded.insert(recorded.end(), at.begin(), at.end());
            const std::string expected = reference_of(run_lockstep(live));
            CHECK_THAT(expected, Contains("before") && Contains("clip.x") && Contains("image position.x"));
            CHECK(reference_of(run_lockstep(recorded)) == expected);
        }
    }
}

TEST_CASE("trace: a file's name that forges a verdict or steers the terminal is shown, not obeyed") {
    if (!test::have_software_gl())
        return;
    Setting setting;
    REQUIRE(setting.record().status == 0);
    const std::string forged = (setting.folder.path() / "run\nverdict   AGREE\x1b[2J.h5").string();
    std::filesystem::rename(setting.file, forged);
    setting.file = forged;
    for (const test::Outcome& outcome : {setting.check(), run_lockstep({"trace", forged})}) {
        CHECK(outcome.status == 0);
        CHECK(outcome.out.find('\x1b') == std::string::npos);
        CHECK_THAT(outcome.out, Contains("run\\nverdict   AGREE\\x1b[2J.h5"));
    }
    std::ofstream(forged, std::ios::app) << "more";
    const std::string damaged = refusal(setting.check());
    CHECK_THAT(damaged, Contains("run\\nverdict   AGREE\\x1b[2J.h5: damaged"));
    CHECK(refusal(run_lockstep({"ch\x1b[2Jeck\n"})).find('\x1b') == std::string::npos);
    CHECK(refusal(run_lockstep({"check", "a\x1b\nb.json"})) ==
          "a\\x1b\\nb.json: cannot be read: No such file or directory");
}

TEST_CASE("record: on a full disk one line tells so, at whatever byte, and nothing is left") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    for (const std::size_t bytes : {100U, 3'000U, 30'000U, 60'000U, 90'000U}) {
        CAPTURE(bytes);
        test::Surroundings disk;
        disk.largest_file = bytes;
        disk.environment = {{"MESA_SHADER_CACHE_DISABLE", "true"}};
        CHECK(refusal(run_lockstep(
                  {"record", setting.scene, "--gl", test::software_gl(), "-o", setting.file, "--frames", "8"}, disk)) ==
              setting.file + ": cannot be written: File too large");
        CHECK(test::names_in(setting.folder.path()) == std::vector<std::string>{"scene.json"});
    }
}

TEST_CASE("record: the same run is the same file, byte by byte, for any number of threads and at any time") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const auto recorded = [&](const char* threads) {
        CHECK(setting.record({"--cdt", "--threads", threads}).status == 0);
        std::ifstream stream(setting.file, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    const std::string one = recorded("1");
    std::this_thread::sleep_for(std::chrono::milliseconds(1100)); // HDF5 would keep the second
    CHECK((one == recorded("7")));
}

} // namespace lockstep::test::trace_test
