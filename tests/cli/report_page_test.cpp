#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::report_page_test {

using test::run_lockstep;
namespace fs = std::filesystem;

namespace {

/// A data folder with the shipped shaders and a page template.
struct Setting {
    explicit Setting(const std::string& page = "<main></main>\n<!-- lockstep data -->\n") {
        fs::create_directory_symlink(fs::absolute("shaders"), data.path() / "shaders");
        if (!page.empty())
            data.write("report.html", page);
    }

    test::TemporaryFolder data, input, output;
    std::string scene = input.write("scene.json", test::small_scene).string();
    std::string folder = (output.path() / "report").string();

    [[nodiscard]] test::Outcome check(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments{"check", scene, "--gl", test::software_gl(), "--report", folder};
        arguments.insert(arguments.end(), more.begin(), more.end());
        test::Surroundings surroundings;
        surroundings.environment = {{"LOCKSTEP_DATA", data.path().string()}};
        return run_lockstep(arguments, surroundings);
    }

    [[nodiscard]] std::string page() const {
        std::ifstream stream(folder + "/report.html", std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    /// What the page's head says.
    [[nodiscard]] nlohmann::json head() const {
        const std::string text = page();
        const std::string before = "<script type=\"application/json\" id=\"lockstep-head\">";
        const std::size_t start = text.find(before) + before.size();
        return nlohmann::json::parse(text.substr(start, text.find("</script>", start) - start));
    }
};

} // namespace

TEST_CASE("report page: where it is not built, one line says what to run, before the run") {
    const Setting setting("");
    CHECK(test::refusal(setting.check({"--frames", "100000000"})) ==
          "report: the page is not built, there is no " + setting.data.path().string() +
              "/report.html; run scripts/build_report_page.sh");
    CHECK(test::names_in(setting.output.path()).empty());
}

TEST_CASE("report page: what cannot be written is told before the run") {
    Setting setting;
    setting.folder = setting.output.write("way", "in the").string();
    CHECK(test::refusal(setting.check({"--frames", "100000000"})) ==
          setting.folder + ": cannot be made a folder: a file of that name is in the way");
}

TEST_CASE("report page: a template without a place for data is refused before the run") {
    const Setting setting("<main></main>");
    CHECK(test::refusal(setting.check({"--frames", "100000000"})) ==
          "report: " + setting.data.path().string() +
              "/report.html has no place for data; run scripts/build_report_page.sh again");
}

TEST_CASE("report page: one file with the run's data, the template round it") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    CHECK(setting.check({"--frames", "5"}).status == 0);
    CHECK(test::names_in(setting.folder) == std::vector<std::string>{"report.html"});
    CHECK_THAT(setting.page(), Catch::StartsWith("<main></main>\n<script") && Catch::EndsWith("</script>\n\n"));
    const nlohmann::json head = setting.head();
    CHECK(head.at("report").at("verdict") == "AGREE");
    CHECK(head.at("width") == 64);
    CHECK(head.at("frames").size() == 5);
    CHECK(head.at("items").size() > 0);
    CHECK(head.at("commands").at(0).at("line") ==
          "lockstep check " + setting.scene + " --frames 5 --gl " + test::software_gl());
}

TEST_CASE("report page: nothing in the data ends its element") {
    if (!test::have_software_gl())
        return;
    Setting setting;
    fs::create_directory(setting.input.path() / "<");
    setting.scene = setting.input.write("</script><b>&amp;", test::small_scene).string();
    CHECK(setting.check({"--frames", "2"}).status == 0);
    CHECK(setting.page().find("</script><b>") == std::string::npos);
    CHECK_THAT(setting.head().at("report").at("scene").get<std::string>(), Catch::Contains("</script><b>&amp;"));
}

TEST_CASE("report page: a planted bug is named, and its items are listed with the wrong step") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.vert", " && len < particle_min_length", "");
    CHECK(setting.check({"--frames", "8", "--shaders", shaders.path().string()}).status == 1);
    const nlohmann::json head = setting.head();
    CHECK(head.at("report").at("verdicts").at("particle_cause").at("best").at(0).at("deviations") ==
          nlohmann::json{"last_found_instead_of_nearest"});
    const nlohmann::json item = head.at("items").at(0);
    CHECK(item.at("class") == 3);
    CHECK_THAT(item.at("step").get<std::string>(), Catch::StartsWith("texel ("));
    CHECK_THAT(item.at("command").get<std::string>(), Catch::StartsWith("lockstep explain "));

