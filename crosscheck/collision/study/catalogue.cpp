#include "crosscheck/collision/study/catalogue.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "crosscheck/collision/study/study.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/render_pass.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

using Rows = std::vector<CatalogueRow>;

/// What a run ends with, and the hits of each of its frames.
struct Run {
    Particles particles;
    std::vector<std::size_t> hits;

    [[nodiscard]] std::size_t hits_of_last(std::size_t frames) const {
        std::size_t sum = 0;
        for (std::size_t i = hits.size() - std::min(frames, hits.size()); i < hits.size(); ++i)
            sum += hits[i];
        return sum;
    }
};

Run run(const Scene& scene, int frames) {
    ReferenceSimulation simulation(scene, {});
    Run result;
    for (int frame = 0; frame < frames; ++frame) {
        const std::vector<float> before = simulation.particles().collide_time;
        simulation.step(frame_params(scene, frame));
        const std::vector<float>& after = simulation.particles().collide_time;
        std::size_t hits = 0;
        for (std::size_t i = 0; i < before.size(); ++i)
            hits += before[i] < 0.0F && after[i] == scene.constants.collision_time ? 1U : 0U;
        result.hits.push_back(hits);
    }
    result.particles = simulation.particles();
    return result;
}

double share(const Particles& particles, const std::function<bool(std::size_t)>& property) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < particles.size(); ++i)
        count += property(i) ? 1U : 0U;
    return static_cast<double>(count) / static_cast<double>(particles.size());
}

/// Of the particles with a neighbour and a base texel, those that miss them all.
double missed_share(const SearchCounts& n) { return 1.0 - n.recall_inside(); }

/// The same of those `chosen`, whatever their base texel.
double missed_share(const SearchStudy& study, const std::function<bool(std::size_t)>& chosen) {
    std::size_t with_neighbour = 0, missed = 0;
    for (std::size_t i = 0; i < study.findings.size(); ++i) {
        if (study.findings[i].kind == Finding::Kind::alone || !chosen(i))
            continue;
        ++with_neighbour;
        missed += study.findings[i].kind == Finding::Kind::missed ? 1U : 0U;
    }
    return static_cast<double>(missed) / static_cast<double>(with_neighbour);
}

double occluded_share(const SearchCounts& n) {
    return static_cast<double>(n.missed_pairs[static_cast<std::size_t>(Miss::occluded)]) / static_cast<double>(n.pairs);
}

Rows close_up(Scene scene) {
    const auto seen_from = [&](float distance) {
        scene.camera.eye.z = distance;
        return study_start(scene, {}).counts;
    };
    const SearchCounts near = seen_from(0.4F), middle = seen_from(1.3F), far = seen_from(4.0F);
    return {{"close_up", "6-3", "particles on the image that find no neighbour", "camera at 0.4", missed_share(near),
             "camera at 1.3", missed_share(middle), 2.0},
            {"close_up", "6-3", "pairs with a neighbour behind another particle", "camera at 4", occluded_share(far),
             "camera at 1.3", occluded_share(middle), 2.0}};
}

Rows one_sided(const Scene& scene) {
    const Run end = run(scene, 30);
    const auto gain = [&](std::size_t i) {
        return glm::dvec3(end.particles.direction[i]) * static_cast<double>(end.particles.speed[i]) -
               glm::dvec3(scene.start.direction[i]) * static_cast<double>(scene.start.speed[i]);
    };
    const double lost = glm::length(gain(0));
    return {{"one_sided", "6-2", "momentum of the pair that is gone, of what the particle gave up", "one answers alone",
             glm::length(gain(0) + gain(1)) / lost, "mutual response", 0.0},
            {"one_sided", "6-2", "momentum given up, of that taken on by the partner", "one answers alone",
             lost / glm::length(gain(1)), "mutual response", 1.0, 100.0}};
}

Rows overlap_jitter(Scene scene) {
    constexpr std::size_t second = 60;
    const auto rate = [&](const Run& end) {
        return static_cast<double>(end.hits_of_last(second)) / static_cast<double>(end.particles.size());
    };
    const auto path = [&](const Run& end) {
        double sum = 0.0;
        for (std::size_t i = 0; i < end.particles.size(); ++i)
            sum += glm::distance(end.particles.position[i], scene.start.position[i]);
        return sum / static_cast<double>(end.particles.size());
    };
    const Run overlapping = run(scene, 120);
    const double stayed = path(overlapping);
    for (glm::vec3& position : scene.start.position)
        position *= 3.0F;
    const Run apart = run(scene, 120);
    return {{"overlap_jitter", "6-4", "hits a particle in the second second", "overlapping", rate(overlapping),
             "three times as far apart", rate(apart), 5.0},
            {"overlap_jitter", "6-4", "1 / mean path in two seconds", "overlapping", 1.0 / stayed,
             "three times as far apart", 1.0 / path(apart), 1.5}};
}

Rows horn_growth(Scene scene) {
    constexpr float top = 0.2F; // of the sphere
    const auto horn = [&] {
        const Particles end = run(scene, 120).particles;
        return share(end, [&](std::size_t i) { return end.position[i].y > top + 0.1F; });
    };
    const double seldom = horn();
    scene.constants.collision_time /= 10.0F;
    return {{"horn_growth", "6-5", "particles still in the air after two seconds, over 0.1 above the sphere",
             "collision frequency x 10", horn(), "x 1", seldom, 1.5}};
}

Rows camera_drop(Scene scene) {
    const float range = scene.constants.collision_range;
    const auto sunk = [&] {
        const Particles end = run(scene, 150).particles;
        return share(end, [&](std::size_t i) { return end.position[i].y < -range; });
    };
    const double moved = sunk();
    scene.camera_path.clear();
    return {{"camera_drop", "6-6", "particles fallen into the block", "the camera sinks below its top", moved,
             "the camera stands", sunk(), 2.0}};
}

