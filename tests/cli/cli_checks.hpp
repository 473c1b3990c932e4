#pragma once
#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/cli/run_program.hpp"
#include "tests/gpu/any_context.hpp"
#include "tests/skip.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test {

/// 300 particles that meet, over a plane; small images, so that a run takes little.
inline const std::string small_scene = R"({
  "constants": { "collision_range": 0.1 },
  "image": [64, 48], "render": [40, 30],
  "emitters": [{ "count": 300, "min": [-0.4, -0.4, -0.4], "max": [0.4, 0.4, 0.4], "speed": 0.5 }],
  "obstacles": [{ "shape": "plane", "size": [1, 1], "position": [0, -0.6, 0] }]
})";

/// --shaders with this folder, unless it is empty, which the program refuses.
inline std::vector<std::string> shader_options(const TemporaryFolder& shaders) {
    if (std::filesystem::is_empty(shaders.path()))
        return {};
    return {"--shaders", shaders.path()};
}

/// `words` and, after them, `more`.
inline std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// The small scene in a folder of its own, and one for shaders, to run a verb on.
class SceneSetting {
  public:
    explicit SceneSetting(std::string verb) : verb_(std::move(verb)) {}
    TemporaryFolder folder, shaders;
    std::string scene = folder.write("scene.json", small_scene).string();

    /// The verb on the scene with these shaders, on the software GL.
    [[nodiscard]] std::vector<std::string> command(const std::vector<std::string>& options = {}) const {
        return joined(joined({verb_, scene, "--gl", test::software_gl()}, shader_options(shaders)), options);
    }

  private:
    std::string verb_;
};

/// Holds status 2, nothing on standard output, and one line on standard error, "lockstep: MESSAGE"; gives MESSAGE.
inline std::string refusal(const Outcome& outcome) {
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    REQUIRE_THAT(outcome.err, Catch::StartsWith("lockstep: ") && Catch::EndsWith("\n"));
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    return outcome.err.substr(10, outcome.err.size() - 11);
}

/// Names of everything in a folder, sorted.
inline std::vector<std::string> names_in(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

/// Whether the software GL is there; if not, the test is skipped with the reason.
inline bool have_software_gl() { return open_context(software_gl()).has_value(); }

/// And whether a program can be given a terminal: a container without /dev/pts has none.
inline bool have_terminal() {
    const std::string missing = why_no_terminal();
    if (!missing.empty())
        skip(missing, "LOCKSTEP_REQUIRE_TERMINAL");
    return missing.empty();
}

} // namespace lockstep::test
