#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "crosscheck/collision/study/rest.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/error.hpp"

namespace lockstep::test::rest_test {

namespace {

Scene load(const char* name, std::vector<std::string> set) {
    SceneOptions options;
    options.set = std::move(set);
    return load_scene(std::string("data/scenes/thesis/") + name + ".json", options);
}

std::vector<RestFrame> rows(const char* name, int frames, int every, std::vector<std::string> set = {}) {
    return rest_run(load(name, std::move(set)), {}, {frames, every, nullptr});
}

/// Who lies on the upper half of the sphere, and how far along it half of them have come since they touched it.
struct Slide {
    double on = 0.0;
    float middle = 0.0F;
};

constexpr float sphere_radius = 0.3F;

std::optional<float> angle_on_sphere(glm::vec3 position, float range) {
    const float distance = glm::length(position);
    if (position.y <= 0.0F || distance < sphere_radius - range || distance > sphere_radius + 3.0F * range)
        return {};
    return std::acos(std::min(1.0F, position.y / distance));
}

std::vector<Slide> slides(int frames, int every, std::vector<std::string> set = {}) {
    const Scene scene = load("slide", std::move(set));
    ReferenceSimulation simulation(scene, {});
    std::vector<std::optional<float>> touched(scene.start.size());
    std::vector<Slide> slides;
    for (int frame = 0; frame < frames; ++frame) {
        simulation.step(frame_params(scene, frame));
        std::vector<float> lengths;
        for (std::size_t i = 0; i < touched.size(); ++i)
            if (const auto angle =
                    angle_on_sphere(simulation.particles().position[i], scene.constants.collision_range)) {
                touched[i] = touched[i].value_or(*angle);
                lengths.push_back(sphere_radius * (*angle - *touched[i]));
            }
        if ((frame + 1) % every != 0 || lengths.empty())
            continue;
        const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
        std::nth_element(lengths.begin(), middle, lengths.end());
        slides.push_back({static_cast<double>(lengths.size()) / static_cast<double>(touched.size()), *middle});
    }
    return slides;
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
    for (const RestFrame& row : rows("plane_pile", 900, 300, {"speed_factor=0.8"}))
        CHECK(row.at_rest < 0.2);
    const std::vector<RestFrame> nobody_hits = rows("plane_pile", 600, 300, {"texel_collide_range=0"});
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
    for (const RestFrame& row : seldom)
        CHECK(row.at_rest < 0.6);
    for (const RestFrame& row : rows("horn", 400, 200, {"collision_time=0.5"}))
        CHECK(row.at_rest < 0.25);
    CHECK(seldom[1].middle < horn[3].middle - 0.05);
}

TEST_CASE("rest: slow particles slide along a sphere with the listing's step, and stick to it with a tick's") {
    const std::vector<Slide> listing = slides(600, 300);
    REQUIRE(listing.size() == 2);
    CHECK(listing[1].on > 0.9);
    CHECK(listing[0].middle > 0.015F);
    CHECK(listing[1].middle > 1.4F * listing[0].middle);

    const std::vector<Slide> tick = slides(600, 300, {"collision_step=tick"});
    CHECK(tick[1].on > 0.9);
    CHECK(tick[1].middle < 0.5F * listing[1].middle);

    CHECK(slides(300, 300, {"texel_collide_range=0"}).empty());
}

TEST_CASE("rest: a scene without obstacles has nothing to lie on") {
    Scene scene = load_scene("data/scenes/thesis/plane_pile.json");
    scene.obstacles = {};
    CHECK_THROWS_WITH(rest_run(scene, {}, {}), Catch::Contains("this scene has none"));
}

} // namespace lockstep::test::rest_test
