#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <glm/matrix.hpp>

#include "reference/collision/collision_pass.hpp"
#include "reference/collision/depth_pass.hpp"
#include "reference/collision/layered_collision_pass.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "reference/collision/octree_pass.hpp"
#include "reference/collision/step_pass.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/collision/switches.hpp"
#include "reference/model/profile.hpp"
#include "tests/collision/collision_scenes.hpp"

namespace lockstep::test::step_pass_test {

namespace {

/// A random scene whose particles search by `switches`, with a CDT that holds them.
struct Stepped {
    RandomScene scene;
    Mesh wall{{{-1.0F, -1.0F, 0.1F}, {1.0F, -1.0F, 0.1F}, {0.0F, 1.0F, 0.1F}}, {0, 1, 2}};

    Stepped(std::uint32_t seed, const std::function<void(Switches&)>& change) : scene(random_scene(seed, 300, 48, 36)) {
        Switches& switches = scene.params.switches;
        switches = preset("corrected");
        change(switches);
        scene.params.constants.texel_collide_range = 4;
        scene.params.second_proj_view = scene.params.collision_proj_view;
        if (switches.search == Search::depth) {
            scene.params.earlier_proj_view = scene.params.collision_proj_view;
            scene.params.earlier_inverse = glm::mat4(glm::inverse(glm::dmat4(scene.params.collision_proj_view)));
            scene.params.constants.surface_thickness = 0.5F;
            scene.cdt = {scene.params.width, scene.params.height};
            DepthImage nearest(scene.params.width, scene.params.height, 1.0F);
            obstacle_pass(wall, scene.params, {}, scene.cdt, nearest);
        }
        if (has_remedies(switches)) {
            scene.cdt = {scene.params.width, scene.params.height * cdt_planes(switches).count()};
            draw_layered_cdt(scene.particles, wall, scene.params, {}, scene.cdt);
        }
    }
    [[nodiscard]] StepInputs inputs() const { return {scene.particles, scene.cdt, wall, scene.params}; }
    [[nodiscard]] Particles stepped(const Profile& profile) const {
        Particles after;
        if (scene.params.switches.search == Search::octree)
            octree_pass(scene.particles, wall, scene.params, profile, after);
        else if (scene.params.switches.search == Search::depth)
            depth_pass(scene.particles, scene.cdt, scene.params, profile, after);
        else if (has_remedies(scene.params.switches))
            update_particles_layered(scene.particles, scene.cdt, scene.params, profile, after);
        else
            update_particles(scene.particles, scene.cdt, scene.params, profile, after);
        return after;
    }
};

const std::vector<std::pair<std::string, std::function<void(Switches&)>>>& searches() {
    static const std::vector<std::pair<std::string, std::function<void(Switches&)>>> all{
        {"listing", [](Switches&) {}},
        {"octree", [](Switches& s) { s.search = Search::octree; }},
        {"depth", [](Switches& s) { s.search = Search::depth; }},
        {"two layers", [](Switches& s) { s.cdt_layers = 2; }},
        {"three layers, rgba16f", [](Switches& s) { s.cdt_layers = 3, s.cdt_format = CdtFormat::rgba16f; }},
        {"three layers, rgba8", [](Switches& s) { s.cdt_layers = 3, s.cdt_format = CdtFormat::rgba8; }},
        {"two cameras", [](Switches& s) { s.cdt_layers = 2, s.cdt_cameras = 2; }},
        {"projected window", [](Switches& s) { s.cdt_layers = 2, s.search_window = SearchWindow::projected; }},
        {"mutual", [](Switches& s) { s.cdt_layers = 3, s.response = Response::mutual; }},
        {"mutual, rgba16f",
         [](Switches& s) { s.cdt_layers = 3, s.response = Response::mutual, s.cdt_format = CdtFormat::rgba16f; }}};
    return all;
}

} // namespace

TEST_CASE("step pass: every search's twin has the bits of its pass, and its legal outcomes hold them") {
    for (const auto& [name, change] : searches())
        for (const char* profile_name : {"strict", "llvmpipe"})
            for (const ArithmeticSwitch arithmetic : {ArithmeticSwitch::plain, ArithmeticSwitch::exact}) {
                INFO(name << " " << profile_name << " " << static_cast<int>(arithmetic));
                const Stepped step(7, [&](Switches& s) {
                    change(s);
                    s.arithmetic = arithmetic;
                });
                const Profile profile = named_profile(profile_name);
                const Particles expected = step.stepped(profile);
                const auto pass = step_pass(step.inputs());
                const SystemView before = step_state(step.inputs());
                Particles after = expected;
                std::fill(after.speed.begin(), after.speed.end(), -1.0F);
                run_pass(*pass, {before, 0}, profile, view(after));
                CHECK(same_bits(after, expected));
                CHECK(std::count(expected.collide_time.begin(), expected.collide_time.end(),
                                 step.scene.params.constants.collision_time) > 10);
                const View observed = view(expected);
                std::size_t outside = 0;
                for (const KnownOperations& known : {KnownOperations{}, KnownOperations::all()})
                    for (std::size_t i = 0; i < 40; ++i) {
                        const auto outcomes = pass->outcomes({before, 0}, i, profile, known, nullptr);
                        outside += std::none_of(outcomes.begin(), outcomes.end(), [&](const ItemOutcome& outcome) {
                            return outcome.contains(observed, i);
                        });
                        if (known.divide && known.normalize)
                            CHECK(outcomes.size() == 1);
                    }
                CHECK(outside == 0);
            }
}

} // namespace lockstep::test::step_pass_test
