#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "crosscheck/collision/study/rest.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "reference/model/error.hpp"

using namespace lockstep;

namespace {

std::vector<RestFrame> rows(const char* name, int frames, int every, std::vector<std::string> set = {}) {
    SceneOptions options;
    options.set = std::move(set);
    return rest_run(load_scene(std::string("data/scenes/thesis/") + name + ".json", options), {},
                    {frames, every, nullptr});
}

} // namespace

TEST_CASE("rest: a heap grows on the plane and stays") {
    const std::vector<RestFrame> heap = rows("plane_pile", 1200, 300);
    REQUIRE(heap.size() == 4);
    CHECK(heap[0].at_rest < heap[1].at_rest);
    CHECK(heap[1].at_rest < heap[2].at_rest);
    for (const std::size_t i : {2U, 3U}) {
        CHECK(heap[i].at_rest > 0.8);
        CHECK(heap[i].top > 0.2); // twenty times the collision range
    }
    for (const RestFrame& row : rows("plane_pile", 1200, 300, {"speed_factor=0.8"}))
        CHECK(row.at_rest < 0.2);
    const std::vector<RestFrame> nobody_hits = rows("plane_pile", 1200, 300, {"texel_collide_range=0"});
    for (const RestFrame& row : nobody_hits)
        CHECK(row.hits + row.at_rest == 0.0);
    CHECK(nobody_hits.back().above == 0.0);
}

TEST_CASE("rest: a horn grows where particles collide ten times as often, and falls when the camera looks away") {
    constexpr double top_of_sphere = 0.3;
    const std::vector<RestFrame> horn = rows("horn", 1000, 200);
    CHECK(horn[0].at_rest < 0.5);
    CHECK(horn[1].middle > horn[0].middle + 0.05);
    for (const std::size_t i : {1U, 2U, 3U}) {
        CHECK(horn[i].at_rest > 0.7);
        CHECK(horn[i].middle > top_of_sphere + 0.1); // ten times the collision range
    }
    CHECK(horn[4].at_rest < 0.01); // the camera looks away from frame 800 on

    const std::vector<RestFrame> seldom = rows("horn", 800, 400, {"collision_time=0.1"});
    const std::vector<RestFrame> hardly = rows("horn", 800, 400, {"collision_time=0.5"});
    for (const std::size_t i : {0U, 1U}) {
        CHECK(seldom[i].at_rest < 0.6);
        CHECK(hardly[i].at_rest < 0.25);
    }
    CHECK(seldom[1].middle < horn[3].middle - 0.05);
}

TEST_CASE("rest: a scene without obstacles has nothing to lie on") {
    Scene scene = load_scene("data/scenes/thesis/plane_pile.json");
    scene.obstacles = {};
    CHECK_THROWS_WITH(rest_run(scene, {}, {}), Catch::Contains("this scene has none"));
}
