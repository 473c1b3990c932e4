#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/cli/run_program.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::systems_test {

using Catch::Contains;
using test::refusal;
using test::run_lockstep;

namespace {

const std::string scene = "data/scenes/dust/physics.json";

std::vector<std::string> on_gl(std::vector<std::string> words) {
    return test::joined(std::move(words), {"--gl", test::software_gl()});
}

/// The shipped update without gravity, in a folder.
void plant(const test::TemporaryFolder& folder) {
    std::ifstream stream("shaders/dust/update.comp");
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::string right = "    a = add(a, gravity);\n";
    const std::size_t place = text.find(right);
    REQUIRE(place != std::string::npos);
    folder.write("update.comp", text.replace(place, right.size(), "    a = add(a, mul(gravity, 0.0));\n"));
}

} // namespace

TEST_CASE("systems: a scene names its system, and one that there is not is told with those there are") {
    const test::TemporaryFolder folder;
    const auto told = [&](const std::string& text) {
        return refusal(run_lockstep({"hash", folder.write("scene.json", text).string()}));
    };
    const std::string file = (folder.path() / "scene.json").string();
    CHECK(
        told(R"({"system": "dusty"})") ==
        file +
            ": /system: 'dusty' is no system; there are collision, dust, fluid, lifecycle, lights; did you mean dust?");
    CHECK_THAT(told(R"({"system": 3})"), Catch::StartsWith(file + ": /system: 3 is not a text"));
    CHECK_THAT(told(R"({"system": "collision"})"), Contains("emitters"));
}

TEST_CASE("systems: each side alone comes to the same hashes in exact arithmetic, and a wrong shader to others") {
    const test::TemporaryFolder folder;
    plant(folder);
    for (const std::string& one : {scene, std::string("data/scenes/lattice.json")}) {
        const std::vector<std::string> run{"hash",     one, "--preset",    "exact", "--every",
                                           "--frames", "3", "--particles", "500",   "--side"};
        const std::string cpu = run_lockstep(test::joined(run, {"cpu"})).out;
        CHECK(std::count(cpu.begin(), cpu.end(), '\n') == 3);
        CHECK(run_lockstep(on_gl(test::joined(run, {"gpu"}))).out == cpu);
        if (one == scene)
            CHECK(run_lockstep(on_gl(test::joined(run, {"gpu", "--shaders", folder.path().string()}))).out != cpu);
    }
}

TEST_CASE("systems: verbs of the collision system refuse another's scene and name those that run it") {
    for (const char* verb : {"study"}) {
        INFO(verb);
        CHECK_THAT(refusal(run_lockstep({verb, scene})) + " ",
                   Contains("is a scene of system dust, which bench, capsule, check, debug, explain, hash, record and "
                            "render run") ||
                       Contains("-o") || Contains("--output"));
    }
    CHECK(refusal(run_lockstep({"check", scene, "--require-hits"})) ==
          "check: --require-hits does not go with a scene of system dust");
    CHECK(refusal(run_lockstep({"explain", scene, "--frame", "1", "--particle", "2"})) ==
          "explain: a scene of system dust needs --item I");
}

TEST_CASE("systems: a range of frames has the hashes of the whole run, with the passes that it needs before it") {
    const std::string lights = "data/scenes/lights/crowd.json";
    const auto hashes = [&](const std::vector<std::string>& words) {
        return run_lockstep(test::joined({"hash", lights, "--particles", "300", "--preset", "exact", "--every"}, words))
            .out;
    };
    const std::string whole = hashes({"--frames", "6"});
    const std::string last = whole.substr(whole.find("\n4 ") + 1);
    CHECK(hashes({"--frames", "4..5"}) == last);
    const auto on_gpu = [&](const std::string& pass) {
        return hashes(on_gl({"--side", "gpu", "--frames", "4..5", "--lead-in", pass}));
    };
    CHECK(on_gpu("light_step_pass") == last);
    CHECK(on_gpu("0") == last);
    CHECK(on_gpu("glow_pass") != last); // the lights have not moved
    CHECK_THAT(
        refusal(run_lockstep(on_gl({"hash", lights, "--side", "gpu", "--frames", "4..5", "--lead-in", "light_step"}))),
        Catch::StartsWith("--lead-in: there is no pass 'light_step'; there are light_step_pass, "));
}

