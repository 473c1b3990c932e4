#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/fluid/left_open.hpp"
#include "crosscheck/judge/compare.hpp"
#include "reference/fluid/by_driver.hpp"
#include "tests/fluid/fluid_run.hpp"

namespace lockstep::test::points_outside_test {

/// Points whose middle lies outside the view volume: by drivers that drop them, as GL says, and by others.
namespace fluid = lockstep::fluid;

namespace {

using Strings = std::vector<std::string>;

const Strings as_gl_says{}, beside{fluid::dropped_outside_row},
    not_known{fluid::dropped_outside_row, fluid::drawn_beside_row};

/// Drops up to a hand before the camera: many a middle lies beside the image, its disc partly in it.
fluid::Settings near_heap(const std::string& sprite) {
    fluid::Settings s = with(in_preset(heap(), "corrected"), {"sprite=" + sprite, "filter=off"});
    s.camera.eye = {0.35F, 0.5F, 1.0F};
    return s;
}

SystemState spheres(const fluid::Settings& settings, const Profile& profile) {
    const System system = fluid::system(host_of(settings));
    ReferenceRun run(system, profile);
    for (std::size_t p = 0; p < system.passes.size(); ++p)
        run.step_pass(p, 0);
    return run.state();
}

/// How many pixels of a field's image differ.
std::size_t differing(const SystemState& a, const SystemState& b, FieldId field) {
    return differing_items(a[field.resource], b[field.resource]).size();
}

/// `sprite=quad` draws a quad for each point, so whatever its middle, as a driver of these rows may.
CheckReport check_of(const std::string& sprite, const Strings& not_followed) {
    const System system = fluid::system(host_of(near_heap("points")));
    OtherDriver side(system, fluid::passes(host_of(near_heap(sprite))), "shaders/fluid",
                     [&](Profile& profile) { profile.not_followed = not_followed; });
    CheckOptions options;
    options.frames = 1;
    return check(system, side, options);
}

} // namespace

TEST_CASE("points outside: where the driver draws those beside the image, the twins leave what quads leave") {
    const SystemState quads = spheres(near_heap("quad"), not_following(as_gl_says)),
                      drawn = spheres(near_heap("points"), not_following(beside)),
                      dropped = spheres(near_heap("points"), not_following(as_gl_says));
    for (const FieldId field : {fluid::field::depth, fluid::field::thickness}) {
        CHECK(differing(drawn, quads, field) == 0);
        CHECK(differing(dropped, quads, field) > 10);
        CHECK(differing(spheres(near_heap("points"), not_following(not_known)), dropped, field) == 0);
    }
}

TEST_CASE("points outside: one beyond the far plane is drawn by no driver that is followed") {
    fluid::Settings s = with(near_heap("points"), {"scene_depth=ignore"});
    s.camera.far_plane = 0.5F;
    const SystemState drawn = spheres(s, not_following(beside));
    s.switches.sprite = fluid::Sprite::quad;
    CHECK(differing(drawn, spheres(s, not_following(beside)), fluid::field::thickness) > 20);
}

TEST_CASE("points outside: a driver that draws them is legal where its rows say so, and divergent where they do not") {
    if (!gl())
        return skip(gl().missing());
    const auto verdict = [](const std::string& sprite, const Strings& rows) {
        const CheckReport report = check_of(sprite, rows);
        INFO(report_text(report, {}));
        return report.verdict;
    };
    CHECK(passes(check_of("quad", beside)));
    CHECK(verdict("quad", as_gl_says) == Verdict::divergent);
    CHECK(passes(check_of("points", as_gl_says)));
    CHECK(verdict("points", beside) == Verdict::divergent);
    for (const std::string sprite : {"quad", "points"})
        CHECK(verdict(sprite, not_known) == Verdict::legal);
}

TEST_CASE("points outside: a report says that a driver departs from GL, and which value promises bits") {
    const auto lines = [](const std::string& sprite, const Strings& rows) {
        return fmt::format("{}", fmt::join(fluid::left_open(near_heap(sprite).switches, not_following(rows)), "\n"));
    };
    using Catch::Contains;
    CHECK(lines("points", as_gl_says).empty());
    CHECK(lines("quad", not_known).empty());
    CHECK_THAT(lines("points", beside), Contains("departs from GL 4.5, 13.5") && Contains("and so do the twins") &&
                                            Contains("sprite=quad promises bits") && !Contains("may be drawn or not"));
    CHECK_THAT(lines("points", not_known), Contains("may be drawn or not") && !Contains("so do the twins"));
    CHECK(lines("points", {fluid::point_coord_row}).empty());
    CHECK_THAT(lines("points", {fluid::point_coord_row, fluid::cut_point_coord_row}), Contains("gl_PointCoord"));
}

} // namespace lockstep::test::points_outside_test