    // The artefact alone repeats the verdict: the command is on the page, the file beside it.
    const std::string capsule = setting.folder + "/capsule.json";
    CHECK(test::names_in(setting.folder) == std::vector<std::string>{"capsule.json", "report.html"});
    CHECK(head.at("commands").back().at("line") == "lockstep capsule show " + capsule);
    const test::Outcome shown = run_lockstep({"capsule", "show", capsule});
    CHECK(shown.status == 1);
    CHECK_THAT(shown.out, Catch::Contains("> " + item.at("step").get<std::string>()) && Catch::Contains("DIVERGENT"));
}

TEST_CASE("report page: of a trace, by check or by report, with its step tables and command lines") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.vert", " && len < particle_min_length", "");
    const std::string trace = (setting.input.path() / "run.h5").string();
    test::Surroundings surroundings;
    surroundings.environment = {{"LOCKSTEP_DATA", setting.data.path().string()}};
    REQUIRE(run_lockstep({"record", setting.scene, "--gl", test::software_gl(), "--shaders", shaders.path(), "--frames",
                          "8", "--cdt", "-o", trace})
                .status == 0);
    CHECK(run_lockstep({"check", "--trace", trace, "--report", setting.folder, "--quiet"}, surroundings).status == 1);
    const nlohmann::json checked = setting.head();
    const test::Outcome reported = run_lockstep({"report", trace, "-o", setting.folder}, surroundings);
    CHECK(reported.status == 1);
    CHECK_THAT(reported.out, Catch::Contains("DIVERGENT"));
    const nlohmann::json head = setting.head();
    CHECK(head == checked);
    CHECK(head.at("report").at("verdicts").at("particle_cause").at("best").at(0).at("deviations") ==
          nlohmann::json{"last_found_instead_of_nearest"});
    const nlohmann::json item = head.at("items").at(0);
    CHECK(item.contains("step"));
    CHECK_THAT(item.at("command").get<std::string>(), Catch::StartsWith("lockstep explain --trace " + trace));
    CHECK(test::refusal(run_lockstep({"report", trace, "-o", trace}, surroundings)) ==
          trace + ": cannot be made a folder: a file of that name is in the way");
}

TEST_CASE("report page: tells of the study that lies beside it; what is no study is refused before the run") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    fs::create_directory(setting.folder);
    const std::string study = setting.folder + "/study.json";
    REQUIRE(run_lockstep({"study", setting.scene, "--frames", "4", "--json", study}).status == 0);
    CHECK(setting.check({"--frames", "2"}).status == 0);
    CHECK(setting.head().at("study").at("frames").size() == 3);
    for (const char* other :
         {"", "{", "[]", "{}", R"({"total": {}, "frames": []})", R"({"frames": [1], "total": 2})"}) {
        CAPTURE(other);
        std::ofstream(study) << other;
        CHECK(test::refusal(setting.check({"--frames", "100000000"})) ==
              study + ": is not what `lockstep study SCENE --json` writes; write it again, or remove it");
    }
}

TEST_CASE("report page: a capsule that cannot be made is told on standard error, on the page and in JSON") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const test::TemporaryFolder shaders;
    test::plant(shaders, "collision_pass.vert", " && len < particle_min_length", "");
    test::plant(shaders, "collision_pass.vert", "#ifdef LOCKSTEP_TRACE\n// Drawn",
                "#ifdef LOCKSTEP_TRACE\nnonsense;\n// Drawn");
    const test::Outcome outcome = setting.check({"--frames", "8", "--shaders", shaders.path().string()});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.err, Catch::StartsWith("lockstep: no capsule of the first divergent particle: ") &&
                                Catch::Contains("collision_pass.vert:"));
    CHECK(test::names_in(setting.folder) == std::vector<std::string>{"report.html"});
    CHECK_THAT(setting.head().at("report").at("notes").back().get<std::string>(),
               Catch::StartsWith("no capsule of the first divergent particle: "));
}

} // namespace lockstep::test::report_page_test
