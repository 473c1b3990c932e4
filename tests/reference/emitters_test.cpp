#include <catch2/catch.hpp>

#include <cmath>
#include <set>
#include <tuple>

#include <glm/geometric.hpp>
#include <omp.h>

#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/emitters.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep::test::emitters_test {

namespace {

Emitter emitter(EmitterShape shape, std::size_t count) {
    Emitter e;
    e.shape = shape;
    e.box = {{-1.0F, 2.0F, 0.0F}, {1.0F, 3.0F, 0.5F}};
    e.count = count;
    e.direction = {2.0F, 0.0F, 0.0F};
    e.direction_jitter = 0.25F;
    e.speed = 0.5F;
    e.speed_jitter = 0.1F;
    return e;
}

bool inside(const Box& box, glm::vec3 p) {
    return glm::all(glm::greaterThanEqual(p, box.min)) && glm::all(glm::lessThanEqual(p, box.max));
}

} // namespace

TEST_CASE("emitters: every shape keeps to its box, starts at collide time 0 and moves as told") {
    for (const EmitterShape shape : {EmitterShape::box, EmitterShape::lattice, EmitterShape::shell}) {
        const Emitter e = emitter(shape, 5000);
        const Particles p = emit(std::vector{e}, 9);
        REQUIRE(p.size() == 5000);
        for (std::size_t i = 0; i < p.size(); ++i) {
            REQUIRE(inside(e.box, p.position[i]));
            REQUIRE(glm::length(p.direction[i]) == Approx(1.0F).margin(1e-6));
            REQUIRE(p.direction[i].x > 0.8F);
            REQUIRE((p.speed[i] >= 0.45F && p.speed[i] <= 0.55F));
            REQUIRE(p.collide_time[i] == 0.0F);
        }
    }
}

TEST_CASE("emitters: without jitter direction and speed are exact") {
    Emitter e = emitter(EmitterShape::box, 3);
    e.direction_jitter = e.speed_jitter = 0.0F;
    const Particles p = emit(std::vector{e}, 9);
    for (std::size_t i = 0; i < p.size(); ++i) {
        CHECK(p.direction[i] == glm::vec3(1.0F, 0.0F, 0.0F));
        CHECK(p.speed[i] == 0.5F);
    }
}

TEST_CASE("emitters: a lattice of eight in a cube stands at the centres of its octants, x first, then z, then y") {
    Emitter e;
    e.shape = EmitterShape::lattice;
    e.box = {glm::vec3(0.0F), glm::vec3(4.0F)};
    e.count = 8;
    const Particles p = emit(std::vector{e}, 1);
    CHECK(p.position[0] == glm::vec3(1.0F, 1.0F, 1.0F));
    CHECK(p.position[1] == glm::vec3(3.0F, 1.0F, 1.0F));
    CHECK(p.position[2] == glm::vec3(1.0F, 1.0F, 3.0F));
    CHECK(p.position[4] == glm::vec3(1.0F, 3.0F, 1.0F));
    CHECK(p.position[7] == glm::vec3(3.0F, 3.0F, 3.0F));
}

TEST_CASE("emitters: no two particles of a lattice coincide, whatever the count") {
    for (const std::size_t count : {1U, 2U, 7U, 1000U, 1001U}) {
        const Particles p = emit(std::vector{emitter(EmitterShape::lattice, count)}, 1);
        std::set<std::tuple<float, float, float>> sites;
        for (const glm::vec3 q : p.position)
            sites.insert({q.x, q.y, q.z});
        CHECK(sites.size() == count);
    }
}

TEST_CASE("emitters: a shell is hollow") {
    Emitter e;
    e.shape = EmitterShape::shell;
    e.box = {glm::vec3(-2.0F), glm::vec3(2.0F)};
    e.count = 2000;
    e.thickness = 0.1F;
    for (const glm::vec3 q : emit(std::vector{e}, 1).position) {
        REQUIRE(glm::length(q) <= 2.0F + 1e-6F);
        REQUIRE(glm::length(q) >= 1.8F - 1e-6F);
    }
}

TEST_CASE("emitters: the same seed gives the same particles for 1, 2 and 4 threads; another seed others") {
    const std::vector emitters{emitter(EmitterShape::box, 1000), emitter(EmitterShape::lattice, 777),
                               emitter(EmitterShape::shell, 500)};
    const int before = omp_get_max_threads();
    for (const int threads : {1, 2, 4}) {
        omp_set_num_threads(threads);
        CHECK(hash_text(state_hash(emit(emitters, 5))) == "18d51ccf74cc47d5");
    }
    omp_set_num_threads(before);
    CHECK(state_hash(emit(emitters, 6)) != state_hash(emit(emitters, 5)));
}

TEST_CASE("emitters: particle i of a box does not depend on how many follow it") {
    const Particles few = emit(std::vector{emitter(EmitterShape::box, 10)}, 5);
    const Particles many = emit(std::vector{emitter(EmitterShape::box, 1000)}, 5);
    for (std::size_t i = 0; i < few.size(); ++i) {
        CHECK(few.position[i] == many.position[i]);
        CHECK(few.direction[i] == many.direction[i]);
        CHECK(few.speed[i] == many.speed[i]);
    }
}

TEST_CASE("emitters: scaled counts keep their proportions and sum exactly") {
    std::vector emitters{emitter(EmitterShape::box, 30000), emitter(EmitterShape::box, 10000),
                         emitter(EmitterShape::box, 10000)};
    for (const std::size_t total : {1U, 2U, 50001U, 4000000U, 100000000U}) {
        std::vector scaled = emitters;
        scale_counts(scaled, total);
        CHECK(scaled[0].count + scaled[1].count + scaled[2].count == total);
        CHECK(static_cast<double>(scaled[0].count) == Approx(0.6 * static_cast<double>(total)).margin(1.0));
    }
}

TEST_CASE("emitters: a shorter box keeps its side in front, and the density") {
    std::vector<Emitter> emitters{emitter(EmitterShape::box, 1000), emitter(EmitterShape::box, 1000),
                                  emitter(EmitterShape::box, 1000)};
    emitters[1].direction = {0.0F, -1.0F, 0.2F};
    emitters[2].direction = {-0.1F, 0.0F, 3.0F};
    scale_lengths(emitters, 0.5F);
    CHECK(emitters[0].box.min == glm::vec3(0.0F, 2.0F, 0.0F));
    CHECK(emitters[0].box.max == glm::vec3(1.0F, 3.0F, 0.5F));
    CHECK(emitters[1].box.min == glm::vec3(-1.0F, 2.0F, 0.0F));
    CHECK(emitters[1].box.max == glm::vec3(1.0F, 2.5F, 0.5F));
    CHECK(emitters[2].box.min == glm::vec3(-1.0F, 2.0F, 0.25F));
    CHECK(emitters[2].box.max == glm::vec3(1.0F, 3.0F, 0.5F));
}

} // namespace lockstep::test::emitters_test
