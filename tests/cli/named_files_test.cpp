#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/cli/run_program.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::named_files_test {

/// Scenes that name files: graphs and a texture.
using Catch::Contains;
using test::refusal;
using test::run_lockstep;
namespace fs = std::filesystem;

namespace {

/// Copies of two shipped scenes, with what they name.
struct NamingScenes {
    test::TemporaryFolder folder;
    fs::path data = folder.path() / "data";
    std::string graphs = (data / "scenes/lifecycle/graphs.json").string(),
                texture = (data / "scenes/lifecycle/kgon_cuts.json").string(),
                graph = (data / "graphs/fire.json").string(), picture = (data / "scenes/lifecycle/leaf.png").string();

    NamingScenes() {
        fs::create_directories(data / "scenes/lifecycle");
        fs::copy("data/graphs", data / "graphs");
        for (const char* file : {"graphs.json", "kgon_cuts.json", "leaf.png"})
            fs::copy(fs::path("data/scenes/lifecycle") / file, data / "scenes/lifecycle" / file);
    }
    [[nodiscard]] std::string out(const std::string& name) const { return (folder.path() / name).string(); }
};

std::vector<std::string> small(std::vector<std::string> words) {
    return test::joined(std::move(words), {"--particles", "40", "--gl", test::software_gl()});
}

} // namespace

TEST_CASE("named files: a recording and a capsule carry what their scene names, and are read without it") {
    const NamingScenes scenes;
    const std::string recording = scenes.out("graphs.h5"), drawn = scenes.out("texture.h5"),
                      capsule = scenes.out("capsule.json");
    REQUIRE(run_lockstep(small({"record", scenes.graphs, "--frames", "4", "-o", recording})).status == 0);
    REQUIRE(run_lockstep(small({"record", scenes.texture, "--frames", "3", "-o", drawn})).status == 0);
    REQUIRE(run_lockstep(small({"capsule", "cut", scenes.graphs, "--frame", "3", "--pass", "emit", "--item", "0", "-o",
                                capsule}))
                .status == 0);
    fs::remove_all(scenes.data);
    for (const std::string& file : {recording, drawn}) {
        const test::Outcome checked = run_lockstep({"check", "--trace", file});
        INFO(checked.err);
        CHECK(checked.status == 0);
        CHECK_THAT(checked.out, Contains("verdict   AGREE"));
    }
    CHECK(run_lockstep({"explain", "--trace", recording, "--frame", "3", "--pass", "emit", "--item", "0"}).status == 0);
    const std::string again = scenes.out("again.json");
    CHECK(run_lockstep(
              {"capsule", "cut", "--trace", recording, "--frame", "3", "--pass", "emit", "--item", "0", "-o", again})
              .status == 0);
    for (const std::string& file : {capsule, again})
        CHECK(run_lockstep({"capsule", "show", file}).status == 0);
}

TEST_CASE(
    "named files: a capsule that carries them wrongly, or not at all, is one line, and nothing beside it is read") {
    const NamingScenes scenes;
    const std::string file = (scenes.data / "scenes/lifecycle/capsule.json").string();
    REQUIRE(run_lockstep(
                small({"capsule", "cut", scenes.graphs, "--frame", "2", "--pass", "emit", "--item", "0", "-o", file}))
                .status == 0);
    const nlohmann::json right = nlohmann::json::parse(std::ifstream(file));
    const auto told = [&](const nlohmann::json& files) {
        nlohmann::json wrong = right;
        wrong["options"]["files"] = files;
        if (files.is_null())
            wrong["options"].erase("files");
        std::ofstream(file) << wrong;
        return refusal(run_lockstep({"capsule", "show", file}));
    };
    const std::string name = "../../graphs/fire.json";
    CHECK_THAT(told(nullptr), Contains("which this file does not carry along"));
    CHECK_THAT(told(nlohmann::json::object()), Contains("which this file does not carry along"));
    nlohmann::json files = right["options"]["files"];
    REQUIRE(files.contains(name));
    files[name] = "not base64!";
    CHECK_THAT(told(files), Contains("is no base64"));
    files[name] = 7;
    CHECK_THAT(told(files), Contains("7 is not a text"));
    files[name] = "e30="; // {}
    CHECK_THAT(told(files), Contains("capsule.json: " + name));
    CHECK_THAT(told(nlohmann::json::array()), Contains("is not an object"));
}

TEST_CASE("named files: none is overwritten by a run that reads it") {
    const NamingScenes scenes;
    const std::string reads = "cannot be written: the run reads it";
    CHECK_THAT(refusal(run_lockstep(small({"record", scenes.graphs, "-o", scenes.graph}))), Catch::EndsWith(reads));
    CHECK_THAT(refusal(run_lockstep(small({"check", scenes.graphs, "--json", scenes.graph}))), Catch::EndsWith(reads));
    CHECK_THAT(refusal(run_lockstep(small({"check", scenes.texture, "--hashes", scenes.picture}))),
               Catch::EndsWith(reads));
    CHECK_THAT(refusal(run_lockstep({"render", scenes.texture, "--side", "cpu", "-o", scenes.picture})),
               Catch::EndsWith(reads));
}

} // namespace lockstep::test::named_files_test
