#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <span>

#include "reference/arithmetic.hpp"
#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/legal_outcomes.hpp"
#include "reference/collision/step_trace.hpp"
#include "reference/model/same_bits.hpp"
#include "tests/collision/collision_scenes.hpp"

namespace lockstep::test::legal_outcomes_test {

namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

float up(float x, int ulps = 1) {
    for (; ulps > 0; --ulps)
        x = std::nextafter(x, inf);
    return x;
}

bool admits(const std::vector<LegalOutcome>& outcomes, const ParticleState& state) {
    for (const LegalOutcome& outcome : outcomes)
        if (outcome.contains(state))
            return true;
    return false;
}

std::vector<LegalOutcome> outcomes_for(const RandomScene& scene, std::size_t i, const Profile& profile,
                                       const KnownOperations& known, const ParticleState& observed) {
    return legal_outcomes(scene.particles[i], scene.cdt, scene.params, profile, known, &observed);
}

float& component(ParticleState& s, int c) {
    return c < 3 ? s.position[c] : c < 6 ? s.direction[c - 3] : c < 7 ? s.speed : s.collide_time;
}

} // namespace

TEST_CASE("legal outcomes: where everything is measured, one outcome, the reference's bits alone") {
    for (const char* preset_name : {"paper", "corrected", "exact"}) {
        RandomScene scene = random_scene(3, 3000, 41, 33);
        scene.params.switches = preset(preset_name);
        const Profile profile = named_profile("llvmpipe");
        Particles after;
        update_particles(scene.particles, scene.cdt, scene.params, profile, after);
        int undefined = 0;
        for (std::size_t i = 0; i < after.size(); ++i) {
            const auto outcomes = outcomes_for(scene, i, profile, measured_operations(profile), after[i]);
            REQUIRE(outcomes.size() == 1);
            CHECK(outcomes[0].contains(after[i]));
            CHECK(outcomes[0].ties.empty());
            if (outcomes[0].undefined != Undefined::none) {
                ++undefined;
                continue;
            }
            for (int c = 0; c < 8; ++c) {
                ParticleState other = after[i];
                component(other, c) = up(component(other, c));
                CHECK_FALSE(admits(outcomes_for(scene, i, profile, measured_operations(profile), other), other));
            }
        }
        CHECK((undefined > 0) == (std::string(preset_name) == "paper"));
    }
}

TEST_CASE("legal outcomes: GLSL's rules allow every driver's arithmetic, and little more") {
    const RandomScene scene = random_scene(5, 3000, 41, 33);
    const Profile generic = named_profile("strict");
    const KnownOperations glsl;
    std::size_t largest = 0;
    for (const char* driver : {"strict", "llvmpipe", "nvidia"}) {
        Particles after;
        update_particles(scene.particles, scene.cdt, scene.params, named_profile(driver), after);
        int accepted_far = 0;
        for (std::size_t i = 0; i < after.size(); ++i) {
            const auto outcomes = outcomes_for(scene, i, generic, glsl, after[i]);
            CHECK(admits(outcomes, after[i]));
            largest = std::max(largest, outcomes.size());
            for (int c = 0; c < 8; ++c) {
                ParticleState other = after[i];
                component(other, c) = up(component(other, c), 16);
                accepted_far += admits(outcomes_for(scene, i, generic, glsl, other), other);
                // The position is exact, given direction and speed; so is the collide time.
                other = after[i];
                component(other, c) = up(component(other, c));
                if (c < 3 || c == 7)
                    CHECK_FALSE(admits(outcomes_for(scene, i, generic, glsl, other), other));
            }
        }
        CHECK(accepted_far == 0);
    }
    CHECK(largest <= 2);
}

