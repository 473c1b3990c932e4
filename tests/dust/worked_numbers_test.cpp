#include "reference/dust/random.hpp"
#include "tests/dust/one_grain.hpp"

namespace lockstep::test::worked_numbers_test {

/// Numbers that were worked out beforehand, in floats, by another program: nine digits are the float.
namespace dust = lockstep::dust;

namespace {

/// One grain without gravity, drag or walls near it, a frame of one second unless said otherwise.
dust::Settings alone() {
    dust::Settings s;
    s.count = 1;
    s.switches.random = dust::Random::integer;
    s.switches.radius_of_scale = 1.0F;
    s.tick = 1.0F / 60.0F;
    s.gravity = glm::vec3(0.0F);
    s.air_resistance = 0.0F;
    s.scale = 0.1F;
    s.world = {{-1000.0F, -1000.0F, -1000.0F}, {1000.0F, 1000.0F, 1000.0F}};
    return s;
}

void check_vector(glm::vec3 is, glm::vec3 right) {
    CHECK(is.x == right.x);
    CHECK(is.y == right.y);
    CHECK(is.z == right.z);
}

/// The least float above 0 that `frames` of fall with drag make of it.
Grains fall(int frames) {
    dust::Settings s = alone();
    s.gravity = {0.0F, -9.8F, 0.0F};
    s.air_resistance = 1.0F;
    Grains grains(host_of(s));
    grains.place(0, {0.0F, 10.0F, 0.0F}, {});
    for (int frame = 0; frame < frames; ++frame)
        grains.run("update", frame);
    return grains;
}

} // namespace

TEST_CASE("dust by hand: a fall with drag") {
    CHECK(fall(1).velocity().y == -0.163333341F);
    CHECK(fall(1).position().y == 9.99727821F);
    CHECK(fall(2).velocity().y == -0.323944449F);
    CHECK(fall(2).position().y == 9.99187946F);
    CHECK(fall(60).velocity().y == -6.2250371F);
    CHECK(fall(60).position().y == 6.32128525F);
}

TEST_CASE("dust by hand: a bounce off the floor cuts the path at the contact") {
    dust::Settings s = alone();
    s.elasticity = 0.6F;
    s.scale = 1.0F;
    s.world.min.y = 0.0F;
    Grains grains(host_of(s));
    grains.place(0, {0.0F, 1.2F, 0.0F}, {18.0F, -36.0F, 0.0F});
    grains.run("update");
    check_vector(grains.position(), {0.220000029F, 1.24000001F, 0.0F});
    check_vector(grains.velocity(), {10.8000002F, 21.6000004F, 0.0F});
}

TEST_CASE("dust by hand: a sphere, hit from outside and started in") {
    dust::Settings s = alone();
    s.elasticity = 0.6F;
    s.colliders = {{.position = {0.0F, 2.5F, 0.0F}, .radius = 5.0F}};
    Grains grains(host_of(s));
    grains.place(0, {3.0F, 8.0F, 0.0F}, {0.0F, -120.0F, 0.0F});
    grains.run("update");
    check_vector(grains.position(), {3.35638571F, 6.73967648F, 0.0F});
    check_vector(grains.velocity(), {68.5007858F, 22.1730118F, 0.0F});
    grains.place(0, {1.0F, 2.5F, 0.0F}, {6.0F, 0.0F, 0.0F});
    grains.run("update");
    check_vector(grains.position(), {-8.81999969F, 2.5F, 0.0F});
    CHECK(grains.velocity().x == -3.60000014F);
}

TEST_CASE("dust by hand: an axis-aligned box refuses the face that the ray does not enter by") {
    dust::Settings s = alone();
    s.elasticity = 0.5F;
    s.switches.box_kind = dust::BoxKind::aabb;
    s.switches.box_detect = dust::BoxDetect::rounded;
    s.colliders = {{.sphere = false, .scale = glm::vec3(2.0F)}};
    Grains grains(host_of(s));
    grains.place(0, {1.2F, 1.5F, 0.0F}, {-12.0F, -36.0F, 0.0F});
    grains.run("update");
    check_vector(grains.position(), {1.03333342F, 1.20000005F, 0.0F});
    check_vector(grains.velocity(), {-6.0F, 18.0F, 0.0F});
}

TEST_CASE("dust by hand: a box that is turned by 45 degrees") {
    dust::Settings s = alone();
    s.elasticity = 0.5F;
    s.colliders = {
        {.sphere = false, .position = {0.0F, 3.0F, 0.0F}, .scale = {4.0F, 1.0F, 2.0F}, .rotate = {0.0F, 0.0F, 45.0F}}};
    s.tick = (4.2F - 3.4F) / 48.0F; // so that the next position is 3.4 to the bit
    REQUIRE(4.2F + -48.0F * s.tick == 3.4F);
    Grains grains(host_of(s));
    grains.place(0, {0.2F, 4.2F, 0.1F}, {0.0F, -48.0F, 0.0F});
    grains.run("update");
    check_vector(grains.position(), {-0.124263972F, 4.04852819F, 0.100000001F});
    CHECK(grains.velocity().x == -23.9999981F);
    CHECK(grains.velocity().z == 0.0F);
}

TEST_CASE("dust by hand: suction pulls a grain into the mouth, where it leaves the cone and dies") {
    dust::Settings s = alone();
    s.air_resistance = 1.0F;
    s.controller = {{0, {0.0F, 5.0F, 0.0F}, {0.0F, 0.0F, 1.0F}}};
    s.tools = {{.kind = dust::Tool::Kind::vacuum, .from = 0, .to = 100, .force = 30.0F, .range = 25.0F}};
    Grains grains(host_of(s));
    grains.place(0, {0.0F, 5.0F, 4.0F}, {});
    grains.run("vacuum_up", 0);
    CHECK(grains.velocity().z == -0.93750006F);
    grains.run("update", 0);
    CHECK(grains.position().z == 3.98463535F);
    grains.run("vacuum_up", 1);
    CHECK(grains.velocity().z == -1.86661899F);
    grains.run("update", 1);
    for (int frame = 2; frame < 18; ++frame) {
        grains.run("vacuum_up", frame);
        grains.run("update", frame);
    }
    CHECK(grains.alive() == 1);
    CHECK(grains.count() == 1);
    grains.run("vacuum_up", 18);
    CHECK(grains.alive() == 0);
    CHECK(grains.count() == 0);
}

TEST_CASE("dust by hand: an explosion fades with the squared distance") {
    dust::Settings s = alone();
    s.colliders = {{.position = {0.0F, 0.0F, 0.0F}, .radius = 1.0F}};
    s.cannon = {{.frame = 0, .position = glm::vec3(0.0F), .speed = 0.0F, .range = 10.0F, .force = 3000.0F}};
    const dust::HostPtr host = host_of(s);
    REQUIRE(host->explosion(1, 0) != nullptr);
    check_vector(host->explosion(1, 0)->position, glm::vec3(0.0F));
    Grains grains(host);
    grains.place(0, {3.0F, 4.0F, 0.0F}, {});
    grains.run("explode", 1);
    check_vector(grains.velocity(), {27.0F, 36.0F, 0.0F});
}

TEST_CASE("dust by hand: integer random numbers have their published anchors") {
    using dust::integer_random;
    using dust::Stream;
    CHECK(dust::pcg(0) == 0x07bb2fe2U);
    CHECK(integer_random(0, Stream::position_x, 0, 1) == 0x2118bc7bU);
    CHECK(integer_random(0, Stream::position_y, 0, 1) == 0xc8f2d45dU);
    CHECK(integer_random(0, Stream::position_z, 0, 1) == 0xdc9ebdd2U);
    CHECK(integer_random(12345, Stream::position_x, 0, 1) == 0x5ddef927U);
    CHECK(integer_random(12345, Stream::position_y, 0, 1) == 0x77cd92d4U);
    CHECK(integer_random(12345, Stream::position_z, 0, 1) == 0x52b6c154U);
}

TEST_CASE("dust by hand: the sine hash places grain 12345 and shades it, to the coarseness of its numbers") {
    dust::Settings s = alone();
    s.count = 12346;
    s.switches.random = dust::Random::sin_portable;
    s.spawn = {{-50.0F, 0.0F, -50.0F}, {50.0F, 5.0F, 50.0F}};
    s.colour_a = glm::vec3(0.0F);
    s.colour_b = glm::vec3(1.0F);
    Grains grains(host_of(s));
    grains.run("populate");
    // The numbers are those of a rounded sine; a sine one ULP away moves them by 1/256 at most, and here by nothing or
    // that.
    const glm::vec3 p = grains.position(12345);
    CHECK(std::abs(p.x - 27.734375F) <= 100.0F / 256.0F);
    CHECK(std::abs(p.y - 2.32421875F) <= 5.0F / 256.0F);
    CHECK(std::abs(p.z + 44.140625F) <= 100.0F / 256.0F);
    CHECK(std::abs(grains.colour(12345).r - 0.888549805F) <= 1.0F / 256.0F);
    CHECK(grains.position(0).x == -50.0F);
    CHECK(grains.count() == 12346);
}

} // namespace lockstep::test::worked_numbers_test
