#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "crosscheck/collision/page/explained.hpp"
#include "crosscheck/collision/page/report_page.hpp"
#include "crosscheck/collision/record/capsule.hpp"
#include "crosscheck/report/page/template.hpp"
#include "gpu/collision/simulation.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/mutants/catalogue.hpp"
#include "tests/mutants/trial.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::report_mutants_test {

namespace {

/// A mutant of the catalogue, and the start of the label of the row that computes what it changes.
struct Expectation {
    const char* mutant;
    const char* row;
};

constexpr Expectation expectations[] = {
    {"no_perspective_divide", "clip / w."},   {"y_flipped", "image position.y"},
    {"collide_time_zero_searches", "search"}, {"distance_without_z", "texel ("},
    {"nearest_last_found", "texel ("},        {"range_not_tested", "texel ("},
    {"hit_direction_kept", "direction."},     {"hit_time_not_set", "collide time"},
    {"gravity_missing", "velocity."},         {"move_reversed", "position."},
};

/// What a red build leaves: the page, and the first divergent particle's step; empty where none diverges.
struct Artefact {
    std::string page;
    std::optional<Capsule> capsule;
};

Artefact artefact_of(const test::TrialScene& trial, const std::filesystem::path& shaders) {
    const Scene& scene = trial.scene();
    PageCollector collector(scene, trial.profile(), CheckMode::resync, test::trial_frames);
    GpuSimulation gpu(scene, shaders);
    FrameCheckOptions options;
    options.frames = test::trial_frames;
    options.on_state = [&](const ComparedFrame& frame) { collector.add(frame); };
    const CheckReport report = check(scene, trial.profile(), gpu, options);
    FrameRun frames(scene, trial.profile(), measured_operations(trial.profile()), shaders);
    std::vector<ExplainedItem> items;
    for (const PageItem& item : collector.frames().items())
        items.push_back({item, "", explained(frames, item)});
    Artefact artefact;
    for (const PageItem& item : collector.frames().items())
        if (!item.texel && item.kind == static_cast<std::uint8_t>(DifferenceClass::divergent) && !artefact.capsule) {
            frames.go_to(item.frame);
            artefact.capsule =
                cut_capsule(frames.judged(), {scene, "", "", item.frame, item.index, frames.capture(item.index)});
        }
    const RunDescription run{trial.name(), "", "", "", "resync", "", ""};
    artefact.page = report_page(page_data_marker, collector, report, run, {}, items, {});
    return artefact;
}

/// What they say the bug is: names that explain it all alike, and the row where it shows.
struct Told {
    std::vector<std::string> causes;
    std::string row;
    std::string row_of_capsule;
};

Told told_by(const Artefact& artefact) {
    const std::string& page = artefact.page;
    const std::size_t start = page.find('>') + 1;
    const auto head = nlohmann::json::parse(page.substr(start, page.find("</script>") - start));
    Told told;
    const nlohmann::json& verdicts = head.at("report").at("verdicts");
    for (const char* kind : {"particle_cause", "texel_cause"})
        for (const nlohmann::json& cause : verdicts.at(kind).at("best"))
            told.causes.push_back(
                fmt::format("{}", fmt::join(cause.at("deviations").get<std::vector<std::string>>(), " + ")));
    for (const nlohmann::json& item : head.at("items"))
        if (told.row.empty() && item.contains("step"))
            told.row = item.at("step");
    if (artefact.capsule) {
        const std::string text = capsule_text(*artefact.capsule, NumberFormat::decimal);
        const std::size_t row = text.find("\n> ");
        told.row_of_capsule = row == std::string::npos ? "" : text.substr(row + 3, text.find('\n', row + 1) - row - 3);
    }
    return told;
}

} // namespace

TEST_CASE("report mutants: page and capsule alone name the planted bug, 10 of 10, and the operation where it shows") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const std::vector<test::Mutant> catalogue = test::whole_catalogue();
    constexpr std::string_view names[] = {"crowd", "lattice"};
    const std::vector<test::TrialScene> scenes = test::trial_scenes(test::llvmpipe_profile(), names);
    std::vector<std::string> named, other;
    for (const Expectation& expected : expectations) {
        const auto mutant = std::find_if(catalogue.begin(), catalogue.end(),
                                         [&](const test::Mutant& m) { return m.name == expected.mutant; });
        REQUIRE(mutant != catalogue.end());
        const test::TemporaryFolder shaders;
        test::plant(*mutant, shaders);
        Told told;
        for (std::size_t i = 0; i < scenes.size() && told.row.empty(); ++i)
            told = told_by(artefact_of(scenes[i], shaders.path()));
        const bool right = std::find(told.causes.begin(), told.causes.end(), mutant->cause) != told.causes.end() &&
                           told.row.starts_with(expected.row) && told.row_of_capsule.starts_with(expected.row);
        (right ? named : other)
            .push_back(fmt::format("{}: {}, at {}; capsule: {}", mutant->name, fmt::join(told.causes, " or "), told.row,
                                   told.row_of_capsule));
    }
    CAPTURE(named, other);
    CHECK(named.size() == std::size(expectations));
}

} // namespace lockstep::test::report_mutants_test
