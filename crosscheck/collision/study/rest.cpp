#include "crosscheck/collision/study/rest.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reference/collision/simulation.hpp"
#include "reference/collision/situations.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

double share(std::size_t part, std::size_t all) { return static_cast<double>(part) / static_cast<double>(all); }

float lowest_point(const Scene& scene) {
    if (scene.obstacles.positions.empty())
        throw Error("study rest counts the particles that lie on an obstacle; this scene has none");
    float lowest = scene.obstacles.positions.front().y;
    for (const glm::vec3& position : scene.obstacles.positions)
        lowest = std::min(lowest, position.y);
    return lowest;
}

/// The height under which `part` of all lie.
double quantile(std::vector<float>& heights, double part) {
    if (heights.empty())
        return 0.0;
    const auto at = heights.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(heights.size() - 1));
    std::nth_element(heights.begin(), at, heights.end());
    return static_cast<double>(*at);
}

std::size_t count_moved(const Particles& before, const Particles& after) {
    std::size_t moved = 0;
    for (std::size_t i = 0; i < after.size(); ++i)
        moved += before.position[i] != after.position[i] ? 1U : 0U;
    return moved;
}

RestFrame measure(const Particles& particles, float floor) {
    RestFrame row;
    std::vector<float> heights;
    std::size_t above = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const float height = particles.position[i].y - floor;
        if (!(height > 0.0F))
            continue;
        ++above;
        if (particles.speed[i] < rest_speed)
            heights.push_back(height);
    }
    row.above = share(above, particles.size());
    row.at_rest = share(heights.size(), particles.size());
    row.middle = quantile(heights, 0.5);
    row.top = quantile(heights, 0.99);
    return row;
}

} // namespace

std::vector<RestFrame> rest_run(const Scene& scene, const Profile& profile, const RestOptions& options) {
    const float floor = lowest_point(scene);
    ReferenceSimulation simulation(scene, profile);
    std::vector<RestFrame> rows;
    for (int frame = 0; frame < options.frames; ++frame) {
        const Particles before = simulation.particles();
        simulation.step(frame_params(scene, frame));
        if ((frame + 1) % options.every != 0)
            continue;
        const Particles& after = simulation.particles();
        RestFrame row = measure(after, floor);
        row.frames = frame + 1;
        row.hits =
            share(count_hits(before.collide_time, after.collide_time, scene.constants.collision_time), after.size());
        row.moving = share(count_moved(before, after), after.size());
        rows.push_back(row);
        if (options.on_frame)
            options.on_frame(row);
    }
    return rows;
}

std::string rest_head() {
    return "| frames | hits % | moving % | above % | at rest % | half lie under | 99 % lie under |\n"
           "|---:|---:|---:|---:|---:|---:|---:|\n";
}

std::string rest_text(const RestFrame& row) {
    return fmt::format("| {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.3f} | {:.3f} |\n", row.frames, 100.0 * row.hits,
                       100.0 * row.moving, 100.0 * row.above, 100.0 * row.at_rest, row.middle, row.top);
}

} // namespace lockstep