TEST_CASE("systems: hash is of the reference alone, the same for any number of threads") {
    const std::vector<std::string> words{"hash", scene, "--particles", "500", "--frames", "20"};
    const test::Outcome one = run_lockstep(test::joined(words, {"--threads", "1"}));
    CHECK(one.status == 0);
    CHECK(one.out == run_lockstep(test::joined(words, {"--threads", "2"})).out);
    CHECK(one.out.starts_with("19 "));
}

TEST_CASE("systems: a scene may come through a pipe, which nothing reads twice") {
    for (const char* file : {"data/scenes/dust/physics.json", "data/scenes/x_streams.json"}) {
        std::ifstream stream(file);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        const std::vector<std::string> options{"--frames", "3", "--particles", "100"};
        const auto piped = run_lockstep(test::joined({"hash", "/dev/stdin"}, options), {.standard_input = text});
        INFO(file << ": " << piped.err);
        CHECK(piped.status == 0);
        CHECK(piped.out == run_lockstep(test::joined({"hash", file}, options)).out);
    }
}

TEST_CASE("systems: render writes a picture of either side, check judges what the last frame draws") {
    const test::TemporaryFolder folder;
    const std::string picture = (folder.path() / "picture.png").string();
    const std::vector<std::string> render{"render", scene, "--particles", "300", "--frame", "5", "-o", picture};
    CHECK(run_lockstep(test::joined(render, {"--side", "cpu"})).status == 0);
    CHECK(std::filesystem::file_size(picture) > 1000);
    if (!test::have_software_gl())
        return;
    CHECK(run_lockstep(test::joined(render, {"--side", "gpu", "--gl", test::software_gl()})).status == 0);

    const std::vector<std::string> check = on_gl({"check", scene, "--particles", "300", "--frames", "5"});
    CHECK_THAT(run_lockstep(check).out, Contains("drawn     AGREE: 2400 corners that frame 4 draws"));
    CHECK_THAT(run_lockstep(test::joined(check, {"--no-render"})).out, !Contains("drawn "));
    const test::TemporaryFolder mine;
    std::ifstream shipped("shaders/dust/draw.vert");
    std::string text((std::istreambuf_iterator<char>(shipped)), {});
    const std::string right = "ls_multiply(turned[axis], scale)";
    REQUIRE(text.find(right) != std::string::npos);
    text.replace(text.find(right), right.size(), "turned[axis]");
    mine.write("draw.vert", text);
    const test::Outcome wrong = run_lockstep(test::joined(check, {"--shaders", mine.path().string()}));
    CHECK(wrong.status == 1);
    CHECK_THAT(wrong.out, Contains("what frame 4 of") && Contains("DIVERGENT") && Contains("scale_missing"));
}

TEST_CASE("systems: bench has a row a pass that runs, and a frame's with its hash and verdict") {
    if (!test::have_software_gl())
        return;
    const test::Outcome bench = run_lockstep(
        {"bench", scene, "--counts", "100,300", "--frames", "3", "--warm-up", "1", "--gl", test::software_gl()});
    CHECK(bench.status == 0);
    for (const char* row : {"      100 update ", "      300 update_count ", "      300 frame "})
        CHECK_THAT(bench.out, Contains(row));
    CHECK_THAT(bench.out, Contains(" AGREE\n"));
    CHECK(refusal(run_lockstep({"bench", scene, "--require-hits"})) ==
          "bench: --require-hits goes with scenes of system collision");
    CHECK(refusal(run_lockstep({"bench", scene, "--radius", "2"})) ==
          "bench: --radius goes with scenes of system collision");
}

