#include <catch2/catch.hpp>

#include <cstdlib>
#include <ctime>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/judge/dispatch.hpp"
#include "crosscheck/text/pass_text.hpp"
#include "tests/skip.hpp"
#include "tests/system_run.hpp"
#include "tests/text/shipped_scene.hpp"

namespace lockstep::test::shipped_shaders_test {

namespace {

/// What the runs of one stage came to.
struct StageRow {
    std::size_t dispatches = 0, items = 0, twin_differs = 0, text_differs = 0, text_from_twin = 0;
    double twin_seconds = 0.0, text_seconds = 0.0;
    std::string refused = {}, finding = {}, first = {};
};
using StageTable = std::map<std::string, StageRow>;

std::size_t differing(const View& a, const View& b, std::string* first) {
    std::size_t count = 0;
    for (std::size_t item = 0; item < a.count(); ++item)
        if (item_words(a, item) != item_words(b, item) && ++count == 1 && first != nullptr && first->empty()) {
            const std::vector<std::uint32_t> u = item_words(a, item), v = item_words(b, item);
            for (std::size_t k = 0; k < u.size(); ++k)
                if (u[k] != v[k] && first->empty())
                    *first = fmt::format("{} {} word {}: text {:08x}, GPU {:08x}", a.about().item, item, k, u[k], v[k]);
        }
    return count;
}

/// Of this thread's own time.
template <class Work> double seconds_of(const Work& work) {
    const auto now = [] {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
    };
    const double start = now();
    work();
    return now() - start;
}

/// Item by item, on this thread alone.
double seconds_by_item(const ItemPass& pass, const SystemState& before, int frame, const Profile& profile) {
    const SystemView view = before.view();
    const PassInput in{view, frame};
    const std::unique_ptr<ItemPass> prepared = pass.prepared(in, profile);
    SystemState after = before;
    return seconds_of([&] {
        (prepared ? *prepared : pass).run(in, profile, 0, before[pass.resource()].count(), after[pass.resource()]);
    });
}

/// Runs a scene on the GPU, and each of its compute dispatches by its text and by its twin from the same state.
void compare_stages(const ShippedScene& shipped, int frames, StageTable& table, bool is_watched = false) {
    const SystemScene scene = shipped.load();
    const System& system = scene.system;
    GlSystemSide side(gl(), system, scene.passes, "shaders/" + shipped.system, scene.arithmetic);
    const Profile profile = side.describe().profile;
    std::map<std::size_t, std::unique_ptr<PassText>> texts;
    SystemState before = system.start;
    run_gpu(system, side, frames, [&](std::size_t pass, int frame, const SystemState& after) {
        StageRow& row = table[fmt::format("{}/{}.comp", shipped.system, scene.passes[pass].name)];
        const bool runs = !scene.passes[pass].runs || scene.passes[pass].runs(frame);
        if (scene.passes[pass].stage == Stage::compute && runs && row.refused.empty()) {
            const std::vector<std::uint8_t> written = written_by(system, pass);
            const SystemView view = before.view();
            SystemState by_text = before, by_twin = before;
            try {
                std::unique_ptr<PassText>& text = texts[pass];
                if (text == nullptr)
                    text = std::make_unique<PassText>(system.schema, scene.passes[pass], written,
                                                      shader_folders("shaders/" + shipped.system), scene.arithmetic);
                text::Findings findings;
                row.text_seconds += seconds_of([&] { text->run({view, frame}, profile, by_text, findings); });
                if (SystemState watched = before; is_watched)
                    text->run({view, frame}, profile, watched, findings, {.is_watched = true});
                for (const text::Finding& finding : findings.all())
                    row.finding = fmt::format("{}: {}: {}", text->program().line_name(finding.place.line), finding.rule,
                                              finding.what);
            } catch (const Error& error) {
                row.refused = error.what();
            }
            for (std::size_t p = pass; p < end_of_dispatch(system, pass); ++p) {
                if (!system.passes[p]->runs(frame))
                    continue;
                SystemState read = by_twin; // what the dispatch made so far, and its own buffer as it was
                read.take(system.passes[p]->resource(), before);
                run_pass(*system.passes[p], read, frame, profile, by_twin);
                row.twin_seconds += seconds_by_item(*system.passes[p], read, frame, profile);
            }
            ++row.dispatches;
            for (const std::uint8_t r : written) {
                row.items += after[r].count();
                row.text_differs += differing(by_text[r], after[r], &row.first);
                row.twin_differs += differing(by_twin[r], after[r], nullptr);
                row.text_from_twin += differing(by_text[r], by_twin[r], nullptr);
            }
        }
        before = after;
        return true;
    });
}

void print(const StageTable& table) {
    fmt::print("{:40} {:>10} {:>10} {:>9} {:>8} {:>8} {:>10} {:>10}\n", "stage", "dispatches", "items", "text-twin",
               "text", "twin", "text ns", "twin ns");
    for (const auto& [name, row] : table)
        if (row.dispatches > 0)
            fmt::print("{:40} {:10} {:10} {:9} {:8} {:8} {:10.0f} {:10.0f} {}{}{}\n", name, row.dispatches, row.items,
                       row.text_from_twin, row.text_differs, row.twin_differs,
                       row.text_seconds * 1e9 / static_cast<double>(row.items),
                       row.twin_seconds * 1e9 / static_cast<double>(row.items), row.refused, row.finding, row.first);
}

void expect_equal(const StageTable& table, const std::vector<std::string>& stages) {
    std::vector<std::string> run;
    for (const auto& [name, row] : table)
        if (row.dispatches > 0)
            run.push_back(name);
    CHECK(run == stages);
    for (const auto& [name, row] : table) {
        INFO(name << " " << row.first);
        CHECK(row.refused == "");
        CHECK(row.finding == "");
        CHECK(row.text_differs == 0);
        CHECK(row.twin_differs == 0);
    }
}

} // namespace

TEST_CASE("text: each compute stage of dust makes its twin's bits, and the GPU's") {
    if (!gl())
        return skip(gl().missing());
    StageTable table;
    for (const char* const file : {"spheres", "cone", "obb"})
        compare_stages({"dust", file, 300}, 3, table, true);
    for (const char* const preset : {"corrected", "exact"}) {
        compare_stages({"dust", "kernels", 300, preset, {}, R"({"dust": {"tools": [
            {"tool": "vacuum", "from": 0, "to": 1, "force": 40, "range": 90, "angle": 80, "death_range": 60},
            {"tool": "wind", "from": 1, "to": 2, "force": 60, "range": 60, "angle": 60},
            {"tool": "emit", "from": 2, "to": 4, "force": 50, "angle": 30, "distance": 10}]}})"},
                       4, table, true);
        compare_stages({"dust", "explode", 300, preset, {}, R"({"dust": {"cannon": [
            {"frame": 0, "position": [0, 1, 20], "forward": [0, -1, 0.1], "speed": 60, "range": 25, "force": 3000}]}})"},
                       4, table, true);
    }
    expect_equal(table, {"dust/blow_wind.comp", "dust/emit.comp", "dust/explode.comp", "dust/populate.comp",
                         "dust/update.comp", "dust/vacuum_up.comp"});
}

