#include <limits>
#include <string>

#include "tests/fluid/fluid_run.hpp"

namespace lockstep::test::point_sizes_test {

/// Points of sizes that no driver draws: it clamps them (GL 4.5, 14.4).
namespace fluid = lockstep::fluid;

namespace {

/// Spheres far away, of less than a pixel, and some so near that they are larger than llvmpipe draws.
fluid::Settings of_sizes(bool large) {
    fluid::Settings s = with(in_preset(heap(), "corrected"), {"sprite=points", "filter=off"});
    s.width = s.height = large ? 300 : 60;
    s.camera = {.eye = {0.0F, 0.0F, 0.0F}, .target = {0.0F, 0.0F, -1.0F}, .near_plane = 0.125F, .far_plane = 100.0F};
    s.obstacles = {};
    s.particles.clear();
    if (large) {
        s.particles = {{0.02F, -0.03F, -0.2F}, {0.1F, 0.02F, -0.3F}};
        return s;
    }
    s.radius = 0.02F;
    for (int i = 0; i < 40; ++i) {
        const auto step = static_cast<float>(i);
        s.particles.emplace_back(0.37F * step - 6.0F, 0.11F * step - 2.0F, -20.0F - 0.7F * step);
    }
    return s;
}

/// A run by a driver that is said to draw these sizes; null: by what GL says of this one.
Verdict verdict_of(bool large, const PointSizes* sizes) {
    const fluid::HostPtr host = host_of(of_sizes(large));
    const System system = fluid::system(host);
    OtherDriver side(system, fluid::passes(host), "shaders/fluid", [&](Profile& profile) {
        if (sizes != nullptr)
            profile.point_sizes = *sizes;
    });
    CheckOptions options;
    options.frames = 1;
    const CheckReport report = check(system, side, options);
    UNSCOPED_INFO(report_text(report, {}));
    return report.verdict;
}

} // namespace

TEST_CASE("point sizes: a point smaller or larger than the driver draws is as small or as large as it draws") {
    if (!gl())
        return skip(gl().missing());
    constexpr float infinite = std::numeric_limits<float>::infinity();
    CHECK(verdict_of(false, nullptr) == Verdict::legal);
    CHECK(verdict_of(true, nullptr) == Verdict::legal);
    const PointSizes any{0.0F, infinite}, to_8{1.0F, 8.0F};
    CHECK(verdict_of(false, &any) == Verdict::divergent);
    CHECK(verdict_of(true, &to_8) == Verdict::divergent);
}

TEST_CASE("point sizes: a profile has those that GL says") {
    if (!gl())
        return skip(gl().missing());
    const fluid::HostPtr host = host_of(of_sizes(false));
    const System system = fluid::system(host);
    const GlSystemSide side(gl(), system, fluid::passes(host), "shaders/fluid");
    const Profile profile = side.describe().profile;
    CHECK(profile.point_sizes.smallest <= 1.0F);
    CHECK(profile.point_sizes.largest >= 64.0F);
    CHECK(profile.point_sizes.largest < 65536.0F);
}

} // namespace lockstep::test::point_sizes_test