TEST_CASE("systems: bench times GL alone, and as many atomics as lights make") {
    if (!test::have_software_gl())
        return;
    const std::string lights = "data/scenes/lights/one_light.json";
    const std::vector<std::string> alone =
        on_gl({"bench", lights, "--counts", "1", "--frames", "1", "--warm-up", "0", "--gl-only", "--floor"});
    const test::Outcome bench = run_lockstep(test::joined(alone, {"--set", "accumulate=fixed64"}));
    CHECK(bench.status == 0);
    CHECK_THAT(bench.out, Contains("        1 floor: 15 atomics in each of ") &&
                              Contains("        1 atomics_at_random ") && Contains("        1 atomics_in_one_voxel ") &&
                              !Contains("AGREE"));
    const test::Outcome gathered = run_lockstep(test::joined(alone, {"--set", "accumulate=gather"}));
    CHECK(gathered.status == 0);
    CHECK_THAT(gathered.out, !Contains("floor: "));
    CHECK(refusal(run_lockstep({"bench", "data/scenes/lattice.json", "--floor"})) ==
          "bench: --floor does not go with scenes of system collision");
    const test::Outcome particles =
        run_lockstep(on_gl({"bench", "data/scenes/lattice.json", "--counts", "100", "--radius", "1", "--frames", "1",
                            "--warm-up", "0", "--gl-only", "--no-render"}));
    CHECK(particles.status == 0);
    CHECK_THAT(particles.out, Contains("\n1 frame each, median ms a frame; "));
    CHECK_THAT(particles.out, Contains("GL alone, nothing checked") && Contains(" collision_pass ") &&
                                  Contains("nothing rendered") && !Contains("AGREE"));
}

TEST_CASE("systems: check agrees on the shipped kernels and names a planted mistake, with a line that explains it") {
    if (!test::have_software_gl())
        return;
    const std::vector<std::string> check = on_gl({"check", scene, "--particles", "500", "--frames", "20"});
    const test::Outcome right = run_lockstep(check);
    CHECK(right.status == 0);
    CHECK_THAT(right.out, Contains("verdict   AGREE: every bit of 500 grains") && !Contains("\nrender "));
    const test::TemporaryFolder mine;
    plant(mine);
    const test::Outcome wrong = run_lockstep(test::joined(check, {"--shaders", mine.path()}));
    CHECK(wrong.status == 1);
    CHECK_THAT(wrong.out, Contains("gravity_missing") && Contains("verdict   DIVERGENT from frame 0 on") &&
                              Contains("lockstep explain " + scene + " --frame 0 --pass update --item 0 ") &&
                              Contains("foreign: " + (mine.path() / "update.comp").string()));
    mine.write("updat.comp", "#version 430 core\nvoid main() {}\n");
    CHECK_THAT(refusal(run_lockstep(test::joined(check, {"--shaders", mine.path()}))),
               Contains("updat.comp would not run in this scene"));
}