TEST_CASE("text: each compute stage of lifecycle makes its twin's bits, and the GPU's") {
    if (!gl())
        return skip(gl().missing());
    StageTable table;
    for (const char* const file : {"births_and_deaths", "fire", "ribbon_corners", "sorted_ribbon", "index_lists"})
        compare_stages({"lifecycle", file, 300}, 4, table, true);
    expect_equal(table, {"lifecycle/destroy.comp", "lifecycle/destroy_reduce.comp", "lifecycle/destroy_scan.comp",
                         "lifecycle/emit.comp", "lifecycle/indirect.comp", "lifecycle/move.comp",
                         "lifecycle/post_destroy.comp", "lifecycle/post_emit.comp", "lifecycle/pre_sort.comp",
                         "lifecycle/prefix_reduce.comp", "lifecycle/prefix_scan.comp", "lifecycle/prefix_sum.comp",
                         "lifecycle/ribbon.comp", "lifecycle/ribbon_distance.comp", "lifecycle/simulate.comp",
                         "lifecycle/sort.comp"});
}

TEST_CASE("text: each compute stage of fluid makes its twin's bits, and the GPU's") {
    if (!gl())
        return skip(gl().missing());
    StageTable table;
    const std::vector<std::vector<std::string>> variants{
        {},
        {"filter=gaussian", "depth_fetch=linear", "scene_fetch=linear"},
        {"filter=narrow_range", "filter_shape=full2d", "narrow_cleanup=full"},
        {"filter=curvature_flow", "thickness_sum=fixed", "encoding=srgb_table"}};
    for (const std::vector<std::string>& set : variants)
        compare_stages({"fluid", "two_layers", 0, "corrected", set, R"({"render": [48, 40]})"}, 1, table, true);
    compare_stages({"fluid", "wave", 0, "exact", {}, R"({"render": [48, 40]})"}, 2, table, true);
    expect_equal(table, {"fluid/depth_filter_pass.comp", "fluid/encode_pass.comp", "fluid/fluid_shade_pass.comp",
                         "fluid/motion_pass.comp", "fluid/normal_pass.comp", "fluid/thickness_clear_pass.comp",
                         "fluid/thickness_pass.comp"});
}

