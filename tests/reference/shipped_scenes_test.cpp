#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "crosscheck/scene/scene_file.hpp"
#include "reference/model/error.hpp"
#include "tests/skip.hpp"

namespace lockstep::test::shipped_scenes_test {

namespace {

/// Nothing where the scene's mesh has not been fetched; then the message has to say how to.
std::optional<Scene> load_shipped(const std::filesystem::path& file, std::size_t particles) {
    SceneOptions options;
    options.particles = particles;
    try {
        return load_scene(file, options);
    } catch (const Error& error) {
        INFO(error.what());
        const std::string mesh = file.stem().string().substr(0, file.stem().string().find('_'));
        REQUIRE_FALSE(std::filesystem::exists("data/meshes/" + mesh + ".obj"));
        REQUIRE(std::string(error.what()) ==
                file.string() + ": /obstacles/0/file: data/meshes/" + mesh +
                    ".obj: no such mesh; scripts/fetch_meshes.sh fetches the bunny and the dragon");
        test::skip(error.what(), "LOCKSTEP_REQUIRE_MESHES");
        return std::nullopt;
    }
}

std::set<std::filesystem::path> shipped() {
    std::set<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator("data/scenes"))
        if (entry.path().extension() == ".json")
            files.insert(entry.path());
    return files;
}

} // namespace

TEST_CASE("shipped_scenes: the scenes of the brief are there") {
    for (const char* name : {"bunny_a", "bunny_b", "dragon_a", "dragon_b", "x_streams", "lattice"})
        CHECK(shipped().count(std::filesystem::path("data/scenes") / (std::string(name) + ".json")) == 1);
}

TEST_CASE("shipped_scenes: each is valid from 1 to 4,000,000 particles") {
    for (const auto& file : shipped())
        for (const std::size_t particles : {1U, 2U, 50'000U, 4'000'000U}) {
            INFO(file);
            if (const auto scene = load_shipped(file, particles))
                CHECK(scene->start.size() == particles);
        }
}

TEST_CASE("shipped_scenes: each fits its rgba8 box, and its obstacles lie beyond the near plane") {
    for (const auto& file : shipped()) {
        INFO(file);
        const auto scene = load_shipped(file, 1000);
        if (!scene)
            continue;
        const FrameParams params = frame_params(*scene, 0);
        for (const glm::vec3& p : scene->obstacles.positions)
            REQUIRE((params.collision_proj_view * glm::vec4(p, 1.0F)).w > scene->camera.near_plane);
        for (const glm::vec3& p : scene->start.position)
            for (int axis = 0; axis < 3; ++axis)
                REQUIRE((p[axis] >= scene->cdt_box.min[axis] && p[axis] <= scene->cdt_box.max[axis]));
    }
}

} // namespace lockstep::test::shipped_scenes_test
