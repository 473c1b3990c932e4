#include <catch2/catch.hpp>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/cli/cli_checks.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::output_files_test {

using test::run_lockstep;
namespace fs = std::filesystem;

namespace {

using Names = std::vector<std::string>;

/// A scene, and a folder for what a run of it leaves.
struct Setting {
    test::TemporaryFolder input;
    test::TemporaryFolder output;
    std::string scene = input.write("scene.json", test::small_scene).string();

    [[nodiscard]] std::string path(const std::string& name) const { return (output.path() / name).string(); }
    [[nodiscard]] test::Outcome check(const std::vector<std::string>& outputs,
                                      const test::Surroundings& surroundings = {}) const {
        std::vector<std::string> arguments{"check", scene, "--gl", test::software_gl()};
        arguments.insert(arguments.end(), outputs.begin(), outputs.end());
        return run_lockstep(arguments, surroundings);
    }
    [[nodiscard]] Names left() const { return test::names_in(output.path()); }
};

std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

test::Surroundings disk_of(std::size_t bytes) {
    test::Surroundings surroundings;
    surroundings.largest_file = bytes;
    // A driver's cache of compiled shaders would meet the limit as well.
    surroundings.environment = {{"MESA_SHADER_CACHE_DISABLE", "true"}};
    return surroundings;
}

/// The report was shown; the one line of error says that a file could not be written.
void check_full(const test::Outcome& outcome, const std::string& file) {
    CHECK(outcome.status == 2);
    CHECK(outcome.err == "lockstep: " + file + ": cannot be written: File too large\n");
}

} // namespace

TEST_CASE("output_files: all that was asked for is there after a run") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    CHECK(setting
              .check({"--frames", "3", "--json", setting.path("report.json"), "--hashes", setting.path("hashes"),
                      "--images", setting.path("deep/images")})
              .status == 0);
    CHECK(setting.left() == Names{"deep", "hashes", "report.json"});
    CHECK(test::names_in(setting.path("deep/images")) == Names{"cdt_difference.png", "cdt_gpu.png", "cdt_reference.png",
                                                               "frame_difference.png", "frame_gpu.png",
                                                               "frame_reference.png"});
    CHECK_THAT(text_of(setting.path("hashes")), Catch::Matches("(\\d [0-9a-f]{16} [0-9a-f]{16}\n){3}"));
}

TEST_CASE("output_files: what cannot be written is told before the run") {
    const Setting setting;
    const std::string way = setting.output.write("way", "in the").string();
    struct {
        std::vector<std::string> outputs;
        std::string message;
    } const cases[]{
        {{"--images", way}, way + ": cannot be made a folder: a file of that name is in the way"},
        {{"--images", way + "/deep"}, way + "/deep: cannot be made: Not a directory"},
        {{"--images", "/proc/nowhere"}, "/proc/nowhere: cannot be made: No such file or directory"},
        {{"--json", setting.path("no/report.json")},
         setting.path("no/report.json") + ": cannot be written: No such file or directory"},
        {{"--json", setting.output.path().string()},
         setting.output.path().string() + ": cannot be written: it names a folder"},
        {{"--hashes", setting.path("no/")}, setting.path("no/") + ": cannot be written: it names a folder"},
        {{"--hashes", way + "/hashes"}, way + "/hashes: cannot be written: Not a directory"},
        {{"--json", setting.path("a"), "--hashes", setting.path("./a")},
         setting.path("./a") + ": cannot be written: two outputs have this name"},
    };
    for (const auto& refused : cases) {
        CAPTURE(refused.outputs);
        std::vector<std::string> outputs = refused.outputs;
        outputs.insert(outputs.end(), {"--frames", "100000000"});
        CHECK(test::refusal(setting.check(outputs)) == refused.message);
        CHECK(setting.left() == Names{"way"});
    }
    CHECK(text_of(way) == "in the");
    CHECK_THAT(test::refusal(setting.check({"--images", setting.path("new/images"), "--shaders", "/nowhere"})),
               Catch::Equals("shader folder /nowhere does not exist") || Catch::StartsWith("no GL context"));
    CHECK(setting.left() == Names{"way"});
    CHECK(test::refusal(run_lockstep({"render", setting.scene, "--frame", "100000000", "-o", way + "/frame.png"})) ==
          way + "/frame.png: cannot be written: Not a directory");
}

