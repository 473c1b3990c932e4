#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::past_end_test {

using Catch::Contains;
using test::plant;
using test::refusal;
using test::run_lockstep;

namespace {

const std::string guard = "self >= u_ParticleCount";

/// What two frames of the small scene say, 300 particles, which no group divides.
std::string refusal_of(const test::SceneSetting& setting, const std::vector<std::string>& options) {
    return refusal(run_lockstep(setting.command(test::joined({"--frames", "2", "--no-render"}, options))));
}

/// The shaders of a folder of tests/foreign, one of them changed.
void copy_foreign(const test::TemporaryFolder& to, const std::string& folder, const std::string& file,
                  const std::string& what, const std::string& by) {
    for (const auto& entry : std::filesystem::directory_iterator("tests/foreign/" + folder)) {
        std::ifstream stream(entry.path());
        std::string text{std::istreambuf_iterator<char>(stream), {}};
        if (entry.path().filename() == file) {
            const std::size_t at = text.find(what);
            REQUIRE(at != std::string::npos);
            text.replace(at, what.size(), by);
        }
        to.write(entry.path().filename().string(), text);
    }
}

} // namespace

TEST_CASE("past end: a compute stage of the collision step without its guard is an error that names file and buffer") {
    if (!test::have_software_gl())
        return;
    const std::string expected = " (300 particles), at item 300; expected no write from item 300 on";
    struct Planted {
        std::string file, by, writer, buffer;
        std::vector<std::string> options;
    };
    for (const auto& [file, by, writer, buffer, options] :
         {Planted{"collision_pass.comp", "false", "collision_pass", "After", {"--set", "step=compute"}},
          Planted{
              "collision_pass.comp", "self > u_ParticleCount", "collision_pass", "After", {"--set", "step=compute"}},
          Planted{"depth_pass.comp", "false", "depth_pass", "After", {"--set", "search=depth"}}}) {
        const test::SceneSetting setting("check");
        plant(setting.shaders, file, guard, by);
        CHECK(refusal_of(setting, options) == writer + " (" + (setting.shaders.path() / file).string() +
                                                  ") wrote past the end of " + buffer + expected);
    }
}

TEST_CASE("past end: the texels' buffer is watched as the particles' is, and the stage that wrote is named") {
    if (!test::have_software_gl())
        return;
    const test::SceneSetting setting("check");
    plant(setting.shaders, "clear_nearest.comp", "if (texel < nearest.length())\n        nearest[texel]",
          "nearest[texel + 1u]");
    const std::string said = refusal_of(setting, {"--set", "step=compute"});
    CHECK_THAT(said, Catch::StartsWith("clear_nearest (") &&
                         Contains("wrote past the end of Nearest (3072 texels), at item 3072"));
}

TEST_CASE("past end: blocks that bindings.json binds by member are watched") {
    if (!test::have_software_gl())
        return;
    const test::SceneSetting setting("check");
    copy_foreign(setting.shaders, "structs_with_a_head", "collision_pass.comp", "i >= old.many", "false");
    CHECK_THAT(refusal_of(setting, {"--set", "step=compute"}),
               Catch::StartsWith("collision_pass (") && Contains("collision_pass.comp) wrote past the end of New (300 "
                                                                 "particles); expected no write from item 300 on"));
}

TEST_CASE("past end: shipped and foreign compute stages write nothing there") {
    if (!test::have_software_gl())
        return;
    const test::SceneSetting setting("check");
    for (const std::string option : {"step=compute", "search=octree", "search=depth"}) {
        const test::Outcome outcome =
            run_lockstep(setting.command({"--frames", "2", "--no-render", "--set", option, "--werror-shaders"}));
        CHECK(outcome.err.empty());
        CHECK_THAT(outcome.out, Contains("AGREE"));
    }
}

} // namespace lockstep::test::past_end_test