TEST_CASE("systems: check leaves a page with the first items' steps, a capsule, hashes and pictures") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder data, mine, out;
    std::filesystem::create_directory_symlink(std::filesystem::absolute("shaders"), data.path() / "shaders");
    data.write("report.html", "<main></main>\n<!-- lockstep data -->\n");
    plant(mine);
    const std::string folder = (out.path() / "page").string(), hashes = (out.path() / "hashes").string();
    const std::vector<std::string> check =
        on_gl({"check", scene, "--particles", "200", "--frames", "4", "--report", folder, "--hashes", hashes,
               "--images", folder, "--shaders", mine.path().string()});
    const test::Surroundings with_page{.environment = {{"LOCKSTEP_DATA", data.path().string()}}};
    const test::Outcome outcome = run_lockstep(check, with_page);
    INFO(outcome.err);
    REQUIRE(outcome.status == 1);
    CHECK(test::names_in(folder) == std::vector<std::string>{"capsule.json", "frame_difference.png", "frame_gpu.png",
                                                             "frame_reference.png", "report.html"});
    const auto text_of = [](const std::string& file) {
        std::ifstream stream(file, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    const std::string page = text_of(folder + "/report.html");
    const std::string start = "id=\"lockstep-head\">";
    const std::size_t from = page.find(start) + start.size();
    const auto head = nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
    CHECK(head.at("report").at("verdict") == "DIVERGENT");
    CHECK(head.at("items").size() == 12);
    CHECK(head.at("items")[0].at("step") == "velocity.y");
    CHECK(head.at("system").at("passes")[2].at("differing") == 800);
    CHECK_THAT(head.at("text").get<std::string>(), Contains("gravity_missing"));

    const test::Outcome shown = run_lockstep({"capsule", "show", folder + "/capsule.json"});
    CHECK(shown.status == 1);
    CHECK_THAT(shown.out, Contains("grain 0 in frame 0, pass update"));
    const std::string lines = text_of(hashes);
    CHECK(std::count(lines.begin(), lines.end(), '\n') == 4);
    CHECK_THAT(lines, Contains(outcome.out.substr(outcome.out.find("GPU ", outcome.out.find("hash ")) + 4, 16)));

    const std::string in_the_way = out.write("way", "in the").string();
    CHECK(refusal(run_lockstep(on_gl({"check", scene, "--frames", "1000000", "--report", in_the_way}), with_page)) ==
          in_the_way + ": cannot be made a folder: a file of that name is in the way");
    CHECK_THAT(refusal(run_lockstep(on_gl({"check", scene, "--report", folder, "--json", folder + "/report.html"}),
                                    with_page)),
               Contains("report.html"));
}

namespace {

/// The lines of a report that say what was found, in the order in which they stand there. What little a pass did, which
/// the verdict has behind ", but", is known better of a live run: how many invocations it ran over.
std::string findings(const std::string& report) {
    std::istringstream lines(report);
    std::string found;
    for (std::string line; std::getline(lines, line);)
        for (const char* key : {"compared", "hash", "power", "verdict", "classes", "outcomes", "ties", "cause", "first",
                                "  velocity", "  position", "  frame "})
            if (line.starts_with(key)) {
                const std::size_t but = line.find(", but "), end = line.find(": ", but);
                const std::string clause = but == std::string::npos ? "" : line.substr(but, end - but);
                const bool is_of_extent = clause.find(" ran over ") != std::string::npos ||
                                          clause.find(" passes changed nothing") != std::string::npos;
                found += (is_of_extent ? line.substr(0, but) + line.substr(end) : line) + "\n";
            }
    return found;
}

/// The file with other bytes at a place, and its seal as it was.
void write_at(const std::string& file, std::streamoff place, const std::string& bytes) {
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekp(place);
    stream << bytes;
}

} // namespace

TEST_CASE("systems: explain looks into a vertex that a frame draws, and says of which frame and grain it is") {
    if (!test::have_software_gl())
        return;
    const auto explained = [&](const std::string& item) {
        return run_lockstep(on_gl({"explain", "data/scenes/dust/obb.json", "--particles", "200", "--frame", "30",
                                   "--pass", "draw", "--item", item}));
    };
    const test::Outcome vertex = explained("70");
    CHECK(vertex.status == 0);
    CHECK_THAT(vertex.out, Contains("corner 70 in frame 30, pass draw\n") && Contains("clip.w") &&
                               Contains("every bit agrees") && Contains("instance  grain 17, its vertex 2\n"));
    CHECK_THAT(refusal(explained("800")), Contains("800"));
}

TEST_CASE("systems: a recorded run is judged as the live one was, and explained, without GL") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder mine, out;
    plant(mine);
    const std::string file = (out.path() / "run.h5").string();
    struct Run {
        std::string scene;
        std::vector<std::string> more;
    };
    const Run of = GENERATE_REF(Run{scene, {"--shaders", mine.path().string()}},
                                Run{"data/scenes/lifecycle/births_and_deaths.json", {}});
    INFO(of.scene);
    const std::vector<std::string> run =
        test::joined(on_gl({of.scene, "--particles", "200", "--frames", "5"}), of.more);
    const test::Outcome live = run_lockstep(test::joined({"check", "--no-render"}, run));
    const test::Outcome recorded = run_lockstep(test::joined({"record", "-o", file}, run));
    INFO(recorded.err);
    REQUIRE(recorded.status == 0);
    const test::Surroundings no_gl{
        .environment = {{"LOCKSTEP_OSMESA_LIBRARY", "/nowhere"}, {"LOCKSTEP_EGL_LIBRARY", "/nowhere"}}};
    const test::Outcome again = run_lockstep({"check", "--trace", file}, no_gl);
    INFO(again.err);
    CHECK(again.status == live.status);
    CHECK(findings(again.out) == findings(live.out));
    CHECK_THAT(again.out, Contains("GL        recorded: "));
    CHECK_THAT(run_lockstep({"trace", file}, no_gl).out, Contains("5 frames") && Contains("every value read"));

    // A recording has no text of a shader that would tell of steps: the references' columns.
    const auto place = [](const std::string& shown) {
        const std::string from = shown.substr(shown.find("profile "));
        const std::size_t head = from.find("\n  step "), gpu = from.find(" GPU ", head) - head - 1;
        std::string columns;
        std::istringstream lines(from.substr(0, from.find("\ntext  ")));
        for (std::string line; std::getline(lines, line);)
            columns += line.substr(0, gpu).substr(0, line.substr(0, gpu).find_last_not_of(' ') + 1) + "\n";
        return columns;
    };
    const std::vector<std::string> item{"--frame", "2", "--item", "0"};
    const test::Outcome explained = run_lockstep(test::joined({"explain", "--trace", file}, item), no_gl);
    CHECK(explained.status == 0);
    std::vector<std::string> here = test::joined(on_gl({"explain", of.scene, "--particles", "200"}), item);
    CHECK(place(explained.out) == place(run_lockstep(test::joined(here, of.more)).out));
    const std::string capsule = (out.path() / "3.json").string();
    CHECK(run_lockstep(test::joined({"capsule", "cut", "--trace", file, "-o", capsule}, item), no_gl).status <= 1);
    CHECK_THAT(run_lockstep({"capsule", "show", capsule}).out, Contains(" 0 in frame 2, pass "));
}