TEST_CASE("output_files: no file that the run read is an output, wherever it lies") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const std::string helper = "float helper(float x) { return x; }\n";
    const auto refused = [&](const fs::path& file, const std::vector<std::string>& arguments) {
        const std::string before = text_of(file);
        CAPTURE(file.string(), arguments);
        const test::Outcome outcome = run_lockstep(arguments);
        CHECK(outcome.status == 2);
        CHECK_THAT(outcome.err, Catch::Contains(": cannot be written: ") && Catch::Contains("the run reads"));
        CHECK(text_of(file) == before);
    };
    SECTION("what a function includes") {
        const fs::path included = setting.input.write("inc.glsl", helper);
        const fs::path link = setting.input.path() / "link.json", hard = setting.input.path() / "hard.json";
        fs::create_symlink(included, link);
        fs::create_hard_link(included, hard);
        const std::string file =
            setting.input.write("g.glsl", "#include \"inc.glsl\"\nfloat f(float x) { return helper(x); }\n").string();
        const std::string table = setting.input.write("t.csv", "x,result\n1,1\n").string();
        for (const fs::path& output : {included, link, hard, fs::path(table), fs::path(file)})
            refused(included,
                    {"function", file, "f", "--table", table, "--gl", test::software_gl(), "--json", output.string()});
    }
    SECTION("what a stage includes, deeper and beside the folder") {
        const std::string vertex = text_of("shaders/collision/collision_pass.vert");
        for (const char* place : {"sub/mine.glsl", "../beside.glsl"}) {
            const std::string include = place;
            const fs::path folder = setting.input.path() / "m";
            fs::create_directories(folder / "sub");
            std::string text = vertex;
            text.insert(text.find("void main()"), "#include \"" + include + "\"\n");
            const fs::path included = folder / include;
            std::ofstream(included) << helper;
            std::ofstream(folder / "collision_pass.vert") << text;
            const std::string shaders = folder.string(), output = included.string();
            const std::vector<std::string> run{setting.scene, "--gl", test::software_gl(), "--shaders", shaders};
            refused(included, test::joined(test::joined({"check"}, run), {"--frames", "2", "--json", output}));
            refused(included, test::joined(test::joined({"check"}, run), {"--frames", "2", "--hashes", output}));
            refused(included, test::joined(test::joined({"record"}, run), {"--frames", "2", "-o", output}));
            refused(included, test::joined(test::joined({"render"}, run), {"--side", "gpu", "-o", output}));
            refused(included, test::joined(test::joined({"capsule", "cut"}, run),
                                           {"--frame", "1", "--particle", "1", "-o", output}));
        }
    }
    SECTION("of the other systems, and of lockstep itself") {
        const fs::path mesh = setting.input.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n");
        const std::string scene =
            setting.input
                .write("mesh.json", test::small_scene.substr(0, test::small_scene.rfind("\"obstacles\"")) +
                                        "\"obstacles\": [{\"shape\": \"mesh\", \"file\": \"a.obj\", \"height\": 1}]}")
                .string();
        refused(mesh, {"check", scene, "--gl", test::software_gl(), "--frames", "2", "--json", mesh.string()});
        const fs::path folder = setting.input.path() / "dust";
        fs::create_directories(folder / "sub");
        std::string text = text_of("shaders/dust/draw.vert");
        text.insert(text.find("void main()"), "#include \"sub/mine.glsl\"\n");
        std::ofstream(folder / "sub/mine.glsl") << helper;
        std::ofstream(folder / "draw.vert") << text;
        const fs::path included = folder / "sub/mine.glsl";
        const std::vector<std::string> run{"data/scenes/dust/free_fall.json",
                                           "--particles",
                                           "100",
                                           "--gl",
                                           test::software_gl(),
                                           "--shaders",
                                           folder.string()};
        refused(included, test::joined(test::joined({"check"}, run), {"--frames", "2", "--json", included.string()}));
    }
}

TEST_CASE("output_files: no shader is replaced, though no run reads that file") {
    const test::TemporaryFolder folder;
    const fs::path mine = folder.write("mine.comp", "#version 460\nvoid main() {}\n");
    const fs::path other = folder.write("other.comp", "void main() {}\n");
    const test::Outcome outcome = run_lockstep({"examine", mine.string(), "--json", other.string()});
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Catch::Contains("it is a shader by its name"));
    CHECK(text_of(other) == "void main() {}\n");
}

