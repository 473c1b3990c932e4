#include <catch2/catch.hpp>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "crosscheck/scene/profiles.hpp"
#include "gpu/collision/simulation.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/random.hpp"
#include "tests/gpu/any_context.hpp"
#include "tests/text/dispatch_watch.hpp"

namespace lockstep::test::collision_stages_test {

namespace {

/// Particles that meet, over a triangle.
Scene crowd() {
    Scene scene;
    scene.name = "crowd";
    scene.width = 64;
    scene.height = 48;
    scene.constants.collision_range = 0.1F;
    for (std::size_t i = 0; i < 500; ++i) {
        Random random(7, i);
        const auto vector = [&](float size) {
            return size * glm::vec3(static_cast<float>(random.symmetric()), static_cast<float>(random.symmetric()),
                                    static_cast<float>(random.symmetric()));
        };
        scene.start.position.push_back(vector(0.45F));
        scene.start.direction.push_back(vector(1.0F));
        scene.start.speed.push_back(0.5F);
        scene.start.collide_time.push_back(0.0F);
    }
    scene.obstacles.positions = {{-1.0F, -0.3F, -1.0F}, {1.0F, -0.3F, -1.0F}, {0.0F, -0.3F, 1.0F}};
    scene.obstacles.indices = {0, 1, 2};
    scene.switches = preset("corrected");
    return scene;
}

} // namespace

TEST_CASE("text: each compute stage of collision makes its twin's bits, and the GPU's") {
    const auto context = open_context(software_gl());
    if (!context || !context->describe().compute)
        return;
    const Profile profile = measured_profile(*context);
    const std::vector<std::pair<std::string, std::function<void(Switches&)>>> variants{
        {"step=compute", [](Switches& s) { s.step = Step::compute; }},
        {"step=compute arithmetic=exact",
         [](Switches& s) { s.step = Step::compute, s.arithmetic = ArithmeticSwitch::exact; }},
        {"search=octree", [](Switches& s) { s.search = Search::octree; }},
        {"search=depth", [](Switches& s) { s.search = Search::depth; }}};
    for (const auto& [name, change] : variants) {
        Scene scene = crowd();
        change(scene.switches);
        INFO(name);
        const DispatchWatch watch(profile);
        GpuSimulation gpu(scene, {});
        ReferenceSimulation reference(scene, profile);
        Particles particles;
        for (int frame = 0; frame < 4; ++frame) {
            gpu.step(frame_params(scene, frame));
            reference.step(frame_params(scene, frame));
            gpu.read(particles);
            CHECK(particles.position == reference.particles().position);
            CHECK(particles.direction == reference.particles().direction);
        }
        CHECK(!watch.rows().empty());
        for (const auto& [stage, row] : watch.rows()) {
            INFO(stage);
            CHECK(row.changed > 0);
            CHECK(row.differing == 0);
            CHECK(row.findings == 0);
            CHECK(row.refused == "");
        }
    }
}

} // namespace lockstep::test::collision_stages_test
