#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::foreign_shaders_test {

namespace fs = std::filesystem;
using test::run_lockstep;

/// Shaders from elsewhere, each in a folder of tests/foreign with bindings.json for names of its own, and planted.json:
/// a mistake to plant, what the report says of it, and which files run as SPIR-V.
namespace {

std::string content(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

struct Foreign {
    explicit Foreign(const fs::path& folder) : planted(nlohmann::json::parse(content(folder / "planted.json"))) {
        for (const fs::directory_entry& entry : fs::directory_iterator(folder))
            if (entry.path().filename() != "planted.json" && entry.path().extension() != ".hlsl")
                fs::copy_file(entry.path(), shaders.path() / entry.path().filename());
        if (planted.contains("spirv"))
            for (const std::string file : planted["spirv"])
                fs::rename(shaders.path() / file, texts.path() / file);
        compile();
    }

    /// What runs as SPIR-V, for OpenGL.
    void compile() const {
        for (const fs::directory_entry& text : fs::directory_iterator(texts.path())) {
            const std::string module = shaders.path() / (text.path().filename().string() + ".spv");
            const std::string command =
                "glslangValidator -G -o '" + module + "' '" + text.path().string() + "' >/dev/null";
            REQUIRE(std::system(command.c_str()) == 0);
        }
    }

    [[nodiscard]] test::Outcome check() const {
        const bool of_collision = !planted.contains("scene");
        std::vector<std::string> words{"check",      "data/scenes/" + planted.value("scene", "x_streams.json"),
                                       "--gl",       test::software_gl(),
                                       "--shaders",  shaders.path(),
                                       "--frames",   std::to_string(planted.value("frames", 20)),
                                       "--no-render"};
        if (planted.contains("particles") || of_collision)
            words.insert(words.end(), {"--particles", std::to_string(planted.value("particles", 4000))});
        if (planted.contains("set"))
            words.insert(words.end(), {"--set", planted["set"]});
        return run_lockstep(words);
    }

    void plant() const {
        const std::string name = planted["file"];
        const fs::path file = (fs::exists(texts.path() / name) ? texts : shaders).path() / name;
        std::string text = content(file);
        const std::string find = planted["find"], put = planted["put"];
        const std::size_t place = text.find(find);
        REQUIRE(place != std::string::npos);
        std::ofstream(file, std::ios::binary) << text.replace(place, find.size(), put);
        compile();
    }

    test::TemporaryFolder shaders, texts;
    nlohmann::json planted;
};

} // namespace

TEST_CASE(
    "foreign shaders: with names, blocks, buffers and images of their own they agree; a planted mistake is named") {
    if (!test::have_software_gl())
        return;
    std::size_t count = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator("tests/foreign")) {
        INFO(entry.path().string());
        const Foreign foreign(entry.path());
        const test::Outcome right = foreign.check();
        INFO(right.err);
        CHECK(right.status == 0);
        CHECK_THAT(right.out, Catch::Contains("verdict   AGREE"));
        foreign.plant();
        const test::Outcome wrong = foreign.check();
        CHECK(wrong.status == 1);
        CHECK_THAT(wrong.out, Catch::Contains("verdict   DIVERGENT"));
        CHECK_THAT(wrong.out, Catch::Contains(std::string(foreign.planted["says"])));
        ++count;
    }
    CHECK(count == 15);
}

} // namespace lockstep::test::foreign_shaders_test
