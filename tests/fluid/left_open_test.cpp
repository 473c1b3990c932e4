#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/fluid/left_open.hpp"
#include "reference/fluid/by_driver.hpp"
#include "tests/fluid/fluid_run.hpp"

namespace lockstep::test::left_open_test {

/// Fetches between texels, by drivers that are followed in them and by others.
namespace fluid = lockstep::fluid;

namespace {

const Profile by_all_bits = not_following({}), aligned = not_following({fluid::plane_filter_row}),
              open_filter = not_following({fluid::plane_filter_row, fluid::aligned_plane_filter_row});

fluid::Settings fetching(const std::string& filter) {
    return with(heap(5), {"filter=" + filter, "depth_fetch=linear", "scene_fetch=linear", "depth_value=ndc"});
}

struct Widths {
    double widest = 0.0;
    std::size_t illegal = 0; ///< items whose reference's bits are not legal
};

/// What may be legal of each item of a pass, in a run's first frame, of the items that `made` has.
Widths widths_of(const ItemPass& pass, const PassInput& in, const View& made, const Profile& profile) {
    Widths found;
    for (std::size_t item = 0; item < made.count(); ++item) {
        const auto outcomes = pass.outcomes(in, item, profile, measured_operations(profile), nullptr);
        found.illegal +=
            std::ranges::any_of(outcomes, [&](const ItemOutcome& one) { return one.contains(made, item); }) ? 0U : 1U;
        for (const ItemOutcome& one : outcomes)
            for (const Interval& set : one.values)
                found.widest = std::max(found.widest, set.any ? HUGE_VAL : set.high - set.low);
    }
    return found;
}

} // namespace

TEST_CASE("fluid left open: a followed fetch leaves a filter next to nothing, another what 8 bits give") {
    const std::string filter = GENERATE("gaussian", "narrow_range", "curvature_flow");
    INFO(filter);
    const System system = fluid::system(host_of(fetching(filter)));
    for (const Profile& profile : {by_all_bits, aligned}) {
        ReferenceRun run(system, profile);
        const std::size_t pass = run_up_to(run, system, "depth_filter_pass");
        const SystemState before = run.state();
        run.step_pass(pass, 0);
        const View made = std::as_const(run.state())[fluid::smooth_depth_image];
        const PassInput in{before.view(), 0};
        const Widths own = widths_of(*system.passes[pass], in, made, profile),
                     open = widths_of(*system.passes[pass], in, made, open_filter);
        CHECK(own.illegal == 0);
        CHECK(open.illegal == 0);
        CHECK(own.widest < 1e-5);
        CHECK(100.0 * own.widest < open.widest);
    }
}

TEST_CASE("fluid left open: lanes give what one pixel gives, whoever filters") {
    const System system = fluid::system(host_of(fetching("narrow_range")));
    for (const Profile& profile : {by_all_bits, aligned, open_filter}) {
        ReferenceRun run(system, profile);
        for (std::size_t pass = 0; pass < system.passes.size(); ++pass) {
            const ItemPass& one = *system.passes[pass];
            const SystemState before = run.state();
            run.step_pass(pass, 0);
            if (!one.name().starts_with("depth_filter") && one.name() != "normal_pass" &&
                one.name() != "fluid_shade_pass")
                continue;
            const View made = std::as_const(run.state())[one.resource()];
            const SystemView from = before.view();
            std::size_t other = 0;
            for (std::size_t item = 0; item < made.count(); ++item)
                other += one.mistaken({from, 0}, item, profile, {}) == item_words(made, item) ? 0U : 1U;
            INFO(one.name());
            CHECK(other == 0);
        }
    }
}

TEST_CASE("fluid left open: a report says on what a fetch rests, and which value promises bits") {
    const auto lines = [](const std::string& preset, const Profile& profile) {
        return fmt::format("{}", fmt::join(fluid::left_open(fluid::preset(preset), profile), "\n"));
    };
    using Catch::Contains;
    CHECK(!Contains("fetch").match(lines("paper", by_all_bits)));
    CHECK(!Contains("fetch").match(lines("paper", aligned)));
    CHECK_THAT(lines("paper", open_filter), Contains("depth_fetch=texel promises bits") &&
                                                Contains("scene_fetch=bilinear promises bits") &&
                                                Contains("(probe: image: linear filter of a plane)"));
    CHECK(lines("exact", open_filter).empty());
}

} // namespace lockstep::test::left_open_test
