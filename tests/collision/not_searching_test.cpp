#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "crosscheck/scene/scene_file.hpp"
#include "reference/collision/collision_pass_fast.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"
#include "tests/collision/collision_scenes.hpp"

namespace lockstep::test::not_searching_test {

namespace {

Particles step(const RandomScene& scene) {
    Particles after;
    update_particles_fast(scene.particles, scene.cdt, scene.params, {}, after);
    return after;
}

/// 500 particles of the stream that falls on the plane, none of which has hit yet.
Scene stream(NotSearching not_searching, float collide_time) {
    SceneOptions options;
    options.particles = 500;
    Scene scene = load_scene("data/scenes/thesis/plane_pile.json", options);
    scene.switches.not_searching = not_searching;
    std::fill(scene.start.collide_time.begin(), scene.start.collide_time.end(), collide_time);
    return scene;
}

/// How many move in a frame, frame by frame.
std::vector<std::size_t> moving(const Scene& scene, int frames) {
    ReferenceSimulation simulation(scene, {});
    std::vector<std::size_t> counts;
    for (int frame = 0; frame < frames; ++frame) {
        const std::vector<glm::vec3> before = simulation.particles().position;
        simulation.step(frame_params(scene, frame));
        const std::vector<glm::vec3>& after = simulation.particles().position;
        std::size_t count = 0;
        for (std::size_t i = 0; i < after.size(); ++i)
            count += before[i] != after[i] ? 1U : 0U;
        counts.push_back(count);
    }
    return counts;
}

} // namespace

TEST_CASE("not searching: who waits keeps every bit where it stands, and who searches knows nothing of it") {
    RandomScene scene = random_scene(11, 600, 40, 30);
    const Particles moved = step(scene);
    scene.params.switches.not_searching = NotSearching::stands;
    const Particles stood = step(scene);
    std::size_t waiting = 0, hits = 0;
    for (std::size_t i = 0; i < stood.size(); ++i) {
        const ParticleState before = scene.particles[i], after = stood[i], other = moved[i];
        const bool waits = !(before.collide_time < 0.0F);
        const ParticleState& expected = waits ? before : other;
        CHECK(after.position == expected.position);
        CHECK(after.direction == expected.direction);
        CHECK(after.speed == expected.speed);
        CHECK(after.collide_time == expected.collide_time);
        if (waits)
            CHECK(other.position != before.position);
        waiting += waits ? 1U : 0U;
        hits += !waits && after.collide_time == scene.params.constants.collision_time ? 1U : 0U;
    }
    CHECK(waiting > 20);
    CHECK(hits > 20);
}

TEST_CASE("not searching: as the listing is printed, nobody moves whose collide time begins at 0") {
    for (const std::size_t count : moving(stream(NotSearching::stands, 0.0F), 60))
        CHECK(count == 0);
    for (const std::size_t count : moving(stream(NotSearching::moves, 0.0F), 60))
        CHECK(count == 500);
}

TEST_CASE("not searching: as the listing is printed, who has hit once never moves again") {
    const std::vector<std::size_t> stands = moving(stream(NotSearching::stands, -0.01F), 900);
    CHECK(std::is_sorted(stands.rbegin(), stands.rend()));
    CHECK(stands.front() == 500);
    CHECK(stands[300] < 450);
    CHECK(stands[899] < 50);
    for (const std::size_t count : moving(stream(NotSearching::moves, -0.01F), 900))
        CHECK(count > 450);
}

TEST_CASE("not searching: it is the listing's own, and what does not know it says so") {
    for (const auto& [name, value] : std::vector<std::pair<const char*, const char*>>{{"search", "octree"},
                                                                                      {"cdt_layers", "2"},
                                                                                      {"cdt_cameras", "2"},
                                                                                      {"search_window", "projected"},
                                                                                      {"response", "mutual"}}) {
        INFO(name);
        Switches switches;
        set_switch(switches, name, value);
        check_switches(switches);
        switches.not_searching = NotSearching::stands;
        CHECK_THROWS_WITH(check_switches(switches),
                          Catch::StartsWith("switch not_searching: ") && Catch::EndsWith("need moves, not stands"));
    }
    for (const auto& [name, value] :
         std::vector<std::pair<const char*, const char*>>{{"step", "compute"}, {"velocity", "vector"}}) {
        Switches switches;
        switches.not_searching = NotSearching::stands;
        set_switch(switches, name, value);
        CHECK_NOTHROW(check_switches(switches));
    }
}

TEST_CASE("presets: the listing's is the listing, line by line; paper's has the text's divide and drawn position") {
    const Switches listing = preset("listing");
    CHECK(listing.raster_position == RasterPosition::before_step);   // line 2: gl_Position is a_Position's
    CHECK(listing.perspective_divide == PerspectiveDivide::off);     // line 3: clip xy, and no w
    CHECK(listing.texcoord == TexCoord::times_half);                 // line 3
    CHECK(listing.base_texel == BaseTexel::truncate);                // line 4: ivec2()
    CHECK(listing.self_position == SelfPosition::texel);             // line 5: curr_pos is fetched
    CHECK(listing.search_when == SearchWhen::collide_time_negative); // line 8
    CHECK(listing.not_searching == NotSearching::stands);            // lines 8, 20 and 25: one inside the other
    CHECK(listing.empty_texel == EmptyTexel::phantom);               // line 14: whatever is stored
    CHECK(listing.zero_distance == ZeroDistance::hit);               // line 16: no lower bound
    CHECK(listing.speed_factor == 0.2F);                             // line 21
    CHECK(listing.collision_step == CollisionStep::full);            // line 24: no g_tick
    CHECK(listing.velocity == Velocity::direction_and_speed);        // lines 26 to 28
    Switches paper = preset("paper");
    CHECK(paper != listing);
    paper.perspective_divide = PerspectiveDivide::off;
    paper.raster_position = RasterPosition::before_step;
    paper.not_searching = NotSearching::stands;
    CHECK(paper == listing);
    for (const std::string_view name : preset_names())
        CHECK_NOTHROW(preset(name));
    CHECK_THROWS_WITH(preset("lists"), "unknown preset 'lists'; the presets are listing, paper, corrected, exact");
}

} // namespace lockstep::test::not_searching_test
