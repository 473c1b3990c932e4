#include <algorithm>
#include <set>

#include <catch2/catch.hpp>

#include "gpu/collision/simulation.hpp"
#include "reference/collision/deviation.hpp"
#include "reference/model/error.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/mutants/outcome_json.hpp"
#include "tests/mutants/score.hpp"

namespace lockstep::test::mutants_test {

namespace {

/// A few of each kind; scripts/mutation_score.sh runs all.
const std::set<std::string> few{"nearest_last_found",
                                "range_one_ulp_wider",
                                "own_row_and_column_skipped",
                                "hit_speed_reduced_by",
                                "hit_direction_one_ulp",
                                "gravity_doubled",
                                "matrix_from_the_right",
                                "drawn_before_step",
                                "y_flipped",
                                "half_ties_down",
                                "exact_root_not_set_right",
                                "obstacle_stores_one_ulp",
                                "render_truncated",
                                "host_depth_func_greater",
                                "host_cdt_cleared_twice_only",
                                "host_captures_half",
                                "host_tick_one_ulp",
                                "octree_last_of_equals",
                                "octree_obstacles_left_out",
                                "octree_last_entry_skipped",
                                "octree_hit_old_speed_moves",
                                "apart_added",
                                "octree_host_speed_factor_complement",
                                "depth_normal_reversed",
                                "depth_thickness_included",
                                "depth_normal_of_left",
                                "depth_host_gravity_not_set",
                                "layered_last_layer_skipped",
                                "layered_own_not_skipped",
                                "layered_first_matrix_for_both",
                                "layered_unseen_pushed",
                                "layered_draws_stored_again",
                                "layered_velocity_without_speed"};

} // namespace

TEST_CASE("mutants: each text stands in the shipped shader as often as the catalogue says") {
    const std::vector<Mutant> mutants = whole_catalogue();
    CHECK(mutants.size() >= 80);
    for (const Mutant& mutant : mutants) {
        const TemporaryFolder folder;
        CHECK_NOTHROW(plant(mutant, folder));
    }
}

TEST_CASE("mutants: a few of the catalogue are found and named, and the shipped shaders are not") {
    const auto context = open_llvmpipe();
    if (!context)
        return;
    constexpr std::string_view names[] = {"crowd",        "exact",  "halves",      "lattice", "octree",     "mutual",
                                          "octree_edges", "layers", "two_cameras", "depth",   "depth_edges"};
    std::vector<TrialScene> scenes = trial_scenes(llvmpipe_profile(), names);
    const Outcome unmutated = run_mutant({}, scenes);
    CHECK(unmutated.killer() == nullptr);
    for (std::size_t rule = 0; rule < common_rule_count; ++rule)
        CHECK_FALSE(unmutated.rejected_by(rule));
    std::size_t run = 0;
    for (const Mutant& mutant : whole_catalogue()) {
        if (!few.contains(mutant.name))
            continue;
        ++run;
        const Outcome outcome = run_mutant(mutant, scenes);
        INFO(outcome_line(outcome));
        CHECK(outcome.killer() != nullptr);
        CHECK((mutant.cause.empty() || outcome.named()));
        CHECK_FALSE(outcome.wrongly_named());
        for (const Trial& trial : outcome.trials) {
            INFO("the power of the right run in " << trial.scene << " says that it would show");
            CHECK((trial.predicted != true || trial.killed()));
        }
    }
    CHECK(run == few.size());
}

TEST_CASE("mutants: a score that another process made is the same score") {
    const auto trial = [](const char* scene, const char* verdict) {
        Trial made;
        made.scene = scene;
        made.verdict = verdict;
        return made;
    };
    const auto mutant = [](const char* name) {
        Mutant made;
        made.name = name;
        return made;
    };
    Score score;
    score.renderer = "llvmpipe";
    score.unmutated.trials.push_back(trial("crowd", "AGREE"));
    Trial found = trial("lattice exact", "DIVERGENT"), refused = trial("bytes", "ERROR");
    found.frame = 3;
    found.divergent = 12;
    found.explained = true;
    found.causes = {"half_cdt", "other"};
    found.predicted = false;
    found.step = "direction";
    found.rules[1] = false;
    found.rules[2] = true;
    refused.error = "GL says no";
    Mutant half = mutant("half_code"), fault = mutant("fault");
    half.cause = "half_cdt";
    score.outcomes.push_back({half, {found, refused}});
    score.outcomes.push_back({fault, {}});
    score.outcomes.back().mutant.equivalent = "as right";
    const Score read = read_score(whole_json(score), {{"half_code", half}, {"fault", fault}});
    CHECK(score_markdown(read) == score_markdown(score));
    CHECK(score_json(read) == score_json(score));
    CHECK(read.trials(false, true) == 1);
    CHECK(read.outcomes[0].trials[0].rules == found.rules);
}

TEST_CASE("mutants: where one is not what it is called stands by the name of a scene") {
    const auto context = open_llvmpipe();
    if (!context)
        return;
    std::set<std::string> known;
    for (const TrialScene& scene : trial_scenes(llvmpipe_profile()))
        known.insert(scene.name());
    for (const Mutant& mutant : whole_catalogue())
        for (const auto& [scene, why] : mutant.differs_in) {
            INFO(mutant.name << " in " << scene);
            CHECK(known.contains(scene));
            CHECK_FALSE(why.empty());
        }
}

TEST_CASE("mutants: what is drawn rightly of particles that diverge has no cause of its own") {
    const auto context = open_llvmpipe();
    if (!context)
        return;
    constexpr std::string_view names[] = {"layers"};
    std::vector<TrialScene> scenes = trial_scenes(llvmpipe_profile(), names);
    const std::vector<Mutant> mutants = whole_catalogue();
    const auto mutant = std::find_if(mutants.begin(), mutants.end(),
                                     [](const Mutant& m) { return m.name == "layered_gravity_missing"; });
    REQUIRE(mutant != mutants.end());
    const TemporaryFolder folder;
    plant(*mutant, folder);
    GpuSimulation gpu(scenes[0].scene(), folder.path());
    CheckOptions options;
    options.frames = 3;
    const CheckReport report = check(scenes[0].scene(), llvmpipe_profile(), gpu, options);
    REQUIRE(report.verdicts);
    CHECK(report.verdicts->causes[0].explains_all());
    CHECK(report.verdicts->classes[1][static_cast<std::size_t>(DifferenceClass::divergent)] > 0);
    CHECK(report.verdicts->causes[1].divergent == 0);
}

TEST_CASE("mutants: one that sums as the driver does by itself changes nothing there, and is to be found elsewhere") {
    const auto is_equivalent = [](const std::string& name, DotOrder order) {
        Profile profile;
        profile.dot = order;
        for (const Mutant& mutant : on_driver(whole_catalogue(), profile))
            if (mutant.name == name)
                return !mutant.equivalent.empty();
        FAIL("no mutant is named " << name);
        return false;
    };
    CHECK(is_equivalent("sums_left_to_right", DotOrder::left_to_right));
    CHECK_FALSE(is_equivalent("sums_left_to_right", DotOrder::right_to_left));
    CHECK(is_equivalent("sums_right_to_left", DotOrder::right_to_left));
    CHECK_FALSE(is_equivalent("sums_right_to_left", DotOrder::left_to_right));
    CHECK_FALSE(is_equivalent("sums_middle_last", DotOrder::left_to_right));
    Profile profile;
    profile.normalize_dot = DotOrder::right_to_left; // and length from the left
    const auto equivalents = [&] {
        const std::vector<Mutant> mutants = on_driver(whole_catalogue(), profile);
        return std::count_if(mutants.begin(), mutants.end(),
                             [](const Mutant& m) { return m.sums && !m.equivalent.empty(); });
    };
    CHECK(equivalents() == 0);
    profile.other_orders = {.dot = {}, .length = {DotOrder::right_to_left}, .normalize = {DotOrder::left_to_right}};
    CHECK(equivalents() == 2);
}

TEST_CASE("mutants: a catalogue that is wrong is an error that says where") {
    const TemporaryFolder folder;
    const auto read = [&](const char* text) { return read_catalogue(folder.write("mutants.json", text)); };
    const std::string file = (folder.path() / "mutants.json").string();
    CHECK_THROWS_WITH(read(R"([{ "name": "a", "fault": "none_such" }])"),
                      file + ": /0/fault: host_faults.cpp has no such fault");
    CHECK_THROWS_WITH(read(R"([{ "name": "a", "fault": "tick_doubled", "cause": "none_such" }])"),
                      file + ": /0/cause: reference/collision/deviation.hpp has no such deviation");
    CHECK_THROWS_WITH(read(R"([{ "name": "a", "fault": "tick_doubled", "sums": "x+y" }])"),
                      file + ": /0/sums: reference/model/profile.hpp has no such order");
    CHECK_THROWS_WITH(read(R"([{ "name": "a", "fault": "tick_doubled" }, { "name": "a", "fault": "tick_halved" }])"),
                      file + ": /1/name: the name of another mutant, too");
    const std::vector<Mutant> mutants = read(
        R"([{ "name": "a", "file": "collision_pass.vert", "text": "u_Tick", "replacement": "0.5", "times": 99 }])");
    CHECK_THROWS_WITH(plant(mutants[0], folder),
                      Catch::Contains("mutant a: the text to replace stands") && Catch::Contains("not 99"));
}

TEST_CASE("mutants: the rules of others accept what is equal and reject what is far") {
    FinalState reference;
    reference.particles.resize(2);
    reference.cdt = CollisionImage(2, 2);
    reference.picture = ColorImage(8, 8);
    const auto rejecting = [&](const FinalState& gpu) {
        std::set<std::string> names;
        for (const CommonRule& rule : common_rules())
            if (!rule.accepts(reference, gpu))
                names.emplace(rule.name);
        return names;
    };
    using Names = std::set<std::string>;
    CHECK(rejecting(reference) == Names{});
    FinalState gpu = reference;
    gpu.particles.position[1].y = 2e-4F;
    CHECK(rejecting(gpu) == Names{"abs 1e-5", "rel 1e-7", "RMSE 1e-5", "hash"});
    gpu.particles.position[1].y = 1e-6F;
    CHECK(rejecting(gpu) == Names{"rel 1e-7", "hash"});
    gpu.particles.position[1].y = std::numeric_limits<float>::quiet_NaN();
    CHECK(rejecting(gpu) == Names{"abs 1e-3", "abs 1e-5", "rel 1e-7", "RMSE 1e-5", "hash"});
    gpu = reference;
    gpu.picture.at(3, 3).g = 5;
    CHECK(rejecting(gpu) == Names{"image"});
    gpu.picture.at(3, 3).g = 4;
    CHECK(rejecting(gpu) == Names{});
    gpu.cdt.at(1, 1).a = 1.0F;
    CHECK(rejecting(gpu) == Names{"hash"});
}

} // namespace lockstep::test::mutants_test
