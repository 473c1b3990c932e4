#include <catch2/catch.hpp>

#include <filesystem>
#include <string>

#include "crosscheck/scene/scene_file.hpp"
#include "crosscheck/scene/scene_settings.hpp"
#include "tests/trace/small_trace.hpp"

using namespace lockstep;

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
        for (const char* preset : {"paper", "corrected", "exact"}) {
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
    CHECK(json["constants"].size() == 7);
    CHECK(json["constants"]["collision_range"] == 0.2F);
}
