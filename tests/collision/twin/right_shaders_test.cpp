#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "crosscheck/report/report.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/shader_files.hpp"
#include "tests/collision/twin/twin_scenes.hpp"
#include "tests/temporary_folder.hpp"

using namespace lockstep;

namespace {

/// The second line's word after "legal: ", for a shader whose arithmetic is right by other rules than the measured
/// ones.
Legal rule_of(const std::string& text) {
    const auto says = [&](const char* word) { return text.find(word) != std::string::npos; };
    return says("// legal: any_order") ? Legal::any_order : says("// legal: glsl") ? Legal::glsl : Legal::measured;
}

/// The presets in which a search is tried: those that its first lines name, or all of `presets`.
std::vector<std::string> presets_of(const std::string& text, std::vector<std::string> presets) {
    const std::size_t line = text.find('\n'), list = text.find("preset: ", line);
    if (list != std::string::npos)
        std::erase_if(presets, [&](const std::string& preset) {
            return text.substr(list, text.find('.', list) - list).find(preset) == std::string::npos;
        });
    return presets;
}

} // namespace

TEST_CASE("right shaders: no collision pass that is right in another style is divergent") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const std::vector<std::filesystem::path> files = test::files_in("tests/collision/right_shaders");
    CHECK(files.size() >= 42);
    int hints = 0;
    for (const std::filesystem::path& file : files) {
        const std::string text = test::content(file);
        const test::TemporaryFolder shaders;
        shaders.write("collision_pass.vert", text);
        if (text.find("out_Position") != std::string::npos)
            shaders.write("collision_pass.geom", ""); // they need none
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

TEST_CASE("right shaders: no search by octree or in layers that is right in another style is divergent") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const std::vector<std::filesystem::path> files = test::files_in("tests/collision/right_searches");
    CHECK(files.size() >= 10);
    for (const std::filesystem::path& file : files) {
        const std::string text = test::content(file);
        const bool octree = file.extension() == ".comp";
        const test::TemporaryFolder shaders;
        shaders.write(octree ? "octree_pass.comp" : "layered_collision_pass.vert", text);
        const std::vector<std::string> scenes =
            octree ? std::vector<std::string>{"octree", "octree_edges"}
                   : std::vector<std::string>{"layers", "mutual", "two_cameras", "layer_edges"};
        const std::vector<std::string> presets = octree ? std::vector<std::string>{"paper", "corrected", "exact"}
                                                        : std::vector<std::string>{"corrected", "exact"};
        for (const std::string& name : scenes)
            for (const std::string& preset : presets_of(text, presets)) {
                SceneOptions options;
                options.preset = preset;
                const Scene scene = load_scene("tests/mutants/scenes/" + name + ".json", options);
                const CheckReport report =
                    test::check_twins(scene, 4, shaders.path(), CheckMode::resync, rule_of(text));
                INFO(file << " on " << name << ", " << preset << ": " << verdict_name(report.verdict));
                CHECK((report.verdict == Verdict::agree || report.verdict == Verdict::legal));
                CHECK(report.hits > 100);
            }
    }
}
