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

namespace lockstep::test::right_shaders_test {

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

TEST_CASE("right shaders: corners that a vertex stage sums in another order are legal where any order is") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const auto by = [](const std::string& position, Legal legal) {
        const test::TemporaryFolder shaders;
        shaders.write("obstacle_pass.vert",
                      "#version 400 core\n"
                      "uniform mat4 u_ProjView;\n"
                      "in vec3 a_Position;\n"
                      "out vec3 v_Position;\n"
                      "precise gl_Position;\n"
                      "void main() {\n"
                      "    v_Position = a_Position;\n"
                      "    vec4 x = u_ProjView[0] * a_Position.x, y = u_ProjView[1] * a_Position.y;\n"
                      "    vec4 z = u_ProjView[2] * a_Position.z, w = u_ProjView[3];\n"
                      "    gl_Position = " +
                          position +
                          ";\n"
                          "}\n");
        SceneOptions options;
        options.particles = 300;
        return test::check_twins(load_scene("data/scenes/lattice.json", options), 1, shaders.path(), CheckMode::resync,
                                 legal);
    };
    CHECK(by("((x + y) + z) + w", Legal::measured).verdict == Verdict::agree);
    for (const char* const other :
         {"((w + z) + y) + x", "((x + z) + w) + y", "fma(u_ProjView[2], vec4(a_Position.z), w) + (x + y)"}) {
        INFO(other);
        const CheckReport open = by(other, Legal::any_order);
        CHECK(open.verdict == Verdict::legal);
        CHECK(by(other, Legal::measured).verdict == Verdict::divergent);
    }
    for (const char* const wrong :
         {"((w + z) + y) + 1.00001 * x", "((w + z) + y) + x + 0.00001", "(w + z) + (y - x)"}) {
        INFO(wrong);
        CHECK(by(wrong, Legal::any_order).verdict == Verdict::divergent);
    }
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

} // namespace lockstep::test::right_shaders_test
