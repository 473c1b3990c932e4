#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/collision/judge/step_table.hpp"
#include "crosscheck/collision/judge/texel_table.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/mutants/catalogue.hpp"
#include "tests/mutants/trial.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::explain_mutants_test {

namespace {

/// A mutant of the catalogue, and the start of the label of the row that computes what it changes.
struct Expectation {
    const char* mutant;
    const char* row;
};

constexpr Expectation expectations[] = {
    {"matrix_transposed_in_search", "clip."},
    {"no_perspective_divide", "clip / w."},
    {"divided_by_half", "texture coordinate."},
    {"x_flipped", "image position.x"},
    {"y_flipped", "image position.y"},
    {"half_texel_up", "base texel"},
    {"rounds_to_nearest", "base texel"},
    {"collide_time_zero_searches", "search"},
    {"own_position_from_texel", "own position."},
    {"own_position_one_ulp", "own position."},
    {"apart_added", "apart ("},
    {"apart_reversed", "apart ("},
    {"neighbours_in_halves", "apart ("},
    {"distance_one_ulp", "texel ("},
    {"distance_squared", "texel ("},
    {"distance_without_z", "texel ("},
    {"nearest_last_found", "texel ("},
    {"nearest_first_found", "texel ("},
    {"nearest_farthest", "texel ("},
    {"best_not_kept", "texel ("},
    {"range_not_tested", "texel ("},
    {"range_halved", "texel ("},
    {"last_column_skipped", "texel ("},
    {"first_row_skipped", "texel ("},
    {"own_row_skipped", "texel ("},
    {"own_texel_not_skipped", "texel ("},
    {"phantom_origin", "texel ("},
    {"away_one_ulp", "away."},
    {"away_swizzled", "away."},
    {"hit_direction_kept", "direction."},
    {"hit_direction_one_ulp", "direction."},
    {"hit_time_not_set", "collide time"},
    {"hit_time_one_ulp", "collide time"},
    {"hit_step_without_tick", "position."},
    {"hit_step_old_direction", "position."},
    {"hit_position_one_ulp", "position."},
    {"gravity_without_tick", "velocity."},
    {"gravity_missing", "velocity."},
    {"move_direction_not_normalised", "direction."},
    {"move_speed_one_ulp", "speed"},
    {"move_speed_squared", "speed"},
    {"time_counted_twice", "collide time"},
    {"move_reversed", "position."},
    {"move_position_one_ulp", "position."},
    {"drawn_before_step", "point's clip."},
    {"drawn_half_pixel_up", "gl_Position."},
    {"captures_time_as_speed", "speed captured"},
    {"stores_axes_swapped", "owner of texel"},
};

const test::Mutant& named(const std::vector<test::Mutant>& catalogue, const std::string& name) {
    const auto found =
        std::find_if(catalogue.begin(), catalogue.end(), [&](const test::Mutant& m) { return m.name == name; });
    INFO(name);
    REQUIRE(found != catalogue.end());
    return *found;
}

/// The table of the first divergent particle, or of the owner of the first divergent texel.
std::optional<StepTable> first_divergent(const Scene& scene, const Profile& profile,
                                         const std::filesystem::path& shaders) {
    FrameRun run(scene, profile, measured_operations(profile), shaders);
    for (int frame = 0; frame < test::trial_frames; ++frame) {
        run.go_to(frame);
        for (const ItemVerdict& verdict : run.verdicts().particles)
            if (verdict.kind == DifferenceClass::divergent)
                return step_table(run, verdict.index);
        for (const ItemVerdict& verdict : run.verdicts().texels)
            if (verdict.kind == DifferenceClass::divergent)
                for (const std::size_t particle : texel_table(run, verdict.index).particles)
                    return step_table(run, particle);
    }
    return {};
}

/// The first row that differs, in the first scene that shows the mutant; it is divergent, with a reason.
std::string first_row(const test::Mutant& mutant, const std::vector<test::TrialScene>& scenes) {
    const test::TemporaryFolder shaders;
    test::plant(mutant, shaders);
    for (const test::TrialScene& scene : scenes) {
        if (scene.pass() != mutant.pass)
            continue;
        const auto table = first_divergent(scene.scene(), scene.profile(), shaders.path());
        if (!table)
            continue;
        const auto row =
            std::find_if(table->rows.begin(), table->rows.end(), [](const StepRow& r) { return r.differs(); });
        if (row == table->rows.end() || row->verdict != RowVerdict::divergent || row->reason.empty())
            return "no divergent row first";
        return row->label;
    }
    return "no divergence";
}

} // namespace

TEST_CASE("explain mutants: the first row that differs is the mutated operation") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const std::vector<test::Mutant> catalogue = test::whole_catalogue();
    const std::vector<test::TrialScene> scenes = test::trial_scenes(test::llvmpipe_profile());
    std::vector<std::string> elsewhere;
    for (const Expectation& expected : expectations) {
        const std::string row = first_row(named(catalogue, expected.mutant), scenes);
        if (!row.starts_with(expected.row))
            elsewhere.push_back(fmt::format("{}: {} instead of {}", expected.mutant, row, expected.row));
    }
    CAPTURE(elsewhere);
    CHECK(elsewhere.empty());
}

} // namespace lockstep::test::explain_mutants_test
