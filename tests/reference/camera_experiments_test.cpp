#include <catch2/catch.hpp>

#include "crosscheck/collision/study/camera_experiments.hpp"
#include "crosscheck/scene/scene_file.hpp"

namespace lockstep::test::camera_experiments_test {

namespace {

double holes(const CameraRow& row) { return static_cast<double>(row.seen_missed) / static_cast<double>(row.seen); }

const CameraRow& find(const std::vector<CameraRow>& rows, std::string_view camera, std::string_view viewer = "stands") {
    for (const CameraRow& row : rows)
        if (row.camera == camera && row.viewer == viewer)
            return row;
    FAIL("no row " << camera << ", " << viewer);
    return rows.front();
}

} // namespace

TEST_CASE("camera experiments: the viewer sees more holes when the collision camera is at the side or behind") {
    SceneOptions options;
    options.particles = 20'000;
    options.set = {"collision_range=0.03", "texel_collide_range=3"};
    Scene scene = load_scene("data/scenes/cloud_cube.json", options);
    scene.width = scene.height = 200;
    CameraOptions camera_options;
    camera_options.frames = 2; // before the first hits cool down
    camera_options.every = 1;
    std::size_t told = 0;
    camera_options.on_row = [&](const CameraRow&) { ++told; };
    const std::vector<CameraRow> rows = camera_experiments(scene, {}, camera_options);
    CHECK(rows.size() == 8);
    CHECK(told == 8);

    const CameraRow& moving = find(rows, "moving");
    CHECK(moving.offset == 0.0F);
    CHECK(moving.seen > 1000);
    CHECK(moving.hits > 100);
    CHECK(holes(find(rows, "fixed at the side")) > 1.1 * holes(moving));
    CHECK(holes(find(rows, "fixed behind")) > 1.2 * holes(moving));

    const CameraRow& fixed = find(rows, "fixed in front", "walks to the side");
    CHECK(fixed.counts.pairs == moving.counts.pairs); // who looks on changes nothing
    CHECK(fixed.counts.found_pairs == moving.counts.found_pairs);
    CHECK(fixed.seen != moving.seen);
    CHECK(find(rows, "moving", "walks to the side").counts.found_pairs != moving.counts.found_pairs);
    for (std::size_t i = 1; i < 4; ++i) {
        CHECK(rows[i].offset > rows[i - 1].offset);
        CHECK(rows[i].counts.owners < rows[i - 1].counts.owners); // farther away, fewer texels
    }
}

TEST_CASE("camera experiments: a line a camera, and dashes for what is not there") {
    CameraRow row;
    row.camera = "moving";
    row.viewer = "stands";
    row.offset = 0.5F;
    CHECK(camera_text(row) == "| moving | 0.50 | stands | 0 | - | - | - |\n");
    row.counts.with_neighbour = 10;
    row.counts.with_neighbour_inside = 9;
    row.counts.recalled = 4;
    row.seen = 4;
    row.seen_missed = 1;
    row.hits = 3.4;
    CHECK(camera_text(row) == "| moving | 0.50 | stands | 3 | 40.0 | 10.0 | 25.0 |\n");
}

} // namespace lockstep::test::camera_experiments_test