TEST_CASE("output_files: on a full disk there is the verdict, one line of error, and no file") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const std::string report = setting.path("report.json");
    const std::string hashes = setting.path("hashes");
    const std::string images = setting.path("images");
    SECTION("report") {
        const test::Outcome outcome = setting.check({"--frames", "3", "--json", report}, disk_of(100));
        check_full(outcome, report);
        CHECK_THAT(outcome.out, Catch::Contains("AGREE"));
    }
    SECTION("hashes") { check_full(setting.check({"--frames", "3", "--hashes", hashes}, disk_of(100)), hashes); }
    SECTION("images") {
        check_full(setting.check({"--frames", "3", "--images", images}, disk_of(10)), images + "/cdt_reference.png");
    }
    SECTION("the second of two") {
        check_full(setting.check({"--frames", "3", "--json", report, "--hashes", hashes}, disk_of(100)), report);
        // Shorter than the report, so that only the hashes fit.
        check_full(setting.check({"--frames", "3", "--images", images, "--hashes", hashes}, disk_of(200)),
                   images + "/cdt_reference.png");
    }
    SECTION("rendered frame") {
        check_full(run_lockstep({"render", setting.scene, "-o", setting.path("frame.png")}, disk_of(50)),
                   setting.path("frame.png"));
    }
    CHECK(setting.left().empty());
}

TEST_CASE("output_files: a file from before stays when the new one cannot be written") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const std::string report = setting.output.write("report.json", "from before").string();
    check_full(setting.check({"--frames", "3", "--json", report}, disk_of(100)), report);
    CHECK(text_of(report) == "from before");
    CHECK(setting.check({"--frames", "3", "--json", report}).status == 0);
    CHECK_THAT(text_of(report), Catch::StartsWith("{\n"));
    CHECK(setting.left() == Names{"report.json"});
}

TEST_CASE("output_files: through a symbolic link, the file behind it is written") {
    const Setting setting;
    const std::string picture = setting.path("picture.png");
    fs::create_symlink("picture.png", setting.path("link"));
    CHECK(run_lockstep({"render", setting.scene, "-o", setting.path("link")}).status == 0);
    CHECK(fs::is_symlink(setting.path("link")));
    CHECK_THAT(text_of(picture), Catch::StartsWith("\x89PNG"));
    CHECK(setting.left() == Names{"link", "picture.png"});
}

TEST_CASE("output_files: where one of them fails, what was there before is there again") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const std::string report = setting.output.write("report.json", "from before").string();
    CHECK(test::refusal(setting.check({"--frames", "3", "--json", report, "--hashes", "/dev/full"})) ==
          "/dev/full: cannot be written: No space left on device");
    CHECK(test::refusal(setting.check({"--json", report, "--hashes", setting.path("no/hashes")})) ==
          setting.path("no/hashes") + ": cannot be written: No such file or directory");
    const std::string page = setting.output.write("report.html", "from before").string();
    CHECK(test::refusal(setting.check({"--json", page, "--report", setting.output.path()})) ==
          page + ": cannot be written: two outputs have this name");
    CHECK(text_of(report) == "from before");
    CHECK(text_of(page) == "from before");
    CHECK(setting.left() == Names{"report.html", "report.json"});
}

TEST_CASE("output_files: an output that is an input is refused, by whatever name") {
    const Setting setting;
    const std::string before = text_of(setting.scene);
    fs::create_symlink(setting.scene, setting.path("soft"));
    fs::create_hard_link(setting.scene, setting.path("hard"));
    const std::string other_way = (setting.output.path() / ".." / setting.input.path().filename() / "scene.json");
    const std::string reads = ", which the run reads";
    CHECK(test::refusal(setting.check({"--json", setting.scene})) ==
          setting.scene + ": cannot be written: the run reads it");
    for (const std::string& name : {setting.path("soft"), setting.path("hard"), other_way}) {
        CHECK_THAT(test::refusal(setting.check({"--hashes", name})), Catch::EndsWith(reads));
        CHECK_THAT(test::refusal(run_lockstep({"render", setting.scene, "-o", name})), Catch::EndsWith(reads));
        CHECK_THAT(test::refusal(run_lockstep({"study", setting.scene, "--csv", name})), Catch::EndsWith(reads));
        CHECK_THAT(test::refusal(run_lockstep({"record", setting.scene, "-o", name})), Catch::EndsWith(reads));
        CHECK_THAT(test::refusal(
                       run_lockstep({"capsule", "cut", setting.scene, "--frame", "1", "--particle", "1", "-o", name})),
                   Catch::EndsWith(reads));
    }
    const std::string shader =
        setting.input.write("collision_pass.vert", "#version 330 core\nvoid main() {}\n").string();
    CHECK_THAT(test::refusal(setting.check({"--shaders", setting.input.path(), "--json", shader})),
               Catch::EndsWith("the run reads it"));
    CHECK(text_of(setting.scene) == before);
}

