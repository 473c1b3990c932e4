#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/cli/cli_checks.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::study_test {

using test::refusal;
using test::run_lockstep;

namespace {

const test::TemporaryFolder& input() {
    static const test::TemporaryFolder folder;
    return folder;
}

std::string scene() { return input().write("scene.json", test::small_scene).string(); }

} // namespace

TEST_CASE("study: a table, and every output") {
    const test::TemporaryFolder output;
    const auto path = [&](const char* name) { return (output.path() / name).string(); };
    const auto outcome = run_lockstep({"study", scene(), "--frames", "4", "--every", "2", "--csv", path("a.csv"),
                                       "--json", path("a.json"), "--images", path("pictures")});
    CHECK(outcome.err.empty());
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, Catch::Contains("scene     scene") && Catch::Contains("missed by") &&
                                Catch::Contains("search ends at") && Catch::Contains("red occluded"));
    CHECK(test::names_in(output.path()) == std::vector<std::string>{"a.csv", "a.json", "pictures"});
    CHECK(test::names_in(output.path() / "pictures") ==
          std::vector<std::string>{"misses_00001.png", "misses_00003.png"});
}

TEST_CASE("study: its parts are verbs, and who writes one as an option is told so") {
    const std::string moving = run_lockstep({"study", "rest", scene(), "--frames", "4"}).out;
    CHECK_THAT(moving, Catch::Contains("At rest: "));
    CHECK(refusal(run_lockstep({"study", "rest"})) ==
          "SCENE is missing: scene file, data/scenes/*.json (lockstep study rest --help says more)");
    CHECK_THAT(refusal(run_lockstep({"study", "rest", scene(), "--csv", "a"})),
               Catch::StartsWith("unknown option '--csv'"));
    CHECK(refusal(run_lockstep({"study", scene(), "--rest", "--frames", "4"})) ==
          "unknown option '--rest'; rest is a verb: lockstep study rest (lockstep study --help says more)");
    CHECK_THAT(refusal(run_lockstep({"study", "--recall-table"})),
               Catch::Contains("recall is a verb: lockstep study recall"));
}

TEST_CASE("study: a chart, or one line that says what is missing, before the run") {
    const test::TemporaryFolder output;
    const std::string chart = (output.path() / "a.svg").string();
    test::Surroundings without;
    without.environment = {{"PATH", output.path().string()}};
    const std::string missing = "study: --chart: gnuplot is not installed (Debian package gnuplot-nox)";
    CHECK(refusal(run_lockstep({"study", scene(), "--frames", "100000000", "--chart", chart}, without)) == missing);
    CHECK(refusal(run_lockstep({"study", "thesis", "--chart", chart}, without)) == missing);
    CHECK(test::names_in(output.path()).empty());
}

TEST_CASE("study: a gnuplot in the current folder is not run for an empty entry of PATH") {
    const test::TemporaryFolder current;
    const auto gnuplot = current.write("gnuplot", "#!/bin/sh\ntouch ran\n");
    std::filesystem::permissions(gnuplot, std::filesystem::perms::owner_all);
    test::Surroundings surroundings;
    surroundings.folder = current.path().string();
    for (const char* path : {"", ":", "/nowhere:", ".", "::/nowhere"}) {
        CAPTURE(path);
        surroundings.environment = {{"PATH", path}};
        CHECK_THAT(refusal(run_lockstep({"study", scene(), "--frames", "2", "--chart", "a.svg"}, surroundings)),
                   Catch::Contains("gnuplot is not installed"));
        CHECK(test::names_in(current.path()) == std::vector<std::string>{"gnuplot"});
    }
}

TEST_CASE("study: gnuplot is given the chart by a pipe, whatever the temporary folder is called") {
    const test::TemporaryFolder programs, output;
    const auto gnuplot = programs.write("gnuplot", "#!/bin/sh\ncat\n");
    std::filesystem::permissions(gnuplot, std::filesystem::perms::owner_all);
    const std::string folder = output.path() / "it's; touch broken; '";
    std::filesystem::create_directory(folder);
    test::Surroundings surroundings;
    surroundings.environment = {{"PATH", programs.path().string() + ":/usr/bin:/bin"}, {"TMPDIR", folder}};
    CHECK(run_lockstep({"study", scene(), "--frames", "3000", "--chart", folder + "/a.svg"}, surroundings).status == 0);
    CHECK(test::names_in(folder) == std::vector<std::string>{"a.svg"});
    CHECK(std::filesystem::file_size(folder + "/a.svg") > 65536);
}

TEST_CASE("study: gnuplot's warnings are not shown, and why it failed is") {
    const test::TemporaryFolder programs, output;
    const std::string chart = (output.path() / "a.svg").string();
    const auto drawn_by = [&](const std::string& script) {
        const auto gnuplot = programs.write("gnuplot", "#!/bin/sh\n" + script);
        std::filesystem::permissions(gnuplot, std::filesystem::perms::owner_all);
        test::Surroundings surroundings;
        surroundings.environment = {{"PATH", programs.path().string() + ":/usr/bin:/bin"}};
        return run_lockstep({"study", scene(), "--frames", "2", "--chart", chart}, surroundings);
    };
    const test::Outcome warned = drawn_by("echo 'Warning: empty x range' >&2\ncat\n");
    CHECK(warned.status == 0);
    CHECK(warned.err.empty());
    CHECK(refusal(drawn_by("cat > /dev/null\nprintf '\\nline 3:\\n  no such colour\\n' >&2\nexit 1\n")) ==
          "chart: gnuplot failed: line 3: no such colour");
}

