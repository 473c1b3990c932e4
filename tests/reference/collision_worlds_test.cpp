#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "reference/collision/collision_worlds.hpp"
#include "reference/collision_code.hpp"
#include "tests/reference/collision_scenes.hpp"

using namespace lockstep;
using namespace lockstep::test;

namespace {

bool equal(const Interval& a, const Interval& b) {
    const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
    return a.any == b.any && (a.any || (same(a.low, b.low) && same(a.high, b.high)));
}
bool equal(const Interval3& a, const Interval3& b) {
    return equal(a[0], b[0]) && equal(a[1], b[1]) && equal(a[2], b[2]);
}
bool among(const LegalOutcome& a, const std::vector<LegalOutcome>& others) {
    return std::any_of(others.begin(), others.end(), [&](const LegalOutcome& b) {
        return equal(a.position, b.position) && equal(a.direction, b.direction) && equal(a.speed, b.speed) &&
               equal(a.collide_time, b.collide_time) && a.hit == b.hit;
    });
}

/// Particles with more than one outcome.
int check_equal(const RandomScene& scene, const Profile& profile, const KnownOperations& known) {
    int several = 0;
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        const ParticleState before = scene.particles[i];
        const auto expected = legal_outcomes(before, scene.cdt, scene.params, profile, known, nullptr);
        const auto found = collision_worlds(before, scene.cdt, scene.params, profile, known, nullptr);
        for (const LegalOutcome& outcome : expected)
            REQUIRE(among(outcome, found));
        for (const LegalOutcome& outcome : found)
            REQUIRE(among(outcome, expected));
        several += expected.size() > 1;
    }
    return several;
}

} // namespace

TEST_CASE("worlds: the collision step's legal outcomes, for every knowledge and format") {
    constexpr KnownOperations glsl, any_order{.sums = false};
    const Profile strict = named_profile("strict");
    int several = 0;
    for (const char* name : {"paper", "corrected", "exact"})
        for (const CdtFormat format : {CdtFormat::rgba32f, CdtFormat::rgba8})
            for (const bool quantised : {false, true}) {
                RandomScene scene = random_scene(17, 400, 41, 33);
                scene.params.switches = preset(name);
                scene.params.switches.cdt_format = format;
                scene.params.cdt_box = {glm::vec3(-1.5F), glm::vec3(1.5F)};
                if (quantised) {
                    for (glm::vec3& p : scene.particles.position)
                        p = glm::floor(p * 64.0F + 0.5F) / 64.0F;
                    for (glm::vec4& t : scene.cdt.texels)
                        t = {glm::floor(glm::vec3(t) * 64.0F + 0.5F) / 64.0F, t.a};
                    scene.params.collision_proj_view = glm::mat4(1.0F);
                    scene.params.collision_proj_view[3][3] = 3.0F;
                    scene.params.constants.texel_collide_range = 2;
                    for (std::size_t i = 0; i < 100; ++i)
                        scene.particles.collide_time[i] = -1e-40F;
                }
                for (glm::vec4& t : scene.cdt.texels)
                    t = t.a != 0.0F ? CollisionCode(scene.params).encode(glm::vec3(t)) : t;
                several += check_equal(scene, strict, glsl);
                if (format != CdtFormat::rgba8) // legal_outcomes takes the decoding for two ULP
                    several += check_equal(scene, strict, any_order);
                for (const char* driver : {"llvmpipe", "nvidia"})
                    several += check_equal(scene, named_profile(driver), measured_operations(named_profile(driver)));
            }
    CHECK(several > 300);
}
