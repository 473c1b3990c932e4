#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "crosscheck/collision/judge/verdict.hpp"
#include "crosscheck/judge/verdict_summary.hpp"
#include "crosscheck/report/verdict_text.hpp"
#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/legal_texels.hpp"
#include "reference/collision/measured_codes.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/paired_rows.hpp"
#include "tests/collision/collision_scenes.hpp"
#include "tests/uneven_roots.hpp"

namespace lockstep::test::driver_habits_test {

/// What a driver does where GL leaves it open, or departs from it: legal as far as the probe measured it.
namespace {

Profile ruling_out(Profile profile, std::string_view row) {
    profile.not_followed.emplace_back(row);
    return profile;
}

/// A point of flat_params(), whose texel is 4 * position + 4, drawn in a frame that a side drew as `profile` says.
struct BrinkFrame {
    FrameParams params = flat_params();
    Profile profile;
    KnownOperations known;
    Mesh obstacles;
    Particles before, after;
    CollisionImage empty, drawn;

    BrinkFrame(glm::vec3 position, const Profile& followed)
        : profile(followed), known(measured_operations(followed)), before(falling(position)), after(before),
          empty(empty_cdt(params)), drawn(empty) {}

    /// The point's code in a texel where GL leaves nothing.
    ItemVerdict verdict_at(int x, int y) {
        drawn = empty;
        drawn.at(x, y) = CollisionCode(params).encode(after.position[0]);
        const FrameVerdicts all = judge(judged());
        REQUIRE(all.texels.size() == 1);
        return all.texels[0];
    }
    [[nodiscard]] JudgedFrame judged() const {
        return {obstacles, params, profile, known, before, empty, after, empty, after, drawn};
    }
};

constexpr float just_outside = 1.0F + 0x1p-12F; // window 8 + 2^-10, on the border of a grid of 256ths

} // namespace

TEST_CASE("driver habits: a stored code may be what the probe measured, and a neighbour where it measured nothing") {
    const Profile nothing;
    FrameParams params = flat_params();
    params.switches.cdt_format = CdtFormat::rgba16f;
    const auto x_of = [&](float x, const Profile& profile) {
        const auto [low, high] = measured_codes(params, glm::vec3(x), glm::vec3(x), profile);
        return std::array{low.x, high.x};
    };
    const Profile cuts = ruling_out(nothing, drawn_half_rows.first),
                  rounds = ruling_out(nothing, drawn_half_rows.second);
    const float nearly_above = 1.0F + 0x1.cp-11F, below = 1.0F, above = 1.0F + 0x1p-10F;
    CHECK(x_of(nearly_above, nothing) == std::array{below, above});
    CHECK(x_of(nearly_above, cuts) == std::array{below, below});
    CHECK(x_of(-nearly_above, cuts) == std::array{-below, -below});
    CHECK(x_of(nearly_above, rounds) == std::array{above, above});
    CHECK(x_of(nearly_above, ruling_out(cuts, drawn_half_rows.second)) == std::array{below, above});

    params.switches.cdt_format = CdtFormat::rgba8;
    params.cdt_box = {glm::vec3(0.0F), glm::vec3(255.0F)};
    const Profile nearest = ruling_out(nothing, drawn_unorm8_rows.second),
                  floors = ruling_out(nothing, drawn_unorm8_rows.first);
    CHECK(x_of(100.75F, nothing) == std::array{100.0F, 101.0F});
    CHECK(x_of(100.75F, nearest) == std::array{101.0F, 101.0F});
    CHECK(x_of(100.5F, nearest) == std::array{100.0F, 101.0F}); // a tie
    CHECK(x_of(100.75F, floors) == std::array{100.0F, 100.0F});
    CHECK(x_of(300.0F, nearest) == std::array{255.0F, 255.0F});
}

TEST_CASE(
    "driver habits: a point just outside the view volume is a tie that names the driver, where it draws such points") {
    const Profile draws = ruling_out(profile_with_roots(), brink_rows.first);
    for (const glm::vec2 at : {glm::vec2(just_outside, 0.125F), glm::vec2(0.125F, just_outside)}) {
        BrinkFrame frame({at, 0.25F}, draws);
        const bool right = at.x > 1.0F;
        const ItemVerdict verdict = frame.verdict_at(right ? 7 : 4, right ? 4 : 7);
        CHECK(verdict.kind == DifferenceClass::tie);
        REQUIRE(verdict.tie);
        CHECK(verdict.tie->kind == outside_tie);
        CHECK(verdict.tie->margin == Approx(0.25));
        CHECK_FALSE(verdict.lean);
        VerdictSummary summary(collision_schema());
        FrameVerdicts verdicts;
        verdicts.texels = {verdict};
        summary.add(0, collision::cdt, verdicts.texels);
        CHECK_THAT(verdict_text(summary, collision_schema(), {}),
                   Catch::Contains("the driver draws points outside the view volume: 1"));
    }
}

TEST_CASE("driver habits: such a point is divergent where the driver was measured to drop it, and a tie where none "
          "measured") {
    const std::vector<Profile> all{named_profile("llvmpipe"), named_profile("nvidia"), profile_with_roots()};
    for (const Profile& profile : all) {
        INFO(profile.name);
        CHECK(BrinkFrame({just_outside, 0.125F, 0.25F}, profile).verdict_at(7, 4).kind == DifferenceClass::tie);
        CHECK(BrinkFrame({just_outside, 0.125F, 0.25F}, ruling_out(profile, brink_rows.second)).verdict_at(7, 4).kind ==
              DifferenceClass::divergent);
    }
}

TEST_CASE(
    "driver habits: no driver draws a point that lies further out, beyond its depths, or where the grid has none") {
    const Profile draws = ruling_out(profile_with_roots(), brink_rows.first);
    const auto kind = [&](glm::vec3 position, int x, int y) {
        return BrinkFrame(position, draws).verdict_at(x, y).kind;
    };
    CHECK(kind({just_outside, 0.125F, 0.25F}, 7, 5) == DifferenceClass::divergent);   // another texel
    CHECK(kind({1.125F, 0.125F, 0.25F}, 7, 4) == DifferenceClass::divergent);         // half a pixel
    CHECK(kind({1.0F + 0x1p-8F, 0.125F, 0.25F}, 7, 4) == DifferenceClass::divergent); // four units of the grid
    CHECK(kind({just_outside, 0.125F, 3.0F}, 7, 4) == DifferenceClass::divergent);
    CHECK(kind({-just_outside, 0.125F, 0.25F}, 0, 4) == DifferenceClass::divergent); // an edge is the lower pixel's
}

} // namespace lockstep::test::driver_habits_test