TEST_CASE("study: what cannot be studied is refused in one line") {
    CHECK(refusal(run_lockstep({"study"})) ==
          "study: a SCENE is needed, or one of rest, cameras, recall, catalogue, remedies, thesis");
    CHECK(refusal(run_lockstep({"study", scene(), "--frames", "1"})) ==
          "study: --frames 1 is the frame with the empty CDT; 2 or more have something to study");
    CHECK(refusal(run_lockstep({"study", scene(), "--set", "search=octree"})) ==
          "study: search = octree leaves no CDT of particles to study; study thesis has the octree's recall");
    CHECK_THAT(refusal(run_lockstep({"study", scene(), "--csv", "/nowhere/a.csv"})), Catch::StartsWith("/nowhere"));
}

TEST_CASE("study: an option that would be ignored is refused") {
    const auto refused = [](std::vector<std::string> arguments, const std::string& message) {
        arguments.insert(arguments.begin(), "study");
        CHECK_THAT(refusal(run_lockstep(arguments)), Catch::StartsWith(message));
    };
    refused({"cameras", scene(), "--csv", "a"}, "unknown option '--csv'");
    refused({"cameras", scene(), "--side", "gpu"}, "unknown option '--side'");
    refused({"catalogue", "--csv", "a"}, "unknown option '--csv'");
    refused({"catalogue", scene()}, "'" + scene() + "' is one argument too many");
    refused({"recall", "--json", "a"}, "unknown option '--json'");
    refused({"remedies", "--shaders", "."}, "study remedies: --shaders goes with --gl");
    refused({"remedies", "--gl", test::software_gl(), "--profile", "nvidia"},
            "study remedies: --profile does not go with --gl, whose driver has one of its own");
    refused({scene(), "--seconds", "3"}, "unknown option '--seconds'");
    refused({scene(), "--gl", test::software_gl()}, "study: --gl goes with --side gpu");
    refused({scene(), "--shaders", "."}, "study: --shaders goes with --side gpu");
    refused({scene(), "--side", "gpu", "--profile", "nvidia"}, "study: --profile goes with --side cpu");
    refused({"thesis", "--from", "a", "--counts", "3"}, "study thesis: --counts does not go with --from");
    refused({"thesis", "--particles", "9"}, "unknown option '--particles'");
    CHECK_THAT(refusal(run_lockstep({"study", "thesis", "--seconds", "nan"})),
               Catch::Contains("'nan' is not a number of seconds above 0"));
}

TEST_CASE("study: the catalogue's scenes are those of LOCKSTEP_DATA, too") {
    const test::TemporaryFolder data;
    test::Surroundings surroundings;
    surroundings.environment = {{"LOCKSTEP_DATA", data.path()}};
    CHECK_THAT(refusal(run_lockstep({"study", "catalogue"}, surroundings)), Catch::Contains(data.path().string()));
}

TEST_CASE("study: particles that all lie in one place are refused before their neighbours are listed") {
    const test::TemporaryFolder folder;
    const std::string heap = folder.write("heap.json", R"({"constants": {"collision_range": 0.1}, "image": [64, 48],
        "emitters": [{"count": 20000, "min": [0, 0, 0], "max": [0, 0, 0], "speed": 0}]})");
    test::Surroundings small;
    small.memory = std::size_t{1} << 30U;
    CHECK(refusal(run_lockstep({"study", heap, "--frames", "2"}, small)) ==
          "20000 particles have 399980000 neighbours within 0.1; at most 100000000 are listed: a smaller "
          "collision_range or fewer particles have fewer");
}

TEST_CASE("study: a scene of the catalogue that is not there is named") {
    const auto outcome = run_lockstep({"study", "catalogue", "--scenes", input().path().string()});
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Catch::Contains("catalogue/close_up.json"));
}

