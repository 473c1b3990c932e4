#include <algorithm>
#include <array>
#include <bit>
#include <set>

#include <fmt/format.h>

#include "reference/lights/volume_twin.hpp"
#include "reference/readings/any_order.hpp"
#include "tests/lights/lit_points.hpp"

namespace lockstep::test::worked_numbers_test {

/// Numbers that were worked out beforehand, in floats, by another program: nine digits are the float.
namespace lights = lockstep::lights;

namespace {

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

/// How many voxels the light reaches, and the sum of their weights.
std::pair<int, double> reached(const LitPoints& points) {
    int count = 0;
    double weight = 0.0;
    for (std::size_t i = 0; i < points.host().grid().count(); ++i) {
        const LitPoints::Texel texel = points.texel(i);
        count += static_cast<int>(texel[3]);
        weight += double{texel[7]};
    }
    return {count, weight};
}

/// A row whose texels 2 and 3 hold 0.2 and 1, all others 0.2 up to 2 and 1 from 3.
LitPoints row(lights::Interpolation interpolation, lights::Supersample samples) {
    lights::Settings s = one_light();
    s.switches.interpolation = interpolation;
    s.switches.supersample = samples;
    LitPoints points(s);
    for (int z = 0; z < 16; ++z)
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                points.set({x, y, z}, {x < 3 ? 0.2F : 1.0F});
    return points;
}

float at(lights::Interpolation interpolation, lights::Supersample samples, float u) {
    return row(interpolation, samples).sampled({u, 5.5F, 5.5F})[0];
}

} // namespace

TEST_CASE("lights worked numbers, E1: what one light adds to a voxel") {
    LitPoints points(one_light());
    const auto one = points.added(0, {4, 1, 5});
    REQUIRE(one);
    CHECK(bits(static_cast<float>(one->weight)) == 0x3e18e4aaU);
    const glm::vec3 d = floats(one->direction);
    CHECK(d.x == -0.0173569098F);
    CHECK(d.y == 0.138855278F);
    CHECK(d.z == -0.0520707257F);
    CHECK(bits(static_cast<float>(points.added(0, {4, 0, 4})->weight)) == 0x3d382e16U);
    CHECK(bits(static_cast<float>(points.added(0, {4, 3, 4})->weight)) == 0x3f63871cU);

    lights::Settings unweighted = one_light();
    unweighted.switches.direction_weight = lights::DirectionWeight::one;
    const glm::vec3 unit = floats(LitPoints(unweighted).added(0, {4, 1, 5})->direction);
    CHECK(unit.x == -0.116247639F);
    CHECK(unit.y == 0.929981112F);
    CHECK(unit.z == -0.348742902F);

    const auto [count, weight] = reached(points.step());
    CHECK(count == 264);
    CHECK(fmt::format("{:.4f}", weight) == "20.5205");
    lights::Settings corner = one_light();
    corner.switches.voxel_point = lights::VoxelPoint::corner;
    CHECK(reached(LitPoints(corner).step()).first == 276);
}

TEST_CASE("lights worked numbers, E2: a point of the floor") {
    LitPoints points(one_light());
    points.step();
    const LitPoints::Texel s = points.sampled({4.75F, 1.5F, 5.0F});
    CHECK(bits(s[0]) == 0x3e168ecaU);
    CHECK(s[4] == -0.0284502637F);
    CHECK(s[5] == 0.137411788F);
    CHECK(s[6] == -0.0140222572F);
    CHECK(bits(points.lit({4.75F, 1.5F, 5.0F}).x) == 0x3d92b34bU);
    CHECK(static_cast<float>(0.5 * points.truth({4.75, 1.5, 5.0})) == 0.0779518783F);
}

TEST_CASE("lights worked numbers, E3: sums in any order, and of fixed point") {
    CHECK((1.0F + 0x1p-24F) + 0x1p-24F == 1.0F);
    CHECK((0x1p-24F + 0x1p-24F) + 1.0F == 1.0F + 0x1p-23F);
    std::array<float, 4> terms{0.1F, 0.2F, 0.3F, 0.7F};
    std::set<float> sums;
    do {
        sums.insert(((terms[0] + terms[1]) + terms[2]) + terms[3]);
    } while (std::next_permutation(terms.begin(), terms.end()));
    CHECK(sums == std::set<float>{0x1.4cccccp+0F, 0x1.4ccccep+0F});
    const std::array<Interval, 4> points{0.1F, 0.2F, 0.3F, 0.7F};
    const Interval legal =
        any_order_sum(LegalArithmetic<Portable>(Portable{}, KnownOperations::all()), std::span(points));
    CHECK(legal.low == double{*sums.begin()});
    CHECK(legal.high == double{*sums.rbegin()});

    CHECK(lights::to_fixed64(double{0.7F}) == 3006477056);
    CHECK(lights::to_fixed64(double{0.1F}) == 429496736);
    std::int64_t sum = 0, coarse = 0;
    for (const float x : {0.7F, 0.1F, 0.2F, 0.3F}) {
        sum += lights::to_fixed64(double{x});
        coarse += static_cast<std::int64_t>(std::floor(x * 1024.0F + 0.5F));
    }
    CHECK(sum == 5583457504);
    CHECK(coarse == 1331);
    CHECK(lights::to_fixed64(double{-0.3F}) >> 32 == -1);
    CHECK(static_cast<std::uint32_t>(lights::to_fixed64(double{-0.3F})) == 3006477056U);
}

TEST_CASE("lights worked numbers, E3: 2^20 lights of 1 leave ten bits behind the point") {
    lights::Settings s = one_light();
    s.lights.resize(std::size_t{1} << 20U, s.lights[0]);
    s.switches.accumulate = lights::Accumulate::fixed32;
    CHECK(lights::most_fixed_bits(s) == 10);
    s.fixed_bits = 11;
    CHECK_THROWS_WITH(lights::check(s),
                      "lights: fixed_bits is 11: 1048576 lights of up to 1 would overflow; right is 0 to 10");
}

TEST_CASE("lights worked numbers, E4: a step between two texels") {
    using Way = lights::Interpolation;
    using S = lights::Supersample;
    CHECK(at(Way::nearest, S::one, 3.2F) == 1.0F);
    CHECK(bits(at(Way::trilinear, S::one, 3.2F)) == 0x3f428f5dU);
    CHECK(at(Way::trilinear8, S::one, 3.2F) == 0.759374976F);
    CHECK(at(Way::nearest, S::two, 3.2F) == 0.6F);
    CHECK(at(Way::nearest, S::four, 3.2F) == Approx(0.8).epsilon(1e-6));
    for (const S samples : {S::one, S::two, S::four})
        CHECK(at(Way::nearest, samples, 2.6F) == Approx(0.2).epsilon(1e-6));
    CHECK(at(Way::trilinear, S::one, 2.6F) == Approx(0.28).epsilon(1e-6));
}

} // namespace lockstep::test::worked_numbers_test