TEST_CASE("text: each compute stage of lights makes its twin's bits, and the GPU's") {
    if (!gl())
        return skip(gl().missing());
    StageTable table;
    const std::vector<std::vector<std::string>> variants{{},
                                                         {"accumulate=gather", "interpolation=tricubic"},
                                                         {"accumulate=fixed64", "interpolation=trilinear_hw"},
                                                         {"accumulate=fixed32", "outside=black", "supersample=2"}};
    for (const char* const preset : {"corrected", "exact"})
        for (std::vector<std::string> set : variants) {
            if (preset == std::string("exact") && !set.empty())
                continue;
            set.emplace_back("pipeline=deferred");
            compare_stages({"lights", "hall", 60, preset, set,
                            R"({"image": [48, 32], "grid": {"size": [16, 4, 16], "voxel": 4}})"},
                           2, table, true);
        }
    expect_equal(table,
                 {"lights/deferred_light_pass.comp", "lights/encode_pass.comp", "lights/light_sort_pass.comp",
                  "lights/light_step_pass.comp", "lights/light_volume_clear.comp", "lights/light_volume_gather.comp",
                  "lights/light_volume_resolve.comp", "lights/light_volume_scatter.comp"});
}

TEST_CASE("text: a table of all shipped compute stages", "[.][table]") {
    if (!gl())
        return skip(gl().missing());
    StageTable table;
    const auto number = [](const char* name, int otherwise) {
        const char* const text = std::getenv(name);
        return text != nullptr ? std::atoi(text) : otherwise;
    };
    const int frames = number("LOCKSTEP_FRAMES", 20);
    const auto items = static_cast<std::size_t>(number("LOCKSTEP_ITEMS", 2000));
    const auto compare = [&](const std::string& system, const std::string& file) {
        if (system == "fluid")
            compare_stages({system, file, 0, "corrected", {}, R"({"render": [120, 100]})"}, frames, table);
        else if (system == "lights")
            compare_stages({system, file, items, "corrected", {}, R"({"image": [120, 80]})"}, frames, table);
        else
            compare_stages({system, file, items}, frames, table);
    };
    if (const char* const scene = std::getenv("LOCKSTEP_SCENE"); scene != nullptr) { // SYSTEM/FILE, for many cores
        const std::string_view name = scene;
        const std::size_t slash = name.find('/');
        compare(std::string(name.substr(0, slash)), std::string(name.substr(slash + 1)));
        return print(table);
    }
    for (const char* const file : {"kernels", "spheres", "cone", "obb", "vacuum_and_back", "blow_dust", "explode",
                                   "box", "pyramid", "volume", "wind", "black_hole_gpu"})
        compare("dust", file);
    for (const char* const file : {"births_and_deaths", "fire", "ribbon_corners", "sorted_ribbon", "index_lists",
                                   "fountain", "two_emitters", "graphs", "ribbon_loop", "zombies"})
        compare("lifecycle", file);
    for (const char* const file : {"two_layers", "dam", "wave"})
        compare("fluid", file);
    for (const char* const file : {"hall", "crowd", "swarms"})
        compare("lights", file);
    print(table);
}

} // namespace lockstep::test::shipped_shaders_test