namespace {

/// own - (low + code * step), where own may be low + own_code * step itself.
struct Decoded {
    float own, own_code, code, low, step;
};

using Order = float (*)(const Decoded&);

/// Three terms in every order, fused and not.
constexpr Order orders[] = {
    [](const Decoded& d) { return d.own - (d.low + d.code * d.step); },
    [](const Decoded& d) { return d.own - std::fma(d.code, d.step, d.low); },
    [](const Decoded& d) { return (d.own - d.low) - d.code * d.step; },
    [](const Decoded& d) { return std::fma(-d.code, d.step, d.own - d.low); },
    [](const Decoded& d) { return (d.own - d.code * d.step) - d.low; },
    [](const Decoded& d) { return std::fma(-d.code, d.step, d.own) - d.low; },
};

/// Four, where both are decoded.
constexpr Order orders_of_two[] = {
    [](const Decoded& d) { return (d.low + d.own_code * d.step) - (d.low + d.code * d.step); },
    [](const Decoded& d) { return std::fma(d.own_code, d.step, d.low) - (d.low + d.code * d.step); },
    [](const Decoded& d) { return std::fma(d.own_code, d.step, d.low) - std::fma(d.code, d.step, d.low); },
    [](const Decoded& d) { return (d.own_code - d.code) * d.step; },
    [](const Decoded& d) { return d.own_code * d.step - d.code * d.step; },
    [](const Decoded& d) { return std::fma(d.own_code, d.step, -(d.code * d.step)); },
    [](const Decoded& d) { return ((d.low + d.own_code * d.step) - d.low) - d.code * d.step; },
    [](const Decoded& d) { return std::fma(-d.code, d.step, (d.low + d.own_code * d.step) - d.low); },
    [](const Decoded& d) { return ((d.low - d.code * d.step) + d.own_code * d.step) - d.low; },
};

} // namespace

TEST_CASE(
    "legal outcomes: any order allows every order of decoding, fused and not, and no more than a difference can be") {
    for (const SelfPosition self : {SelfPosition::vertex, SelfPosition::texel})
        for (const float low : {-1.5F, -1.1F, -1.937F}) {
            RandomScene scene = random_scene(9, 2000, 41, 33);
            scene.params.switches = preset("corrected");
            scene.params.switches.self_position = self;
            scene.params.switches.cdt_format = CdtFormat::rgba8;
            scene.params.cdt_box = {glm::vec3(low), glm::vec3(1.5F)};
            for (glm::vec4& t : scene.cdt.texels)
                t = t.a != 0.0F ? CollisionCode(scene.params).encode(glm::vec3(t)) : t;
            const Profile profile = named_profile("strict");
            KnownOperations known = measured_operations(profile);
            known.sums = false;
            const Constants& constants = scene.params.constants;
            const glm::vec3 step = (scene.params.cdt_box.max - scene.params.cdt_box.min) / 255.0F;
            int hits = 0, others = 0;
            for (std::size_t i = 0; i < scene.particles.size(); ++i) {
                const ParticleState before = scene.particles[i];
                const StepTrace trace = trace_step(before, scene.cdt, scene.params, profile);
                if (!trace.nearest)
                    continue;
                ++hits;
                const glm::vec4 code = trace.neighbours[*trace.nearest].stored;
                const glm::vec4 own_code = scene.cdt.at(trace.base.x, trace.base.y);
                const auto with = [&](Order order) {
                    ParticleState other = trace.after;
                    glm::vec3 away;
                    for (int c = 0; c < 3; ++c)
                        away[c] = order({before.position[c], own_code[c], code[c], low, step[c]});
                    other.direction = Strict::normalize(away);
                    glm::vec3 move = Strict::scale(other.direction, other.speed);
                    if (scene.params.switches.collision_step == CollisionStep::tick)
                        move = Strict::scale(move, constants.tick);
                    other.position = before.position + move;
                    return other;
                };
                for (const Order order : self == SelfPosition::texel ? std::span<const Order>(orders_of_two)
                                                                     : std::span<const Order>(orders)) {
                    ParticleState other = with(order);
                    others += same_bits(other, trace.after) ? 0 : 1;
                    if (std::isnan(other.direction.x))
                        continue;
                    CHECK(admits(outcomes_for(scene, i, profile, known, other), other));
                    other.collide_time = std::nextafter(other.collide_time, 9.0F);
                    CHECK_FALSE(admits(outcomes_for(scene, i, profile, known, other), other));
                }
            }
            CHECK(hits > 20);
            CHECK(others > 5);
            // A collide time is one difference: no order gives it another bit.
            ParticleState later = trace_step(scene.particles[0], scene.cdt, scene.params, profile).after;
            later.collide_time = std::nextafter(later.collide_time, 9.0F);
            CHECK_FALSE(admits(outcomes_for(scene, 0, profile, known, later), later));
        }
}

} // namespace lockstep::test::legal_outcomes_test
