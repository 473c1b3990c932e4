#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "crosscheck/scene/scene_file.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/shader_files.hpp"
#include "tests/collision/twin/told_causes.hpp"
#include "tests/collision/twin/twin_scenes.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::wrong_shaders_test {

namespace {

/// What follows `word` in a text, up to `end`.
std::string after(const std::string& text, const std::string& word, char end) {
    const std::size_t at = text.find(word);
    REQUIRE(at != std::string::npos);
    const std::size_t from = at + word.size();
    return text.substr(from, text.find(end, from) - from);
}

} // namespace

TEST_CASE("wrong shaders: the cause of each, whatever its style, is told by its name") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const std::vector<std::filesystem::path> files = test::files_in("tests/collision/wrong_shaders");
    CHECK(files.size() >= 28);
    for (const std::filesystem::path& file : files) {
        const std::string text = test::content(file), cause = after(text, "// cause: ", ',');
        const test::TemporaryFolder shaders;
        shaders.write("collision_pass" + file.extension().string(), text);
        const Scene scene = load_scene("data/scenes/stress/" + after(text, ", in ", '\n') + ".json", {});
        const CheckReport report = test::check_twins(scene, 8, shaders.path());
        const std::vector<std::string> told = test::told_causes(report);
        std::string all;
        for (const std::string& name : told)
            all += name + " ";
        INFO(file << ": " << verdict_name(report.verdict) << ", told: " << all);
        CHECK(report.verdict == Verdict::divergent);
        if (cause == "none")
            CHECK(told.empty());
        else
            CHECK(std::find(told.begin(), told.end(), cause) != told.end());
    }
}

} // namespace lockstep::test::wrong_shaders_test
