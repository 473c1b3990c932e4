#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "reference/model/collision/collision_state.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep::test::state_hash_test {

namespace {

Particles two_particles() {
    Particles p;
    p.resize(2);
    p.position = {{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}};
    p.direction = {{0.0F, 1.0F, 0.0F}, {1.0F, 0.0F, 0.0F}};
    p.speed = {0.5F, 0.25F};
    p.collide_time = {-0.1F, 0.2F};
    return p;
}

} // namespace

TEST_CASE("state_hash: a fixed state keeps its written hash") {
    CHECK(hash_text(state_hash(two_particles())) == "956d9dc55f0ea4cc");
}

TEST_CASE("state_hash: one bit, a swap, or a value in another field changes it") {
    const std::uint64_t original = state_hash(two_particles());
    Particles p = two_particles();
    p.speed[1] = std::nextafter(p.speed[1], 1.0F);
    CHECK(state_hash(p) != original);
    p = two_particles();
    std::swap(p.position[0], p.position[1]);
    CHECK(state_hash(p) != original);
    p = two_particles();
    std::swap(p.position, p.direction);
    CHECK(state_hash(p) != original);
    p = two_particles();
    p.direction[0].x = -0.0F;
    CHECK(state_hash(p) != original);
}

TEST_CASE("state_hash: every NaN counts as one") {
    Particles a = two_particles();
    Particles b = two_particles();
    a.speed[0] = std::numeric_limits<float>::quiet_NaN();
    b.speed[0] = -std::nanf("7");
    CHECK(state_hash(a) == state_hash(b));
}

} // namespace lockstep::test::state_hash_test