TEST_CASE("output_files: two outputs that are one file through a link are refused") {
    const Setting setting;
    fs::create_symlink("not there yet", setting.path("soft"));
    fs::create_directory_symlink(setting.output.path(), setting.input.path() / "way");
    setting.output.write("a", "from before");
    fs::create_hard_link(setting.path("a"), setting.path("hard"));
    const auto refused = [&](const std::string& first, const std::string& second) {
        CHECK(test::refusal(setting.check({"--json", first, "--hashes", second})) ==
              second + ": cannot be written: it is " + first + ", another output");
    };
    refused(setting.path("not there yet"), setting.path("soft"));
    refused(setting.path("a"), setting.path("hard"));
    refused(setting.path("new"), setting.input.path() / "way" / "new");
    CHECK(setting.left() == Names{"a", "hard", "soft"});
}

TEST_CASE("output_files: a file that was there keeps its mode") {
    const Setting setting;
    const std::string picture = setting.output.write("picture.png", "from before").string();
    fs::permissions(picture, fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
    CHECK(run_lockstep({"render", setting.scene, "-o", picture}).status == 0);
    CHECK(fs::status(picture).permissions() ==
          (fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read));
}

TEST_CASE("output_files: a report goes beside whatever is there") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    fs::create_directory(setting.path("lockstep"));
    CHECK(setting.check({"--frames", "2", "--images", setting.output.path()}).status == 0);
}

TEST_CASE("output_files: a name as long as a folder takes") {
    const Setting setting;
    CHECK(run_lockstep({"render", setting.scene, "-o", setting.path(std::string(255, 'n'))}).status == 0);
    CHECK(setting.left() == Names{std::string(255, 'n')});
}

TEST_CASE("output_files: to standard output, after the report; by another name of it, refused") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const std::string out = setting.output.write("out", "").string();
    test::Surroundings to_file;
    to_file.standard_output = out;
    CHECK(setting.check({"--frames", "2", "--hashes", "/dev/stdout"}, to_file).status == 0);
    CHECK_THAT(text_of(out), Catch::StartsWith("scene ") && Catch::Matches("(.|\n)*verdict   AGREE.*\n(\\d .*\n){2}"));
    CHECK_THAT(setting.check({"--frames", "2", "--hashes", out}, to_file).err,
               Catch::Contains("cannot be written: standard output goes there"));
    CHECK_THAT(test::refusal(setting.check({"--json", "-"})), Catch::Contains("/dev/stdout is standard output"));
    CHECK(setting.left() == Names{"out"});
}

TEST_CASE("output_files: they are there where nobody reads the report, or it cannot be written") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const std::string report = setting.path("report.json");
    test::Surroundings surroundings;
    SECTION("a pipe that nobody reads") {
        surroundings.nobody_reads = true;
        CHECK(setting.check({"--frames", "2", "--json", report}, surroundings).status == 0);
        CHECK(setting.check({"--frames", "2"}, surroundings).signal == SIGPIPE);
    }
    SECTION("a full disk") {
        surroundings.standard_output = "/dev/full";
        const test::Outcome outcome = setting.check({"--frames", "2", "--json", report}, surroundings);
        CHECK(outcome.status == 2);
        CHECK(outcome.err == "lockstep: standard output: cannot be written: No space left on device\n");
    }
    SECTION("closed: no other file takes its place") {
        surroundings.standard_output = "";
        CHECK(setting.check({"--frames", "2", "--json", report}, surroundings).status == 2);
        CHECK(setting.check({"--frames", "2", "--json", report, "--quiet"}, surroundings).status == 0);
    }
    CHECK_THAT(text_of(report), Catch::StartsWith("{\n") && Catch::EndsWith("}\n"));
    CHECK(setting.left() == Names{"report.json"});
}

} // namespace lockstep::test::output_files_test