Rows occluded_neighbour(const Scene& scene) {
    const SearchStudy study = study_start(scene, {});
    const auto behind = [&](std::size_t i) { return scene.start.position[i].z < 0.0F; };
    return {{"occluded_neighbour", "6-7, 1", "particles that find no neighbour", "rear sheet",
             missed_share(study, behind), "front sheet", missed_share(study, std::not_fn(behind)), 2.0}};
}

Rows off_axis_spread(const Scene& scene) {
    const FrameParams params = frame_params(scene, 0);
    const TrueNeighbours truth = find_truth(scene.start.position, scene.constants.collision_range);
    const SearchStudy study = study_start(scene, truth, {});
    const auto pixel = [&](std::size_t i) {
        const glm::dvec4 clip = glm::dmat4(params.collision_proj_view) * glm::dvec4(scene.start.position[i], 1.0);
        return glm::dvec2(clip) / clip.w * 0.5 * static_cast<double>(params.width);
    };
    const double half = 0.5 * params.width;
    const auto centre = [&](std::size_t i) { return glm::length(pixel(i)) < 0.3 * half; };
    const auto off_axis = [&](std::size_t i) { return glm::length(pixel(i)) > 0.9 * half; };
    const auto spread = [&](const std::function<bool(std::size_t)>& chosen) {
        double sum = 0.0;
        std::size_t pairs = 0;
        for (std::size_t i = 0; i < scene.start.size(); ++i)
            if (chosen(i))
                for (const std::int32_t j : truth.lists.of(i)) {
                    sum += glm::distance(pixel(i), pixel(static_cast<std::size_t>(j)));
                    ++pairs;
                }
        return sum / static_cast<double>(pairs);
    };
    return {{"off_axis_spread", "6-7, 2 and 3", "texels between two neighbours, mean", "off axis", spread(off_axis),
             "at the centre", spread(centre), 1.1},
            {"off_axis_spread", "6-7, 2 and 3", "particles that find no neighbour", "off axis",
             missed_share(study, off_axis), "at the centre", missed_share(study, centre), 1.1}};
}

Rows plane_hides(const Scene& scene) {
    const Run end = run(scene, 30);
    const FrameParams params = frame_params(scene, 29);
    const ColorImage with = render_pass(end.particles, scene.obstacles, params, {});
    const ColorImage without = render_pass({}, scene.obstacles, params, {});
    std::size_t visible = 0;
    for (std::size_t t = 0; t < with.texels.size(); ++t)
        visible += with.texels[t] == without.texels[t] ? 0U : 1U;
    return {{"plane_hides", "6-7", "hits under the plane in 30 frames; pixels that show a particle", "hits",
             static_cast<double>(end.hits_of_last(30)), "pixels", static_cast<double>(visible), 10.0}};
}

Rows side_view(Scene scene) {
    constexpr float radius = 0.3F; // of the sphere
    const float range = scene.constants.collision_range;
    const auto holes = [&](glm::vec3 eye) {
        scene.switches.cdt_camera = CdtCamera::fixed;
        scene.collision_camera = scene.camera;
        scene.collision_camera.eye = eye;
        const Particles end = run(scene, 100).particles;
        return share(end, [&](std::size_t i) { return glm::length(end.position[i]) < radius - range; });
    };
    const double front = holes({0.0F, 0.0F, 1.6F});
    return {{"side_view", "3-7", "particles that went through the side the viewer sees", "collision camera at the side",
             holes({1.6F, 0.0F, 0.0F}), "in front", front, 2.0},
            {"side_view", "3-9", "particles that went through the side the viewer sees", "collision camera behind",
             holes({0.0F, 0.0F, -1.6F}), "in front", front, 2.0}};
}

struct Effect {
    std::string_view name;
    Rows (*measure)(const Scene&);
};

template <auto Measure> Rows measured(const Scene& scene) { return Measure(scene); }

constexpr std::array effects{
    Effect{"close_up", measured<close_up>},
    Effect{"one_sided", measured<one_sided>},
    Effect{"overlap_jitter", measured<overlap_jitter>},
    Effect{"horn_growth", measured<horn_growth>},
    Effect{"camera_drop", measured<camera_drop>},
    Effect{"occluded_neighbour", measured<occluded_neighbour>},
    Effect{"off_axis_spread", measured<off_axis_spread>},
    Effect{"plane_hides", measured<plane_hides>},
    Effect{"side_view", measured<side_view>},
};

} // namespace

std::span<const std::string_view> catalogue_names() {
    static constexpr auto names = [] {
        std::array<std::string_view, effects.size()> all;
        std::transform(effects.begin(), effects.end(), all.begin(), [](const Effect& effect) { return effect.name; });
        return all;
    }();
    return names;
}

Rows measure_catalogue(std::string_view name, const std::filesystem::path& scenes) {
    for (const Effect& effect : effects)
        if (effect.name == name)
            return effect.measure(load_scene(scenes / fmt::format("{}.json", name)));
    throw Error(
        fmt::format("catalogue: nothing is named {}; the effects are {}", name, fmt::join(catalogue_names(), ", ")));
}

std::string catalogue_head() {
    return "| effect | figure | quantity | with its cause | | without | | there |\n"
           "|---|---|---|---|---:|---|---:|---|\n";
}

std::string catalogue_text(const CatalogueRow& row) {
    return fmt::format("| {} | {} | {} | {} | {:.4g} | {} | {:.4g} | {} |\n", row.name, row.figure, row.quantity,
                       row.cause, row.with_cause, row.control, row.without_cause, row.holds() ? "yes" : "no");
}

} // namespace lockstep
