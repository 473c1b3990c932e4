#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <set>
#include <string>
#include <vector>

#include "reference/collision/collision_mistakes.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/deviating_pass.hpp"
#include "reference/collision/step_pass.hpp"
#include "reference/collision/step_trace.hpp"
#include "tests/collision/collision_scenes.hpp"
#include "tests/collision/deviating_step.hpp"

namespace lockstep::test::deviating_pass_test {

namespace {

bool same(glm::vec3 a, glm::vec3 b) {
    const auto equal = [](float x, float y) {
        return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y) || (x != x && y != y);
    };
    return equal(a.x, b.x) && equal(a.y, b.y) && equal(a.z, b.z);
}

FrameInputs inputs_of(const RandomScene& scene) {
    return {.before = &scene.particles, .cdt = &scene.cdt, .params = &scene.params};
}

} // namespace

TEST_CASE("deviating pass: without a deviation it has the collision pass's bits, in every profile and preset") {
    for (const char* profile_name : {"strict", "llvmpipe", "nvidia"}) {
        for (const char* preset_name : {"paper", "corrected", "exact"}) {
            RandomScene scene = random_scene(7, 2000, 41, 33);
            scene.params.switches = preset(preset_name);
            const Profile profile = named_profile(profile_name);
            Particles after;
            update_particles(scene.particles, scene.cdt, scene.params, profile, after);
            Particles stepped;
            stepped.resize(after.size());
            for (std::size_t i = 0; i < after.size(); ++i)
                stepped.set(i, deviating_step(inputs_of(scene), i, profile, {}));
            CHECK(same_bits(after, stepped));

            CollisionImage expected = empty_cdt(scene.params);
            DepthImage depth(scene.params.width, scene.params.height, 1.0F);
            const CollisionImage no_obstacles = expected;
            const DepthImage far = depth;
            rasterise_particles(scene.particles, after, scene.params, profile, expected, depth);
            CollisionImage drawn;
            deviating_draw(inputs_of(scene), after, profile, {}, no_obstacles, far, drawn);
            CHECK(same_bits(expected, drawn));
        }
    }
}

TEST_CASE("step trace: ends where the pass ends, and its parts fit together") {
    const RandomScene scene = random_scene(11, 2000, 41, 33);
    const Profile profile = named_profile("llvmpipe");
    Particles after;
    update_particles(scene.particles, scene.cdt, scene.params, profile, after);
    int hits = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        const StepTrace trace = trace_step(scene.particles[i], scene.cdt, scene.params, profile);
        CHECK(same(trace.after.position, after.position[i]));
        const BaseTexelIndex base = base_texel(scene.particles.position[i], scene.params, profile);
        CHECK(trace.base.x == base.x);
        CHECK(trace.base.y == base.y);
        const PointFragment point = point_fragment(after.position[i], scene.params, profile);
        CHECK(trace.fragment.x == point.x);
        CHECK(trace.fragment.depth == point.depth);
        CHECK(trace.searches == (base.x >= 0 && scene.particles.collide_time[i] < 0.0F));
        CHECK(trace.neighbours.size() == (trace.searches ? 8 : 0));
        if (!trace.nearest)
            continue;
        ++hits;
        const NeighbourTrace& nearest = trace.neighbours[*trace.nearest];
        CHECK(nearest.became_nearest);
        CHECK(nearest.distance < scene.params.constants.collision_range);
        for (const NeighbourTrace& other : trace.neighbours)
            CHECK_FALSE((other.compared && other.distance < nearest.distance));
        CHECK(same(nearest.apart, *trace.own_position - nearest.position));
    }
    CHECK(hits > 100);
}

TEST_CASE("deviations: names are unique and plain, each has a meaning") {
    std::set<std::string> names;
    for (const DeviationInfo& info : deviation_table()) {
        CHECK(names.emplace(info.name).second);
        CHECK(info.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz8_") == std::string_view::npos);
        CHECK_FALSE(info.meaning.empty());
    }
    CHECK(names.size() >= 30);
}

TEST_CASE("mistakes: every named one comes by itself from the sites of the step, and changes it alone") {
    RandomScene scene = random_scene(7, 1500, 41, 33);
    scene.params.switches.cdt_format = CdtFormat::rgba16f;
    const Profile profile = named_profile("strict");
    const Mesh no_obstacles;
    const StepInputs inputs{scene.particles, scene.cdt, no_obstacles, scene.params};
    const SystemView before = step_state(inputs);
    const auto pass = step_pass(inputs);
    std::vector<SeenSite> sites;
    for (std::size_t i = 0; i < scene.particles.size(); ++i)
        for (const SeenSite& site : pass->sites({before, 0}, i, profile))
            if (std::find(sites.begin(), sites.end(), site) == sites.end())
                sites.push_back(site);
    const std::vector<Mistake> mistakes = mistakes_at(sites);
    int named = 0;
    for (const DeviationInfo& info : deviation_table()) {
        const auto mistake = step_mistake(info.deviation, scene.params.switches);
        if (!mistake || mistake->site == 0 || mistake->change == Change::spoiled)
            continue; // the host's, or the arithmetic's
        ++named;
        INFO(info.name << ", " << mistake_text(*mistake, sites));
        CHECK(std::any_of(mistakes.begin(), mistakes.end(), [&](const Mistake& m) {
            Mistake same = m;
            if (m.change == Change::inverted) // of a setting, to the value it does not have
                same.change = mistake->change;
            return same == *mistake;
        }));
        const Mistake one[] = {*mistake};
        for (std::size_t i = 0; i < 50; ++i)
            CHECK(same(mistaken_step(inputs_of(scene), i, profile, one).position,
                       deviating_step(inputs_of(scene), i, profile, info.deviation).position));
    }
    CHECK(named == 78);
    CHECK(mistakes.size() > 2000);

    Particles after;
    update_particles(scene.particles, scene.cdt, scene.params, profile, after);
    std::size_t show = 0;
    for (const Mistake& mistake : mistakes) {
        const Mistake one[] = {mistake};
        bool shows = false;
        for (std::size_t i = 0; i < 40 && !shows; ++i)
            shows = !same(mistaken_step(inputs_of(scene), i, profile, one).position, after.position[i]);
        show += shows;
    }
    CHECK(show > mistakes.size() / 3);
}

} // namespace lockstep::test::deviating_pass_test
