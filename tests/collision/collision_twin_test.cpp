#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_pass_fast.hpp"
#include "reference/collision/collision_twin.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/subnormals.hpp"
#include "reference/with_arithmetic.hpp"
#include "tests/collision/collision_scenes.hpp"

namespace lockstep::test::collision_twin_test {

namespace {

Particles twin_steps(const RandomScene& scene, const Profile& profile) {
    Particles after;
    after.resize(scene.particles.size());
    const FlushSubnormals guard(profile.flush_subnormals);
    with_arithmetic(profile, scene.params.switches.arithmetic, [&]<class A>(A fp) {
        Values<A> values(fp);
        const CollisionTwin twin(values, scene.cdt, scene.params);
        for (std::size_t i = 0; i < after.size(); ++i) {
            const auto v = twin(scene.particles[i]);
            after.set(i, {floats(v.position), floats(v.direction), static_cast<float>(v.speed),
                          static_cast<float>(v.collide_time)});
        }
    });
    return after;
}

std::size_t check_equal(const RandomScene& scene, const Profile& profile) {
    Particles expected;
    update_particles_fast(scene.particles, scene.cdt, scene.params, profile, expected);
    CHECK(same_bits(twin_steps(scene, profile), expected));
    std::size_t hits = 0;
    for (const float time : expected.collide_time)
        hits += time == scene.params.constants.collision_time;
    return hits;
}

} // namespace

TEST_CASE(
    "collision twin: its values are the fast pass's bits for every combination of switches and every arithmetic") {
    RandomScene scene = random_scene(31, 300, 21, 15);
    scene.params.cdt_box = {glm::vec3(-1.5F), glm::vec3(1.5F)};
    std::vector<Switches> combinations{preset("corrected"), preset("exact")};
    for (const SwitchInfo& info : switch_table()) {
        if (info.values.size() < 2 || info.name == "arithmetic" || info.name == "cdt_camera" ||
            info.name == "obstacles_in_cdt" || info.name == "raster_position" || chooses_pass(info.name))
            continue;
        std::vector<Switches> next;
        for (const Switches& switches : combinations)
            for (const std::string_view value : info.values) {
                next.push_back(switches);
                set_switch(next.back(), info.name, value);
            }
        combinations = std::move(next);
    }
    const std::vector<glm::vec4> positions = scene.cdt.texels;
    std::size_t hits = 0;
    for (const Switches& switches : combinations) {
        scene.params.switches = switches;
        for (std::size_t t = 0; t < positions.size(); ++t)
            if (positions[t].a != 0.0F)
                scene.cdt.texels[t] = CollisionCode(scene.params).encode(positions[t]);
        scene.params.constants.texel_collide_range = 1 + static_cast<int>(hits % 3);
        for (const char* profile : {"strict", "llvmpipe", "nvidia"})
            hits += check_equal(scene, named_profile(profile));
    }
    CHECK(combinations.size() == 2 * 64 * 2 * 2 * 3);
    CHECK(hits > 20000);
}

TEST_CASE("collision twin: NaN, infinities, subnormals and coinciding positions") {
    constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    for (const char* name : {"listing", "paper", "corrected", "exact"})
        for (const bool flush : {true, false})
            for (const float odd : {nan, inf, -inf, 0.0F, -0.0F, 1e-40F, -1e-40F, 0x1p-126F, 3e38F}) {
                RandomScene scene = random_scene(32, 900, 21, 15);
                scene.params.switches = preset(name);
                Random random(7);
                const auto spoil = [&](float& x) { x = random.chance(0.1F) ? odd : x; };
                for (std::size_t i = 0; i < scene.particles.size(); ++i) {
                    for (int c = 0; c < 3; ++c)
                        spoil(scene.particles.position[i][c]), spoil(scene.particles.direction[i][c]);
                    spoil(scene.particles.speed[i]);
                    spoil(scene.particles.collide_time[i]);
                }
                for (glm::vec4& texel : scene.cdt.texels)
                    for (int c = 0; c < 3; ++c)
                        spoil(texel[c]);
                Profile profile;
                profile.flush_subnormals = flush;
                INFO(name << ", flush " << flush << ", " << odd);
                check_equal(scene, profile);
            }
}

} // namespace lockstep::test::collision_twin_test
