#include <catch2/catch.hpp>

#include <cmath>
#include <initializer_list>
#include <limits>

#include "reference/collision/collision_pass.hpp"
#include "reference/collision/situations.hpp"
#include "reference/model/profile.hpp"
#include "tests/collision/collision_scenes.hpp"

namespace lockstep::test::situations_test {

namespace {

constexpr std::initializer_list<Situation> counted_of_all{Situation::search,        Situation::hit,
                                                          Situation::at_border,     Situation::left_of_image,
                                                          Situation::behind_camera, Situation::not_a_number};

} // namespace

TEST_CASE("situations: those that are counted over all particles are the same however few are looked at closely") {
    const auto seed = GENERATE(range(1U, 9U));
    RandomScene scene = random_scene(seed, 5000, 48, 36);
    scene.params.constants.texel_collide_range = 1 + static_cast<int>(seed % 4);
    Random random(seed);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < scene.particles.size(); i += 7) { // anywhere, and nowhere
        glm::vec3& position = scene.particles.position[i];
        position *= random.between(-3.0F, 3.0F);
        if (i % 5 == 0)
            position.x = i % 2 == 0 ? infinity : 1e38F;
        if (i % 11 == 0)
            position.y = std::nanf("");
        if (i % 13 == 0)
            position.z = -1e20F;
    }
    for (const bool divides : {true, false}) {
        scene.params.switches.perspective_divide = divides ? PerspectiveDivide::on : PerspectiveDivide::off;
        Particles after;
        update_particles(scene.particles, scene.cdt, scene.params, {}, after);
        const Situations closely = situations_of(scene.particles, scene.cdt, scene.params, {}, after, 5000),
                         few = situations_of(scene.particles, scene.cdt, scene.params, {}, after, 1);
        for (const Situation situation : counted_of_all) {
            INFO("situation " << static_cast<int>(situation) << (divides ? ", divided" : ", not divided"));
            CHECK(few.of(situation) == closely.of(situation));
            CHECK((!divides || closely.of(situation) > 0));
        }
    }
}

} // namespace lockstep::test::situations_test
