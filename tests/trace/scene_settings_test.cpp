#include <catch2/catch.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include "crosscheck/scene/scene_file.hpp"
#include "crosscheck/scene/scene_frames.hpp"
#include "crosscheck/scene/scene_settings.hpp"
#include "tests/trace/small_trace.hpp"

namespace lockstep::test::scene_settings_test {

namespace {

Scene again(const Scene& scene) {
    const nlohmann::json document = parse_json(settings_json(scene).dump(), "scene");
    Scene back;
    read_settings(JsonValue(document, "scene"), {}, {}, back);
    return back;
}

bool same_matrices(const FrameParams& a, const FrameParams& b) {
    return a.collision_proj_view == b.collision_proj_view && a.second_proj_view == b.second_proj_view &&
           a.render_view == b.render_view && a.render_projection == b.render_projection;
}

} // namespace

TEST_CASE("scene settings: every shipped scene in every preset comes back as it was") {
    int scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator("data/scenes")) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() != ".json" || name.starts_with("bunny") || name.starts_with("dragon"))
            continue; // their meshes may not be there; they have no settings of their own
        for (const char* preset : {"listing", "paper", "corrected", "exact"}) {
            SceneOptions options;
            options.particles = 10;
            options.preset = preset;
            options.set = {"tick=0.0123456789", "gravity=0.1,-1e-7,3", "speed_factor=0.3", "cdt_format=rgba8"};
            const Scene scene = load_scene(entry.path(), options);
            const Scene back = again(scene);
            INFO(name << " " << preset);
            CHECK(back.switches == scene.switches);
            CHECK(settings_json(back) == settings_json(scene));
            CHECK(back.constants.tick == scene.constants.tick);
            CHECK(back.constants.gravity == scene.constants.gravity);
            CHECK(back.constants.octree_size == scene.constants.octree_size);
            CHECK(back.constants.surface_thickness == scene.constants.surface_thickness);
            CHECK(back.width == scene.width);
            CHECK(back.height == scene.height);
            CHECK(back.cdt_box.min == scene.cdt_box.min);
            CHECK(back.cdt_box.max == scene.cdt_box.max);
            for (const int frame : {0, 1, 59, 1000})
                CHECK(same_matrices(frame_params(back, frame), frame_params(scene, frame)));
        }
        ++scenes;
    }
    CHECK(scenes >= 5);
}

TEST_CASE("scene settings: all switches and constants are in them by name") {
    const nlohmann::json json = settings_json(test::small_scene());
    for (const SwitchInfo& info : switch_table())
        CHECK(json["switches"].contains(std::string(info.name)));
    CHECK(json["constants"].size() == 8);
    CHECK(json["constants"]["collision_range"] == 0.2F);
}

TEST_CASE("scene settings: an engine's clip space and frames come back as they were") {
    Scene scene = test::small_scene();
    CHECK_FALSE(settings_json(scene).contains("frames"));
    CHECK_FALSE(settings_json(scene).contains("clip_space"));
    scene.clip_space = {1.0F, {1.0F, 0.0F}};
    for (const int frame : {0, 3, 4}) {
        FrameSettings& settings = scene.frames.emplace_back();
        settings.frame = frame;
        settings.constants = scene.constants;
        settings.constants.tick = 0.1F / static_cast<float>(frame + 1);
        settings.speed_factor = 0.1F * static_cast<float>(frame);
        if (frame > 0)
            settings.proj_view = glm::mat4(1.0F / static_cast<float>(frame));
    }
    const Scene back = again(scene);
    CHECK(back.clip_space == scene.clip_space);
    CHECK(settings_json(back) == settings_json(scene));
    for (const int frame : {0, 1, 3, 4, 99}) {
        CHECK(same_matrices(frame_params(back, frame), frame_params(scene, frame)));
        CHECK(frame_params(back, frame).constants.tick == frame_params(scene, frame).constants.tick);
        CHECK(frame_params(back, frame).switches == frame_params(scene, frame).switches);
    }
}

TEST_CASE("scene settings: a capsule keeps those of its frame and of the one before") {
    const auto near = [](int frame) {
        std::vector<FrameSettings> all(3);
        all[0].frame = 2, all[1].frame = 5, all[2].frame = 6;
        std::vector<int> kept;
        for (const FrameSettings& settings : settings_near(all, frame))
            kept.push_back(settings.frame);
        return kept;
    };
    CHECK(near(0) == std::vector<int>{});
    CHECK(near(1) == std::vector<int>{});
    CHECK(near(2) == std::vector{2});
    CHECK(near(4) == std::vector{2});
    CHECK(near(5) == std::vector{2, 5});
    CHECK(near(6) == std::vector{5, 6});
    CHECK(near(7) == std::vector{6});
    CHECK(near(9) == std::vector{6});
}

} // namespace lockstep::test::scene_settings_test