TEST_CASE("systems: a recording that is damaged, cut off, of another system or of too few frames is one line") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder out;
    const std::string file = (out.path() / "run.h5").string();
    REQUIRE(run_lockstep(on_gl({"record", scene, "--particles", "50", "--frames", "3", "-o", file})).status == 0);
    CHECK(refusal(run_lockstep({"check", "--trace", file, "--frames", "4"})) ==
          "--frames 4: " + file + " holds 3 frames");
    CHECK(refusal(run_lockstep({"explain", "--trace", file, "--frame", "3", "--item", "0"})) ==
          file + " holds frames 0 to 2, not 3");
    CHECK(refusal(run_lockstep({"explain", "--trace", file, "--frame", "0", "--particle", "0"})) ==
          "explain: a scene of system dust needs --item I");
    CHECK_THAT(refusal(run_lockstep({"explain", "--trace", file, "--frame", "0", "--item", "50"})),
               Contains("there is no grain '50'; physics has 0 to 49"));
    CHECK(refusal(run_lockstep({"check", "--trace", file, "--images", out.path().string()})) ==
          "check: --images goes with a scene that is run here, not with --trace");
    CHECK_THAT(refusal(run_lockstep({"record", scene, "-o", out.path().string() + "/no/where.h5"})),
               Contains("no/where.h5"));
    CHECK(refusal(run_lockstep({"report", file, "--require-hits"})) ==
          "report: --require-hits does not go with a recording of system dust");
    CHECK(refusal(run_lockstep({"record", scene, "--cdt", "-o", file})) ==
          "record: --cdt goes with scenes of system collision");

    const std::uintmax_t size = std::filesystem::file_size(file);
    const std::string other = (out.path() / "other.h5").string();
    const auto damaged = [&](const auto& change) {
        std::filesystem::copy_file(file, other, std::filesystem::copy_options::overwrite_existing);
        change();
        return refusal(run_lockstep({"check", "--trace", other}));
    };
    CHECK(damaged([&] { std::filesystem::resize_file(other, size / 2); }) ==
          other + ": cut off: " + std::to_string(size / 2) + " of its " + std::to_string(size) + " bytes are here");
    CHECK_THAT(damaged([&] { write_at(other, 2000, "x"); }), Contains(other + ": damaged: its XXH128 is "));
    CHECK_THAT(
        damaged([&] { write_at(other, 0, "lockstep recording 1\nsystem dusk\n"); }),
        Contains(
            "a recording of system 'dusk', which is none of lockstep's: collision, dust, fluid, lifecycle, lights"));
    CHECK_THAT(damaged([&] { write_at(other, 0, "lockstep recording 1\nsystem \x1b[31\n"); }),
               Contains("which is none of lockstep's") && !Contains("\x1b"));
}

