#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <utility>

#include "crosscheck/judge/compare.hpp"
#include "crosscheck/judge/item_sample.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/ulp.hpp"

namespace lockstep::test::compare_test {

namespace {

constexpr float quiet_nan = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();

Particles particles(std::size_t count) {
    Particles p;
    p.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto x = static_cast<float>(i);
        p.position[i] = {x, x + 0.25F, x + 0.5F};
        p.direction[i] = {0.0F, 1.0F, 0.0F};
        p.speed[i] = 1.0F + x;
        p.collide_time[i] = -0.5F;
    }
    return p;
}

} // namespace

TEST_CASE("ulp: neighbours are 1 apart, across zero and up to infinity") {
    CHECK(ulp_distance(1.0F, std::nextafter(1.0F, 2.0F)) == 1);
    CHECK(ulp_distance(-0x1p-149F, 0x1p-149F) == 2);
    CHECK(ulp_distance(std::numeric_limits<float>::max(), inf) == 1);
    CHECK(ulp_distance(0.0F, -0.0F) == 0);
}

TEST_CASE("ulp: a sign flip and a NaN are far") {
    CHECK(ulp_distance(1.0F, -1.0F) == 2 * std::int64_t{0x3f800000});
    CHECK(ulp_distance(1.0F, quiet_nan) == INT64_MAX);
    CHECK(ulp_distance(quiet_nan, -quiet_nan) == 0);
}

TEST_CASE("item sample: what is unlike the background is found wherever it lies, and of items all unlike none") {
    Particles background;
    background.resize(3000);
    background.position[17].x = 1.0F;
    background.collide_time[2999] = -1.0F;
    CHECK(items_unlike_most(view(std::as_const(background))) == std::vector<std::size_t>{17, 2999});
    const Particles all_unlike = particles(3000);
    CHECK(items_unlike_most(view(all_unlike)).empty());
}

TEST_CASE("compare: equal states agree, and everything was compared") {
    const Comparison c = compare(particles(3000), particles(3000));
    CHECK(c.agree());
    CHECK(c.compared() == 3000 * 8);
    CHECK(c.worst.empty());
}

TEST_CASE("compare: one ULP in any component of any field is found and told") {
    for (const std::size_t index : {std::size_t{0}, std::size_t{1023}, std::size_t{1024}, std::size_t{2999}}) {
        for (int component = 0; component < 8; ++component) {
            const Particles reference = particles(3000);
            Particles gpu = particles(3000);
            float* const floats[] = {&gpu.position[index].x,  &gpu.position[index].y,  &gpu.position[index].z,
                                     &gpu.direction[index].x, &gpu.direction[index].y, &gpu.direction[index].z,
                                     &gpu.speed[index],       &gpu.collide_time[index]};
            const float before = *floats[component];
            *floats[component] = std::nextafter(before, inf);
            const Comparison c = compare(reference, gpu);
            CHECK(c.differing(collision::particles) == 1);
            REQUIRE(c.worst.size() == 1);
            CHECK(c.worst[0].index == index);
            CHECK(c.worst[0].reference == before);
            CHECK(c.worst[0].ulp == 1);
        }
    }
}

TEST_CASE("compare: a swap of two particles, a lone NaN, -0 and the largest float are differences") {
    const Particles reference = particles(10);
    Particles gpu = particles(10);
    std::swap(gpu.position[3], gpu.position[4]);
    CHECK(compare(reference, gpu).differing(collision::particles) == 2);
    gpu = particles(10);
    gpu.speed[7] = quiet_nan;
    const Comparison lone = compare(reference, gpu);
    CHECK(lone.differing(collision::particles) == 1);
    CHECK(lone[collision::speed].nan == 1);
    gpu = particles(10);
    gpu.direction[2].x = -0.0F;
    CHECK(compare(reference, gpu).differing(collision::particles) == 1);
    Particles large = particles(10);
    large.speed[0] = std::numeric_limits<float>::max();
    gpu = large;
    gpu.speed[0] = inf;
    CHECK(compare(large, gpu).differing(collision::particles) == 1);
}

TEST_CASE("compare: equal NaNs agree whatever their payload, and are counted") {
    Particles reference = particles(10);
    Particles gpu = particles(10);
    reference.speed[5] = quiet_nan;
    gpu.speed[5] = -std::nanf("3");
    const Comparison c = compare(reference, gpu);
    CHECK(c.agree());
    CHECK(c[collision::speed].nan == 1);
}

TEST_CASE("compare: the worst are kept, largest ULP first, whatever the thread count") {
    const Particles reference = particles(20000);
    Particles gpu = reference;
    for (std::size_t i = 0; i < gpu.size(); i += 100)
        gpu.speed[i] = reference.speed[i] + static_cast<float>(i % 7000 + 1);
    const Comparison c = compare(reference, gpu);
    CHECK(c.differing(collision::particles) == 200);
    REQUIRE(c.worst.size() == Comparison::worst_kept);
    for (std::size_t k = 1; k < c.worst.size(); ++k)
        CHECK(c.worst[k - 1].ulp >= c.worst[k].ulp);
}

TEST_CASE("compare: one texel component is found with its texel") {
    const CollisionImage reference(60, 50, glm::vec4(1.0F));
    CollisionImage gpu = reference;
    gpu.at(12, 40).z = 0.0F;
    const Comparison c = compare(reference, gpu);
    CHECK(c.differing(collision::cdt) == 1);
    CHECK_FALSE(c.agree());
    REQUIRE(c.worst.size() == 1);
    CHECK(c.worst[0].index == reference.index(12, 40));
    CHECK(c.worst[0].component == 2);
}

} // namespace lockstep::test::compare_test
