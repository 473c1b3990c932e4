#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

#include "reference/fluid/unit_normal.hpp"
#include "reference/known_operations.hpp"
#include "tests/fluid/fluid_run.hpp"

namespace lockstep::test::unit_normal_test {

/// Normals of points that may be anywhere on their rays: legal sets where the cross product's own hold 0.
namespace fluid = lockstep::fluid;

namespace {

/// A pixel of 160 x 160, its right and its upper neighbour.
fluid::PointsOnRays rays_at(int x, int y) {
    const auto ray = [](int i, int j) {
        return glm::dvec3((2.0 * i + 1.0 - 160.0) / 160.0 * 0.577, (2.0 * j + 1.0 - 160.0) / 160.0 * 0.577, -1.0);
    };
    return {{}, {ray(x, y), ray(x + 1, y), ray(x, y + 1)}};
}

/// As a shader computes it, in floats.
glm::vec3 normal_of(const fluid::PointsOnRays& points, const glm::vec3& forward) {
    glm::vec3 p[3];
    for (int i = 0; i < 3; ++i)
        p[i] = glm::vec3(points.ray[static_cast<std::size_t>(i)]) * forward[i];
    const glm::vec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
    return n / std::sqrt(glm::dot(n, n));
}

} // namespace

TEST_CASE("unit normal: holds what floats make of any points of the rays, and little more where they are near") {
    Random random(17, 0);
    int known = 0;
    for (int turn = 0; turn < 60; ++turn) {
        fluid::PointsOnRays points =
            rays_at(static_cast<int>(160.0 * random.unit()), static_cast<int>(160.0 * random.unit()));
        const bool is_wide = turn % 2 == 0;
        const double middle = 0.2 + 3.0 * random.unit();
        for (Interval& f : points.forward) {
            const double low = middle * (1.0 + 0.01 * random.unit());
            f = {low, low * (is_wide ? 1.0 + 20.0 * random.unit() * random.unit() : 1.0 + 1e-6)};
        }
        const auto sets = fluid::unit_normal(points);
        if (!sets)
            continue;
        ++known;
        std::array<Interval, 3> seen;
        seen.fill({1.0, -1.0});
        for (int trial = 0; trial < 200; ++trial) {
            glm::vec3 forward;
            for (int i = 0; i < 3; ++i) {
                const Interval& f = points.forward[static_cast<std::size_t>(i)];
                const double share = trial < 8 ? (trial >> i & 1) : random.unit();
                forward[i] = std::clamp(static_cast<float>(f.low + share * (f.high - f.low)),
                                        std::nextafter(static_cast<float>(f.low), HUGE_VALF),
                                        std::nextafter(static_cast<float>(f.high), 0.0F));
            }
            const glm::vec3 n = normal_of(points, forward);
            for (int c = 0; c < 3; ++c) {
                const auto at = static_cast<std::size_t>(c);
                INFO(turn << " " << trial << " " << c << ": " << n[c]);
                CHECK((*sets)[at].contains(n[c]));
                seen[at] = interval::hull(seen[at], Interval(n[c]));
            }
        }
        for (std::size_t c = 0; c < 3; ++c)
            CHECK((*sets)[c].high - (*sets)[c].low < seen[c].high - seen[c].low + (is_wide ? 1.0 : 0.001));
    }
    CHECK(known >= 58);
}

TEST_CASE("unit normal: of points that may lie at the eye, or anywhere, nothing is known") {
    fluid::PointsOnRays points = rays_at(40, 90);
    points.forward = {Interval(1.0, 1.5), Interval(1.0, 2.0), Interval(0.5, 2.0)};
    CHECK(fluid::unit_normal(points));
    points.forward[1] = {0.0, 2.0};
    CHECK_FALSE(fluid::unit_normal(points));
    points.forward[1] = Interval::anything();
    CHECK_FALSE(fluid::unit_normal(points));
    points.forward[1] = {1.0, HUGE_VAL};
    CHECK_FALSE(fluid::unit_normal(points));
}

TEST_CASE("unit normal: a product's length is lost where its least is little beside what its greatest is rounded by") {
    const Interval wide(-5e-4, 5e-4), near(4e-8, 9e-5), far(1e-4, 2e-4);
    CHECK(fluid::may_lack_length({wide, wide, wide}));
    CHECK(fluid::may_lack_length({wide, wide, near})); // above 0, and 1e-10 of the whole
    CHECK(fluid::may_lack_length({wide, wide, Interval::anything()}));
    CHECK(fluid::may_lack_length({wide, wide, Interval(NAN)}));
    CHECK_FALSE(fluid::may_lack_length({wide, wide, far}));
    CHECK_FALSE(fluid::may_lack_length({Interval(0.0F), Interval(0.0F), far}));
}

TEST_CASE("unit normal: no normal of the published values is undefined, whatever a filtered fetch may give") {
    fluid::Settings s = in_preset(heap(), "paper");
    const System system = fluid::system(host_of(s));
    const Profile profile = named_profile("nvidia");
    ReferenceRun run(system, profile);
    const std::size_t p = run_up_to(run, system, "normal_pass");
    const SystemView before = run.state().view();
    const KnownOperations known = measured_operations(profile);
    int judged = 0, undefined = 0;
    for (std::size_t i = 0; i < before[system.passes[p]->resource()].count(); i += 3) {
        const auto outcomes = system.passes[p]->outcomes({before, 0}, i, profile, known, nullptr);
        ++judged;
        undefined +=
            std::ranges::any_of(outcomes, [](const ItemOutcome& one) { return one.undefined != Undefined::none; }) ? 1
                                                                                                                   : 0;
    }
    CHECK(judged == 44 * 36 / 3);
    CHECK(undefined == 0);
}

} // namespace lockstep::test::unit_normal_test