TEST_CASE("systems: explain shows one item's step in a pass that runs") {
    if (!test::have_software_gl())
        return;
    const auto explain = [](const std::vector<std::string>& more) {
        return run_lockstep(
            test::joined(on_gl({"explain", scene, "--particles", "500", "--frame", "5", "--item", "3"}), more));
    };
    const test::Outcome shown = explain({});
    CHECK(shown.status == 0);
    CHECK_THAT(shown.out, Contains("grain 3 in frame 5, pass update") && Contains("every bit agrees"));
    CHECK(refusal(explain({"--pass", "populate"})) == "physics: pass populate does not run in frame 5");
    CHECK_THAT(refusal(explain({"--pass", "updte"})), Catch::EndsWith("did you mean update?"));
}

TEST_CASE("systems: a capsule repeats its verdict without the scene's file and without GL") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder mine, folder;
    plant(mine);
    const std::string file = (folder.path() / "grain.json").string();
    const test::Outcome cut =
        run_lockstep(on_gl({"capsule", "cut", scene, "--particles", "500", "--frame", "4", "--item", "3", "--pass",
                            "update", "--shaders", mine.path(), "-o", file}));
    CHECK(cut.err.empty());
    CHECK(cut.status == 0);
    CHECK_THAT(cut.out, Contains("written   " + file) && Contains(": divergent\n"));
    const test::Outcome shown = run_lockstep({"capsule", "show", file});
    CHECK(shown.status == 1);
    CHECK_THAT(shown.out, Contains("grain 3 in frame 4, pass update") && Contains("verdict   divergent"));
    std::ifstream stream(file);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::size_t name = text.find("\"system\":\"dust\"");
    REQUIRE(name != std::string::npos);
    folder.write("other.json", text.replace(text.rfind("\"system\":\"dust\""), 15, "\"system\":\"sand\""));
    CHECK_THAT(refusal(run_lockstep({"capsule", "show", (folder.path() / "other.json").string()})), Contains("sand"));
}

TEST_CASE("cli capsule: pixels of an NVIDIA driver's run whose normals' length was lost in rounding's sets are legal") {
    for (const std::string name : {"tilted_sheet_normal", "wave_normal"}) {
        const test::Outcome shown = run_lockstep({"capsule", "show", "data/results/fluid/capsules/" + name + ".json"});
        CAPTURE(name, shown.out, shown.err);
        CHECK(shown.status == 0);
        CHECK_THAT(shown.out, Contains("verdict   rounding"));
        CHECK_THAT(shown.out, !Contains("anything"));
    }
}

TEST_CASE("cli capsule: of passes with one name each is reached by its number, and its capsule remembers it") {
    const test::TemporaryFolder folder;
    const std::string scene = "data/scenes/fluid/one_sphere.json", file = (folder.path() / "pixel.json").string();
    const auto cut = [&](const std::string& pass) {
        const test::Outcome done = run_lockstep(on_gl({"capsule", "cut", scene, "--frame", "0", "--pass", pass,
                                                       "--item", "100,100", "-o", file, "--set", "filter=bilateral"}));
        std::ifstream stream(file);
        return done.status == 0 ? std::string{std::istreambuf_iterator<char>(stream), {}} : std::string();
    };
    const std::string first = cut("depth_filter_pass");
    REQUIRE_THAT(first, Contains("\"pass\":\"depth_filter_pass\""));
    int number = 0;
    while (number < 20 && cut(std::to_string(number)) != first)
        ++number;
    REQUIRE(number < 20);
    const std::string second = cut(std::to_string(number + 1));
    CHECK_THAT(second, Contains("\"pass\":\"" + std::to_string(number + 1) + "\"") && Contains("smooth_depth"));
    const test::Outcome shown = run_lockstep({"capsule", "show", file});
    CHECK(shown.status == 0);
    CHECK_THAT(shown.out, Contains("pass depth_filter_pass"));
    CHECK_THAT(refusal(run_lockstep(on_gl({"explain", scene, "--frame", "0", "--pass", "77", "--item", "100,100"}))),
               Contains("--pass: there is no pass '77'; there are "));
}

} // namespace lockstep::test::systems_test
