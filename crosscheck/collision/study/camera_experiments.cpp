#include "crosscheck/collision/study/camera_experiments.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "crosscheck/collision/study/study.hpp"
#include "crosscheck/report/statistics.hpp"

namespace lockstep {
namespace {

/// The scene's camera turned round its target, about the y axis; angle in degrees.
Camera turned(const Camera& camera, double angle) {
    const double radians = angle * 3.14159265358979323846 / 180.0;
    const glm::dvec3 arm = glm::dvec3(camera.eye) - glm::dvec3(camera.target);
    const glm::dvec3 moved(arm.x * std::cos(radians) + arm.z * std::sin(radians), arm.y,
                           arm.z * std::cos(radians) - arm.x * std::sin(radians));
    Camera result = camera;
    result.eye = glm::vec3(glm::dvec3(camera.target) + moved);
    return result;
}

/// The viewer walks a quarter round the target while the scene runs.
void walk(Scene& scene, int frames) {
    constexpr int steps = 9;
    for (int step = 0; step <= steps; ++step) {
        const Camera there = turned(scene.camera, 90.0 * step / steps);
        scene.camera_path.push_back({step * std::max(frames, steps) / steps, there.eye, there.target});
    }
}

void fix(Scene& scene, double angle) {
    scene.switches.cdt_camera = CdtCamera::fixed;
    scene.collision_camera = turned(scene.camera, angle);
}

struct Experiment {
    std::string_view camera, viewer;
    double offset; ///< of the distance between camera and target
    void (*arrange)(Scene&, int frames);
};

constexpr std::array experiments{
    Experiment{"moving", "stands", 0.0, [](Scene&, int) {}},
    Experiment{"moving", "stands", 0.25, [](Scene&, int) {}},
    Experiment{"moving", "stands", 0.5, [](Scene&, int) {}},
    Experiment{"moving", "stands", 1.0, [](Scene&, int) {}},
    Experiment{"moving", "walks to the side", 0.0, walk},
    Experiment{"fixed in front", "walks to the side", 0.0,
               [](Scene& scene, int frames) {
                   fix(scene, 0.0);
                   walk(scene, frames);
               }},
    Experiment{"fixed at the side", "stands", 0.0, [](Scene& scene, int) { fix(scene, 90.0); }},
    Experiment{"fixed behind", "stands", 0.0, [](Scene& scene, int) { fix(scene, 180.0); }},
};

/// Adds the particles in contact that the viewer of `state` sees.
void count_seen(const Scene& scene, const StudiedState& state, const Profile& profile, CameraRow& row) {
    Scene seen_by_viewer = scene;
    seen_by_viewer.switches.cdt_camera = CdtCamera::moving;
    seen_by_viewer.switches.cdt_camera_offset = 0.0F;
    const FrameParams params = frame_params(seen_by_viewer, state.frame);
    const Owners owners = draw_owners(state.particles, state.particles, scene.obstacles, params, profile);
    for (const std::int32_t owner : owners.owner.texels) {
        if (owner < 0)
            continue;
        const Finding& finding = state.findings[static_cast<std::size_t>(owner)];
        row.seen += finding.kind != Finding::Kind::alone ? 1U : 0U;
        row.seen_missed += finding.kind == Finding::Kind::missed ? 1U : 0U;
    }
}

CameraRow run(const Experiment& experiment, Scene scene, const Profile& profile, const CameraOptions& options) {
    CameraRow row;
    row.camera = experiment.camera;
    row.viewer = experiment.viewer;
    row.offset = static_cast<float>(experiment.offset) * glm::distance(scene.camera.eye, scene.camera.target);
    scene.camera_path.clear();
    scene.switches.cdt_camera = CdtCamera::moving;
    scene.switches.cdt_camera_offset = row.offset;
    experiment.arrange(scene, options.frames);
    StudyOptions study;
    study.frames = options.frames;
    study.every = options.every;
    study.on_state = [&](const StudiedState& state) { count_seen(scene, state, profile, row); };
    const std::vector<StudyFrame> frames = study_run(scene, profile, study);
    for (const StudyFrame& frame : frames)
        row.counts += frame.counts;
    const std::size_t searched = row.counts.particles - row.counts.hits[static_cast<std::size_t>(Hit::none)];
    row.hits = static_cast<double>(searched) / static_cast<double>(frames.size());
    return row;
}

} // namespace

std::vector<CameraRow> camera_experiments(const Scene& scene, const Profile& profile, const CameraOptions& options) {
    std::vector<CameraRow> rows;
    for (const Experiment& experiment : experiments) {
        rows.push_back(run(experiment, scene, profile, options));
        if (options.on_row)
            options.on_row(rows.back());
    }
    return rows;
}

std::string camera_head() {
    return "| collision camera | z offset | viewer | hits a frame | recall % | outside the image % | holes seen % |\n"
           "|---|---:|---|---:|---:|---:|---:|\n";
}

std::string camera_text(const CameraRow& row) {
    const SearchCounts& n = row.counts;
    const double outside = 1.0 - static_cast<double>(n.with_neighbour_inside) / static_cast<double>(n.with_neighbour);
    const double holes = static_cast<double>(row.seen_missed) / static_cast<double>(row.seen);
    return fmt::format("| {} | {:.2f} | {} | {:.0f} | {} | {} | {} |\n", row.camera, row.offset, row.viewer, row.hits,
                       percent(n.recall()), percent(outside), percent(holes));
}

} // namespace lockstep
