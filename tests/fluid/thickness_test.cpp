#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "reference/known_operations.hpp"
#include "tests/fluid/fluid_run.hpp"

namespace lockstep::test::thickness_test {

/// What is legal of a thickness where the edges of many discs are open.
namespace fluid = lockstep::fluid;

namespace {

/// Discs over one another: a pixel at the edge of one is at the edge of all.
fluid::Settings one_behind_another() {
    fluid::Settings s;
    s.radius = 0.25F;
    s.width = 200;
    s.height = 200;
    s.camera = {.eye = {0.0F, 0.0F, 2.0F}, .target = {0.0F, 0.0F, 0.0F}, .near_plane = 0.125F, .far_plane = 40.0F};
    s.particles.assign(20, {0.0F, 0.0F, 0.0F});
    return s;
}

struct LegalThickness {
    std::size_t most_ways = 0, undefined = 0, not_held = 0;
    std::size_t edges = 0; ///< pixels with something or nothing
};

/// Of every pixel what is legal, and whether it holds what the reference makes of both.
LegalThickness legal_thickness(const fluid::Settings& settings) {
    const System system = fluid::system(host_of(settings));
    const Profile profile = named_profile("nvidia");
    ReferenceRun run(system, profile);
    const std::size_t p = run_up_to(run, system, "thickness_pass");
    const std::uint8_t resource = system.passes[p]->resource();
    const SystemState before = run.state();
    run.step_pass(p, 0);
    LegalThickness found;
    for (std::size_t i = 0; i < before[resource].count(); ++i) {
        const auto outcomes =
            system.passes[p]->outcomes({before.view(), 0}, i, profile, measured_operations(profile), nullptr);
        found.most_ways = std::max(found.most_ways, outcomes.size());
        bool held = false;
        for (const ItemOutcome& one : outcomes) {
            found.undefined += one.undefined != Undefined::none ? 1 : 0;
            held = held || one.contains(run.state()[resource], i);
            found.edges += one.values[0].low <= 0.0 && one.values[0].high > 0.0 ? 1 : 0;
        }
        found.not_held += held ? 0 : 1;
    }
    return found;
}

} // namespace

TEST_CASE("thickness: what is legal is one set where twenty discs have their edge, not a way for each choice") {
    for (const std::string sum : {"blend", "blend_exact"}) {
        INFO(sum);
        const LegalThickness legal =
            legal_thickness(with(in_preset(one_behind_another(), "paper"), {"thickness_sum=" + sum}));
        CHECK(legal.most_ways == 1);
        CHECK(legal.undefined == 0);
        CHECK(legal.not_held == 0);
        CHECK(legal.edges > 0);
    }
}

} // namespace lockstep::test::thickness_test
