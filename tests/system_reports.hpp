#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "crosscheck/judge/system_check.hpp"
#include "crosscheck/judge/system_run.hpp"
#include "crosscheck/report/page/system_page.hpp"
#include "tests/report_parts.hpp"
#include "tests/twin_side.hpp"

namespace lockstep::test {

/// An item that differs after one pass of the first frame.
struct PlantedItem {
    std::size_t pass = 0, item = 0;
    DifferenceClass kind = DifferenceClass::divergent;
    Words words;
};

/// For each pass of the first frame and each class an item that can be planted, as far as the judge allows one by all
/// that GL does.
inline std::vector<PlantedItem> items_to_plant(const System& system, const Profile& profile) {
    constexpr std::size_t most_tried = 48;
    const KnownOperations known{};
    std::vector<PlantedItem> all;
    ReferenceRun run(system, profile);
    for (std::size_t p = 0; p < system.passes.size(); ++p) {
        const ItemPass& pass = *system.passes[p];
        if (!pass.runs(0))
            continue;
        const SystemState before = run.state();
        run.step_pass(p, 0);
        const SystemView from = before.view();
        if (pass.derived() || pass.appended({from, 0}))
            continue;
        const SystemState made = run.state();
        SystemState gpu = made;
        const View reference = made[pass.resource()];
        const WritableView writable = gpu[pass.resource()];
        const View by_gpu = writable;
        JudgedPass judged{pass, profile, known, 0, from, reference, by_gpu};
        judged.prepare();
        std::map<DifferenceClass, PlantedItem> found;
        const std::size_t apart = std::max<std::size_t>(reference.count() / most_tried, 1);
        for (std::size_t item = 0; item < reference.count() && found.size() < class_names.size(); item += apart)
            for (const auto& [kind, words] : words_by_class(judged, item, writable))
                found.try_emplace(kind, PlantedItem{p, item, kind, words});
        for (const auto& [kind, planted] : found)
            all.push_back(planted);
    }
    return all;
}

struct SystemRunOnPage {
    CheckReport report;
    nlohmann::json head;
};

inline SystemRunOnPage checked_system(const System& system, SystemSide& gpu, CheckOptions options) {
    SystemPage page(system, gpu, options.frames);
    CheckWatch watch;
    watch.on_pass = [&](const CheckedPass& pass) { page.add(pass); };
    CheckReport report = check(system, gpu, options, watch);
    const RunDescription about{system.name, "", "", "", "resync", "again", ""};
    const nlohmann::json head = page_head_of(page.text(
        "<!-- lockstep data -->", report, about, {}, [](const std::vector<std::string>&) { return "explain"; }, ""));
    CHECK(head.at("report").at("verdicts") == report_json(report, about).at("verdicts"));
    return {std::move(report), head};
}

/// Plants one item after the other, and holds each report to it. Returns how many of each class there were.
inline std::array<std::size_t, class_names.size()> check_planted_items(const System& system, const Profile& profile) {
    std::array<std::size_t, class_names.size()> counts{};
    CheckOptions options;
    options.frames = 1;
    options.power = false;
    options.known = KnownOperations{};
    for (const PlantedItem& planted : items_to_plant(system, profile)) {
        const ItemPass& pass = *system.passes[planted.pass];
        INFO(fmt::format("pass {} ({}), item {}", planted.pass, pass.name(), planted.item));
        TwinSide gpu(system, profile, profile, [&](std::size_t p, int, SystemState& state) {
            if (p == planted.pass)
                put_words(state[pass.resource()], planted.item, planted.words);
        });
        const SystemRunOnPage run = checked_system(system, gpu, options);
        const bool has_floats = std::any_of(system.schema.resources[pass.resource()].fields.begin(),
                                            system.schema.resources[pass.resource()].fields.end(),
                                            [](const Field& field) { return field.scalar == Scalar::float32; });
        check_report(run.report, pass.resource(), planted.item, 0, planted.kind,
                     has_floats && planted.kind <= DifferenceClass::tie);
        const nlohmann::json& of_pass = run.head.at("system").at("passes").at(planted.pass);
        CHECK(of_pass.at("classes").at(static_cast<std::size_t>(planted.kind)) == 1);
        const nlohmann::json& items = run.head.at("items");
        CHECK(std::any_of(items.begin(), items.end(), [&](const nlohmann::json& item) {
            return item.at("pass") == planted.pass && item.at("class") == static_cast<std::size_t>(planted.kind);
        }));
        ++counts[static_cast<std::size_t>(planted.kind)];
    }
    return counts;
}

/// A run whose GPU rounds roots in its own way is legal by all that GL allows, and each line `leeway` is of its own
/// resource; the first frame alone is partial; one that rounds as the reference does agrees.
inline void check_whole_reports(const System& system, const Profile& uneven) {
    const Profile strict = named_profile("strict");
    CheckOptions options;
    options.frames = 2;
    options.power = false;
    options.known = KnownOperations{};
    TwinSide same(system, strict, strict);
    CHECK(checked_system(system, same, options).report.verdict == Verdict::agree);
    std::atomic<bool> stop = false;
    options.stop = &stop;
    options.on_frame = [&](int) { stop = true; };
    TwinSide rounding(system, uneven, strict);
    const SystemRunOnPage run = checked_system(system, rounding, options);
    const std::string text = run.head.at("text");
    INFO(text);
    CHECK(run.report.partial());
    CHECK_THAT(text, Catch::Contains("(partial: stopped after 1 of 2 frames)"));
    std::size_t lines = 0;
    for (std::uint8_t r = 0; r < system.schema.resources.size(); ++r)
        if (const auto& widest = run.report.verdicts->widths[r].widest()) {
            CHECK(widest->floats.field.resource == r);
            const Field& field = system.schema[widest->floats.field];
            CHECK(widest->index < run.report.total.resources[r].extent.count());
            CHECK_THAT(text, Catch::Contains(fmt::format("leeway    {}: ", system.schema.resources[r].title)) &&
                                 Catch::Contains(
                                     fmt::format(" at most: {} ", component_name(field, widest->floats.component))));
            ++lines;
        }
    CHECK(lines > 0);
}

} // namespace lockstep::test
