#include <algorithm>
#include <numeric>
#include <random>
#include <string>

#include <catch2/catch.hpp>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "gpu/collision/simulation.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/same_bits.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/mutants/planted_fault.hpp"

namespace lockstep::test::planted_fault_test {

namespace {

constexpr int frames = 12;

/// Field and component of a float of a record.
std::pair<FieldId, int> place_of(int component) {
    if (component < 3)
        return {collision::position, component};
    if (component == 3)
        return {collision::speed, 0};
    return component < 7 ? std::pair{collision::direction, component - 4} : std::pair{collision::collide_time, 0};
}

/// What a run takes beyond the frames themselves.
double seconds_to_answer(const CheckReport& report) {
    return std::accumulate(report.times.begin(), report.times.end(), 0.0,
                           [](double sum, const FrameTimes& times) { return sum + times.judge; });
}

} // namespace

TEST_CASE("planted faults: 100 in the GPU's state, each located to the frame, the particle and the field") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const Scene scene = load_scene("tests/mutants/scenes/crowd.json");
    std::mt19937 random(1);
    const auto below = [&](std::size_t n) { return static_cast<int>(random() % n); };
    constexpr int sizes[] = {1, -1, 1, -1, 2, -16, 1 << 12, 1 << 22, 0}; // ULP; 0: the sign
    int planted = 0;
    while (planted < 100) {
        const test::Fault fault{below(frames), static_cast<std::size_t>(below(scene.start.size())), below(8),
                                sizes[below(std::size(sizes))]};
        CheckOptions options;
        options.frames = frames;
        const test::PlantedFault plant(fault, options.repeated_frames);
        GpuSimulation gpu(scene, {});
        const CheckReport report = check(scene, test::llvmpipe_profile(), gpu, options);
        if (plant.before() == 0.0F)
            continue; // a zero's sign and what is flushed to zero are GLSL's to choose
        ++planted;
        INFO("frame " << fault.frame << " particle " << fault.particle << " component " << fault.component << " by "
                      << fault.ulps << " ULP: " << plant.before() << " to " << plant.after());
        REQUIRE(report.verdict == Verdict::divergent);
        CHECK(report.verdicts->total(DifferenceClass::divergent) == 1);
        REQUIRE(report.verdicts->first);
        const FirstDivergence& first = *report.verdicts->first;
        CHECK(first.place.frame == fault.frame);
        CHECK(first.place.resource == collision::particles);
        CHECK(first.place.index == fault.particle);
        const auto [field, component] = place_of(fault.component);
        CHECK(first.wrong.difference.field == field);
        CHECK(first.wrong.difference.component == component);
        CHECK(same_bits(first.wrong.difference.reference, plant.before()));
        CHECK(same_bits(first.wrong.difference.gpu, plant.after()));
        std::string told;
        for (const Cause& cause : report.verdicts->causes[collision::particles].best)
            told += cause.name() + "; ";
        INFO("told: " << told);
        CHECK_FALSE(report.verdicts->causes[collision::particles].explains_all());
        CHECK(seconds_to_answer(report) < 5.0);
    }
}

TEST_CASE("planted faults: one in 50,000 particles is located in at most 5 seconds beyond the run itself") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const Scene scene = load_scene("data/scenes/lattice.json");
    CheckOptions options;
    options.frames = 8;
    double least = 1e9; // of three runs: another program may have the processor in one
    for (int run = 0; run < 3 && least >= 5.0; ++run) {
        const test::PlantedFault plant({6, 43210, 4, 1}, options.repeated_frames);
        GpuSimulation gpu(scene, {});
        const CheckReport report = check(scene, test::llvmpipe_profile(), gpu, options);
        REQUIRE(report.verdict == Verdict::divergent);
        CHECK(report.verdicts->total(DifferenceClass::divergent) == 1);
        CHECK(report.verdicts->first->place.frame == 6);
        CHECK(report.verdicts->first->place.index == 43210);
        CHECK(report.verdicts->first->wrong.difference.field == collision::direction);
        least = std::min(least, seconds_to_answer(report));
    }
    CHECK(least < 5.0);
}

} // namespace lockstep::test::planted_fault_test
