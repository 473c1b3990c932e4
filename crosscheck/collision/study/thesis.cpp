#include "crosscheck/collision/study/thesis.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "crosscheck/collision/study/answers_at_obstacles.hpp"
#include "crosscheck/collision/study/study.hpp"
#include "crosscheck/judge/stopwatch.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "gpu/collision/simulation.hpp"
#include "reference/collision/octree_pass.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr float full_count = 200'000.0F;
constexpr int thesis_octree_size = 50; // world units; `set` may say otherwise

/// Leaves the particles after the last frame in `last`.
SystemTimes time_system(const Scene& scene, const ThesisOptions& options, Particles& last) {
    GpuSimulation gpu(scene, options.shaders);
    gpu.step(frame_params(scene, 0));
    SystemTimes sum;
    const double first = now();
    while (sum.frames < options.frames && now() - first < options.seconds) {
        const FrameParams params = frame_params(scene, ++sum.frames);
        const double start = now();
        gpu.step(params);
        sum.wall += now() - start;
        sum.gpu += gpu.frame_seconds();
    }
    gpu.read(last);
    SystemTimes mean;
    mean.frames = sum.frames;
    mean.wall = sum.wall / sum.frames;
    mean.gpu = sum.gpu / sum.frames;
    return mean;
}

/// Of a frame with the first particle alone.
double fixed_time(Scene scene, const ThesisOptions& options) {
    scene.start.resize(1);
    Particles ignored;
    return time_system(scene, options, ignored).wall;
}

/// What shares a leaf is seen.
double octree_recall(const std::vector<glm::vec3>& positions, const TrueNeighbours& truth, float size) {
    std::vector<std::int32_t> leaf(positions.size());
    std::transform(positions.begin(), positions.end(), leaf.begin(),
                   [&](glm::vec3 position) { return octree_leaf(position, size); });
    std::size_t with_neighbour = 0, recalled = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const auto neighbours = truth.lists.of(i);
        with_neighbour += neighbours.empty() ? 0U : 1U;
        recalled += leaf[i] != no_leaf &&
                            std::any_of(neighbours.begin(), neighbours.end(),
                                        [&](std::int32_t j) { return leaf[static_cast<std::size_t>(j)] == leaf[i]; })
                        ? 1U
                        : 0U;
    }
    return with_neighbour == 0 ? std::numeric_limits<double>::quiet_NaN()
                               : static_cast<double>(recalled) / static_cast<double>(with_neighbour);
}

Scene load(std::string_view name, std::size_t count, const ThesisOptions& options, std::string_view search = "cdt") {
    SceneOptions scene_options;
    scene_options.particles = count;
    scene_options.emitter_length = static_cast<float>(count) / full_count;
    scene_options.preset = options.preset;
    scene_options.set = options.set;
    scene_options.set.insert(scene_options.set.begin(), fmt::format("octree_size={}", thesis_octree_size));
    scene_options.set.push_back(fmt::format("search={}", search));
    return load_scene(options.scenes / fmt::format("{}.json", name), scene_options);
}

/// Whether the depth goes with the switches.
bool takes_depth(const ThesisOptions& options) {
    if (!options.compute)
        return false;
    try {
        static_cast<void>(load(thesis_scenes.back(), 1, options, "depth"));
        return true;
    } catch (const Error& error) {
        if (options.on_left_out)
            options.on_left_out("the scene's depth", error.what());
        return false;
    }
}

/// The scenes that can be measured. The last one needs no mesh: what keeps it from loading keeps all.
std::vector<std::string_view> loadable(const ThesisOptions& options) {
    std::vector<std::string_view> scenes;
    for (const std::string_view scene : thesis_scenes)
        try {
            static_cast<void>(load(scene, 1, options));
            scenes.push_back(scene);
        } catch (const Error& error) {
            if (scene == thesis_scenes.back())
                throw;
            if (options.on_left_out)
                options.on_left_out(scene, error.what());
        }
    return scenes;
}

/// Leaves the particles after the last frame in `last`.
SystemTimes time_both(const Scene& scene, const ThesisOptions& options, Particles& last) {
    SystemTimes times = time_system(scene, options, last);
    times.fixed = fixed_time(scene, options);
    return times;
}

ThesisCell measure(std::string_view name, std::size_t count, const ThesisOptions& options, bool with_depth) {
    Scene scene = load(name, count, options);
    ThesisCell cell;
    cell.scene = name;
    cell.particles = count;
    Particles last, ignored;
    cell.cdt = time_both(scene, options, last);
    if (options.compute) {
        scene.switches.search = Search::octree;
        cell.octree = time_both(scene, options, ignored);
    }
    if (with_depth) {
        scene.switches.search = Search::depth;
        cell.depth = time_both(scene, options, ignored);
    }
    scene.switches.search = Search::cdt;
    scene.start = last;
    const TrueNeighbours truth = find_truth(last.position, scene.constants.collision_range);
    const std::vector<std::size_t> at = touching(last.position, scene.obstacles, scene.constants.collision_range);
    const SearchStudy study = study_start(scene, truth, Profile{});
    cell.cdt.recall = study.counts.recall();
    cell.cdt.answers = share_of_hits(hits_of_cdt(study), at);
    if (cell.octree) {
        cell.octree->recall = octree_recall(last.position, truth, scene.constants.octree_size);
        cell.octree->answers = share_of_hits(hits_of_octree(scene), at);
    }
    if (cell.depth)
        cell.depth->answers = share_of_hits(hits_of_depth(scene, Profile{}), at);
    return cell;
}

} // namespace

std::optional<double> ThesisCell::octree_ratio() const {
    return octree ? std::optional(octree->wall / cdt.wall) : std::nullopt;
}

std::optional<double> ThesisCell::depth_ratio() const {
    return depth ? std::optional(depth->wall / cdt.wall) : std::nullopt;
}

std::vector<ThesisCell> thesis_study(const ThesisOptions& options) {
    std::vector<ThesisCell> cells;
    const std::vector<std::string_view> scenes = loadable(options);
    const bool with_depth = takes_depth(options);
    for (const std::string_view scene : scenes)
        for (const std::size_t count : options.counts) {
            cells.push_back(measure(scene, count, options, with_depth));
            if (options.on_cell)
                options.on_cell(cells.back());
        }
    return cells;
}

} // namespace lockstep