TEST_CASE("study: the thesis's tables, measured, and told again from what was written") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder scenes, output;
    for (const char* name : {"bunny_a", "bunny_b", "dragon_a", "dragon_b", "x_streams"})
        scenes.write(std::string(name) + ".json", test::small_scene);
    const auto path = [&](const char* name) { return (output.path() / name).string(); };
    const auto measured =
        run_lockstep({"study", "thesis", "--scenes", scenes.path().string(), "--counts", "100,200", "--frames", "2",
                      "--gl", test::software_gl(), "--json", path("a.json"), "--csv", path("a.csv")});
    CHECK(measured.err.empty());
    CHECK(measured.status == 0);
    CHECK(test::names_in(output.path()) == std::vector<std::string>{"a.csv", "a.json"});
    const auto told = run_lockstep({"study", "thesis", "--from", path("a.json"), "--csv", path("b.csv")});
    CHECK(told.status == 0);
    CHECK_THAT(told.out, Catch::StartsWith("GL ") && Catch::Contains("Figure 5-5"));
    CHECK_THAT(measured.out, Catch::Contains(" 2 ") && Catch::EndsWith(told.out));

    scenes.write("dragon_a.json", R"({"emitters": [{"count": 9, "min": [0, 0, 0], "max": [1, 1, 1]}],
        "obstacles": [{"shape": "mesh", "file": "nowhere.obj", "height": 1}]})");
    const auto part = run_lockstep({"study", "thesis", "--scenes", scenes.path().string(), "--counts", "100",
                                    "--frames", "1", "--gl", test::software_gl(), "--json", path("part.json")});
    CHECK(part.status == 0);
    CHECK_THAT(part.out, Catch::Contains("left out: dragon_a, since ") && Catch::Contains("nowhere.obj: no such mesh"));
    CHECK(part.out.find("left out") < part.out.find("\nbunny_a "));
    CHECK(run_lockstep({"study", "thesis", "--from", path("part.json")}).status == 0);

    const auto without = run_lockstep({"study", "thesis", "--scenes", scenes.path().string(), "--counts", "100",
                                       "--frames", "1", "--gl", test::software_gl()},
                                      {{{"GALLIUM_DRIVER", "softpipe"}}});
    CHECK(without.status == 0);
    CHECK_THAT(without.out,
               Catch::StartsWith("no octree and no depth: both need compute shaders, GL 4.3; this context is 3.3"));
}

TEST_CASE("study: the GL side, and the collision cameras") {
    if (!test::have_software_gl())
        return;
    const auto table = [&](std::vector<std::string> more) {
        more.insert(more.end(), {scene(), "--frames", "4"});
        more.insert(more.begin(), "study");
        const auto outcome = run_lockstep(more);
        CHECK(outcome.status == 0);
        return outcome.out;
    };
    CHECK(table({"--side", "gpu", "--gl", test::software_gl()}) == table({"--profile", "llvmpipe"}));
    const std::string cameras = table({"cameras"});
    CHECK_THAT(cameras, Catch::StartsWith("| collision camera |") &&
                            Catch::Contains("\n| fixed behind | 0.00 | stands |") && Catch::Contains("\nHoles: "));
    CHECK(std::count(cameras.begin(), cameras.end(), '\n') == 12);
}

TEST_CASE("study: who has come to rest, over the frames") {
    const test::TemporaryFolder folder;
    const std::string standing = folder.write("standing.json", R"({"constants": {"gravity": [0, 0, 0]},
        "emitters": [{"count": 10, "min": [0, 1, 0], "max": [0.5, 1, 0], "speed": 0.01, "direction": [1, 0, 0]}],
        "obstacles": [{"shape": "plane", "size": [1, 1]}]})");
    const auto rest = run_lockstep({"study", "rest", standing, "--frames", "4", "--every", "2"});
    CHECK(rest.status == 0);
    CHECK_THAT(rest.out, Catch::StartsWith("| frames |") &&
                             Catch::Contains("\n| 2 | 0.0 | 100.0 | 100.0 | 100.0 | 1.000 |") &&
                             Catch::Contains("\n| 4 | ") && Catch::Contains("\nAt rest: "));
    const std::string nothing = folder.write("nothing.json", R"({"emitters": [{"count": 10, "min": [0, 0, 0],
        "max": [1, 1, 1]}]})");
    CHECK(refusal(run_lockstep({"study", "rest", nothing, "--frames", "4"})) ==
          "study rest counts the particles that lie on an obstacle; this scene has none");
}

TEST_CASE("study: what the thesis's tables cannot be made of is refused in one line") {
    CHECK_THAT(refusal(run_lockstep({"study", "thesis", "--from", "/nowhere/a.json"})),
               Catch::StartsWith("/nowhere/a.json"));
    CHECK_THAT(refusal(run_lockstep({"study", "thesis", "--json", "/nowhere/a.json"})), Catch::StartsWith("/nowhere"));
}

TEST_CASE("study: the remedies' table, with and without GL") {
    const test::TemporaryFolder output;
    const std::string json = (output.path() / "remedies.json").string();
    const auto recall = run_lockstep({"study", "remedies", "--particles", "3000", "--json", json});
    CHECK(recall.status == 0);
    CHECK_THAT(recall.out, Catch::Contains("no GL") && Catch::Contains("cdt_layers=4 search_window=projected"));
    CHECK(test::names_in(output.path()) == std::vector<std::string>{"remedies.json"});
    CHECK_THAT(refusal(run_lockstep({"study", "remedies", "--json", "/nowhere/a.json"})), Catch::Contains("/nowhere"));
    if (!test::have_software_gl())
        return;
    const auto cost = run_lockstep({"study", "remedies", "--particles", "3000", "--gl", test::software_gl()});
    CHECK(cost.status == 0);
    CHECK_THAT(cost.out, Catch::Contains("AGREE") && !Catch::Contains("DIFFER"));
}

} // namespace lockstep::test::study_test
