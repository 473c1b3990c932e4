#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::foreign_misuse_test {

namespace fs = std::filesystem;

namespace {

/// What `check` says of tests/foreign/web_engine after a change; FOLDER stands for its place.
std::string said_after(const std::function<void(const fs::path&)>& change) {
    const test::TemporaryFolder shaders;
    for (const char* name : {"collision_pass.vert", "collision_pass.geom", "bindings.json"})
        fs::copy_file(fs::path("tests/foreign/web_engine") / name, shaders.path() / name);
    change(shaders.path());
    std::string said =
        test::refusal(test::run_lockstep({"check", "data/scenes/lattice.json", "--particles", "50", "--frames", "1",
                                          "--gl", test::software_gl(), "--shaders", shaders.path()}));
    for (std::size_t at = 0; (at = said.find(shaders.path().string())) != std::string::npos;)
        said.replace(at, shaders.path().string().size(), "FOLDER");
    return said;
}

void replace(const fs::path& file, const std::string& from, const std::string& to) {
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    REQUIRE(text.find(from) != std::string::npos);
    std::ofstream(file, std::ios::binary) << text.replace(text.find(from), from.size(), to);
}

} // namespace

TEST_CASE("foreign misuse: an output that is not flat, with its line and the remedy") {
    if (!test::have_software_gl())
        return;
    CHECK(said_after([](const fs::path& folder) {
              replace(folder / "collision_pass.vert", "precise flat out vec3", "precise out vec3");
          }) == "collision_pass: shader FOLDER/collision_pass.vert:15: output nextPosition is interpolated, but "
                "shaders/collision/collision_pass.frag:7 reads it `flat`; right is `flat out vec3 nextPosition;`");
}

TEST_CASE("foreign misuse: the shipped geometry stage behind a vertex stage of its own names") {
    if (!test::have_software_gl())
        return;
    CHECK(said_after([](const fs::path& folder) { fs::remove(folder / "collision_pass.geom"); }) ==
          "shader shaders/collision/collision_pass.geom:9: input v_Position is written by no stage before it "
          "(FOLDER/collision_pass.vert); an empty collision_pass.geom leaves the geometry stage out");
}

TEST_CASE("foreign misuse: a misspelt bindings.json by name") {
    if (!test::have_software_gl())
        return;
    CHECK(said_after([](const fs::path& folder) { fs::rename(folder / "bindings.json", folder / "binding.json"); }) ==
          "shader folder FOLDER: binding.json is read by nobody; right is bindings.json");
}

TEST_CASE("foreign misuse: #version may stand in a file that is included") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder shaders;
    for (const char* name : {"collision_pass.vert", "collision_pass.geom", "bindings.json"})
        fs::copy_file(fs::path("tests/foreign/web_engine") / name, shaders.path() / name);
    std::ofstream(shaders.path() / "head.glsl") << "#version 410 core\n";
    replace(shaders.path() / "collision_pass.vert", "#version 410 core", "#include \"head.glsl\"");
    const test::Outcome outcome =
        test::run_lockstep({"check", "data/scenes/x_streams.json", "--particles", "500", "--frames", "3", "--gl",
                            test::software_gl(), "--shaders", shaders.path(), "--no-render"});
    INFO(outcome.err);
    CHECK(outcome.status == 0);
}

} // namespace lockstep::test::foreign_misuse_test
