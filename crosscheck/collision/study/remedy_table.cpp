#include "crosscheck/collision/study/remedy_table.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/collision/study/study.hpp"
#include "crosscheck/judge/stopwatch.hpp"
#include "crosscheck/report/statistics.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "gpu/collision/simulation.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/random.hpp"

namespace lockstep {
namespace {

using Setting = std::pair<std::string, std::string>;

const std::vector<std::vector<Setting>>& tried() {
    const Setting projected{"search_window", "projected"};
    const Setting mutual{"response", "mutual"};
    const Setting two_cameras{"cdt_cameras", "2"};
    const auto layers = [](int count) { return Setting{"cdt_layers", std::to_string(count)}; };
    static const std::vector<std::vector<Setting>> rows{
        {},
        {projected},
        {layers(2)},
        {layers(3)},
        {layers(4)},
        {two_cameras},
        {mutual},
        {layers(2), projected},
        {layers(3), projected},
        {layers(4), projected},
        {layers(6), projected},
        {layers(2), two_cameras, projected},
        {layers(3), projected, mutual},
        {layers(4), projected, mutual},
    };
    return rows;
}

Scene with(Scene scene, const std::vector<Setting>& settings) {
    for (const auto& [name, value] : settings)
        set_switch(scene.switches, name, value);
    check_switches(scene.switches);
    return scene;
}

/// A GL run that stands before a frame in which every particle searches.
class Frames {
  public:
    Frames(const Scene& scene, const std::filesystem::path& shaders) : gpu_(scene, shaders) {
        for (int frame = 0; frame < 2; ++frame)
            gpu_.step(frame_params(scene, frame));
        params_ = frame_params(scene, 1);
    }

    void time_one() {
        const double start = now();
        gpu_.repeat_step(params_);
        wall_.push_back(now() - start);
        timer_.push_back(gpu_.frame_seconds());
    }

    [[nodiscard]] double wall() const { return median(wall_); }
    [[nodiscard]] double timer() const { return median(timer_); }

  private:
    GpuSimulation gpu_;
    FrameParams params_;
    std::vector<double> wall_, timer_;
};

/// Row and single-layer frames in turn, so that a machine that slows down does so for both.
RemedyCost measure_cost(const Scene& scene, const Scene& single, const RemedyOptions& options) {
    RemedyCost cost;
    {
        Frames row(scene, options.shaders), first(single, options.shaders);
        for (int frame = 0; frame < options.frames; ++frame) {
            first.time_one();
            row.time_one();
        }
        cost = {row.wall(), row.timer(), first.wall(), false};
    }
    GpuSimulation gpu(scene, options.shaders);
    CheckOptions check_options;
    check_options.frames = 3;
    check_options.repeated_frames = 0;
    cost.agrees = check(scene, options.profile, gpu, check_options).verdict == Verdict::agree;
    return cost;
}

glm::dvec3 momentum(const Particles& p, std::size_t i) { return glm::dvec3(p.direction[i]) * double{p.speed[i]}; }

/// Two frames, in the second of which all search.
Particles two_frames(const Scene& scene, const RemedyOptions& options, Particles& before) {
    Particles after;
    if (options.gl) {
        GpuSimulation gpu(scene, options.shaders);
        gpu.step(frame_params(scene, 0));
        gpu.read(before);
        gpu.step(frame_params(scene, 1));
        gpu.read(after);
        return after;
    }
    ReferenceSimulation reference(scene, options.profile);
    reference.step(frame_params(scene, 0));
    before = reference.particles();
    reference.step(frame_params(scene, 1));
    return reference.particles();
}

PairMomentum measure_momentum(Scene scene, const RemedyOptions& options) {
    for (std::size_t i = 0; i < scene.start.size(); ++i) {
        Random random(2, i);
        const glm::dvec3 direction(random.symmetric(), random.symmetric(), random.symmetric());
        scene.start.direction[i] = glm::vec3(glm::normalize(direction));
        scene.start.speed[i] = 0.01F * (1.0F + static_cast<float>(random.unit()));
    }
    Particles before;
    const Particles after = two_frames(scene, options, before);
    const NeighbourLists lists = list_neighbours(before.position, scene.constants.collision_range);
    const auto answered = [&](std::size_t i) { return after.collide_time[i] == scene.constants.collision_time; };
    PairMomentum result;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (lists.of(i).size() != 1)
            continue;
        const auto j = static_cast<std::size_t>(lists.of(i).front());
        if (j < i || lists.of(j).size() != 1 || !answered(i) || !answered(j))
            continue;
        const glm::dvec3 change = momentum(after, i) + momentum(after, j) - momentum(before, i) - momentum(before, j);
        const double sum = glm::length(momentum(before, i)) + glm::length(momentum(before, j));
        ++result.pairs;
        result.worst = std::max(result.worst, glm::length(change) / sum);
    }
    return result;
}

} // namespace

