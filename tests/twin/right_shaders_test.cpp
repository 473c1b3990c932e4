#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "crosscheck/report/report.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/twin/llvmpipe.hpp"
#include "tests/twin/twin_scenes.hpp"

using namespace lockstep;

namespace {

/// The second line's word after "legal: ", for a shader whose arithmetic is right by other rules than the measured
/// ones.
Legal rule_of(const std::string& text) {
    const auto says = [&](const char* word) { return text.find(word) != std::string::npos; };
    return says("// legal: any_order") ? Legal::any_order : says("// legal: glsl") ? Legal::glsl : Legal::measured;
}

std::vector<std::filesystem::path> right_shaders() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator("tests/right_shaders"))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace

TEST_CASE("right shaders: no collision pass that is right in another style is divergent") {
    const auto context = test::open_llvmpipe("osmesa");
    if (!context)
        return;
    const std::vector<std::filesystem::path> files = right_shaders();
    CHECK(files.size() >= 36);
    int hints = 0;
    for (const std::filesystem::path& file : files) {
        std::ifstream stream(file);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        const test::TemporaryFolder shaders;
        shaders.write("collision_pass.vert", text);
        shaders.write("collision_pass.geom", ""); // they have none
        const Scene scene = test::crowded_scene();
        const CheckReport report = test::check_twins(scene, 6, shaders.path(), CheckMode::resync, rule_of(text));
        INFO(file << ": " << verdict_name(report.verdict));
        CHECK((report.verdict == Verdict::agree || report.verdict == Verdict::legal));
        CHECK(report.hits > 100);
        if (rule_of(text) == Legal::measured)
            continue;
        // Judged by what was measured, the report says by which rule nothing is wrong.
        const CheckReport narrow = test::check_twins(scene, 6, shaders.path());
        if (narrow.verdict != Verdict::divergent)
            continue;
        ++hints;
        REQUIRE(narrow.wider_rule);
        CHECK(*narrow.wider_rule <= rule_of(text));
    }
    CHECK(hints >= 2);
}