std::string RemedyRow::name() const {
    std::string text;
    for (const auto& [name, value] : switches)
        text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, value);
    return text.empty() ? "the listing's pass" : text;
}

std::vector<RemedyRow> remedy_table(const RemedyOptions& options) {
    SceneOptions scene_options;
    scene_options.particles = options.particles;
    scene_options.set = {"texel_collide_range=4"};
    Scene single = load_scene(options.scenes / "cloud_cube.json", scene_options);
    std::fill(single.start.collide_time.begin(), single.start.collide_time.end(), -1.0F);
    const TrueNeighbours truth = find_truth(single.start.position, single.constants.collision_range);
    std::vector<RemedyRow> rows;
    for (const std::vector<Setting>& settings : tried()) {
        const Scene scene = with(single, settings);
        RemedyRow row{settings, study_start(scene, truth, options.profile).counts, {}, {}};
        if (options.gl)
            row.cost = measure_cost(scene, single, options);
        if (scene.switches.response == Response::mutual)
            row.momentum = measure_momentum(scene, options);
        rows.push_back(row);
        if (options.on_row)
            options.on_row(rows.back());
    }
    return rows;
}

std::string remedy_head() {
    return fmt::format("{:<52} {:>7} {:>8} {:>8} {:>9}  {:>9} {:>9} {:>9} {:>6}  {}\n", "remedies", "visible", "recall",
                       "nearest", "not", "GL frame", "GL timer", "of single", "bits", "momentum of a pair") +
           fmt::format("{:<52} {:>7} {:>8} {:>8} {:>9}  {:>9} {:>9} {:>9} {:>6}  {}\n", "", "%", "%", "found %",
                       "mutual %", "ms", "ms", "layer", "", "worst change, pairs");
}

std::string remedy_text(const RemedyRow& row) {
    const SearchCounts& n = row.counts;
    std::string text = fmt::format("{:<52} {:>7.1f} {:>8.1f} {:>8.1f} {:>9.1f}  ", row.name(),
                                   100.0 * static_cast<double>(n.owners) / static_cast<double>(n.particles),
                                   100.0 * n.recall(), 100.0 * n.true_nearest(), 100.0 * n.non_mutual_rate());
    if (row.cost)
        text += fmt::format("{:>9.3f} {:>9.3f} {:>8.2f}x {:>6}", row.cost->frame * 1e3, row.cost->timer * 1e3,
                            row.cost->times_single(), row.cost->agrees ? "AGREE" : "DIFFER");
    else
        text += fmt::format("{:>9} {:>9} {:>9} {:>6}", "-", "-", "-", "-");
    if (row.momentum)
        text += fmt::format("  {:.1e}, {}", row.momentum->worst, row.momentum->pairs);
    return text + "\n";
}

nlohmann::json remedy_json(const std::vector<RemedyRow>& rows) {
    nlohmann::json json = nlohmann::json::array();
    for (const RemedyRow& row : rows) {
        const SearchCounts& n = row.counts;
        nlohmann::json one{{"switches", row.switches},
                           {"particles", n.particles},
                           {"with_neighbour", n.with_neighbour},
                           {"visible", static_cast<double>(n.owners) / static_cast<double>(n.particles)},
                           {"recall", n.recall()},
                           {"true_nearest", n.true_nearest()},
                           {"non_mutual_rate", n.non_mutual_rate()}};
        one["switches"] = nlohmann::json::object();
        for (const auto& [name, value] : row.switches)
            one["switches"][name] = value;
        for (std::size_t m = 0; m < miss_names.size(); ++m)
            if (n.missed_particles[m] > 0)
                one["missed_particles"][std::string(miss_names[m])] = n.missed_particles[m];
        if (row.cost)
            one["gl"] = {{"frame_seconds", row.cost->frame},
                         {"timer_seconds", row.cost->timer},
                         {"single_layer_seconds", row.cost->single},
                         {"times_single_layer", row.cost->times_single()},
                         {"agrees", row.cost->agrees}};
        if (row.momentum)
            one["momentum"] = {{"pairs", row.momentum->pairs}, {"worst_change", row.momentum->worst}};
        json.push_back(one);
    }
    return json;
}

} // namespace lockstep
