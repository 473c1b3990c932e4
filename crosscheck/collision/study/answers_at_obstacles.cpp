#include "crosscheck/collision/study/answers_at_obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "reference/collision/depth_pass.hpp"
#include "reference/collision/octree_pass.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/collision/layered_cdt.hpp"

namespace lockstep {
namespace {

double distance_to_segment(glm::dvec3 point, glm::dvec3 a, glm::dvec3 b) {
    const glm::dvec3 along = b - a;
    const double length = glm::dot(along, along);
    const double part = length > 0.0 ? std::clamp(glm::dot(point - a, along) / length, 0.0, 1.0) : 0.0;
    return glm::distance(point, a + part * along);
}

bool is_finite(glm::vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

} // namespace

double distance_to_triangle(glm::dvec3 point, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    const auto inside_of = [&](glm::dvec3 from, glm::dvec3 to) {
        return glm::dot(glm::cross(to - from, point - from), normal) >= 0.0;
    };
    if (length > 0.0 && inside_of(a, b) && inside_of(b, c) && inside_of(c, a))
        return std::abs(glm::dot(point - a, normal)) / length;
    return std::min(
        {distance_to_segment(point, a, b), distance_to_segment(point, b, c), distance_to_segment(point, c, a)});
}

std::vector<std::size_t> touching(std::span<const glm::vec3> positions, const Mesh& mesh, float range) {
    std::vector<std::size_t> by_x;
    for (std::size_t i = 0; i < positions.size(); ++i)
        if (is_finite(positions[i]))
            by_x.push_back(i);
    std::sort(by_x.begin(), by_x.end(), [&](std::size_t i, std::size_t j) { return positions[i].x < positions[j].x; });
    std::vector<char> touches(positions.size(), 0);
    const double reach = range;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const auto corner = [&](std::size_t c) { return glm::dvec3(mesh.positions[mesh.indices[3 * t + c]]); };
        const glm::dvec3 a = corner(0), b = corner(1), c = corner(2);
        const glm::dvec3 low = glm::min(glm::min(a, b), c) - reach, high = glm::max(glm::max(a, b), c) + reach;
        const auto first = std::lower_bound(by_x.begin(), by_x.end(), low.x,
                                            [&](std::size_t i, double x) { return double{positions[i].x} < x; });
        for (auto it = first; it != by_x.end() && double{positions[*it].x} <= high.x; ++it) {
            const glm::dvec3 p(positions[*it]);
            if (touches[*it] == 0 && p.y >= low.y && p.y <= high.y && p.z >= low.z && p.z <= high.z &&
                distance_to_triangle(p, a, b, c) < reach)
                touches[*it] = 1;
        }
    }
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < touches.size(); ++i)
        if (touches[i] != 0)
            found.push_back(i);
    return found;
}

Hits hits_of_cdt(const SearchStudy& study) {
    Hits hits(study.findings.size());
    std::transform(study.findings.begin(), study.findings.end(), hits.begin(),
                   [](const Finding& finding) { return finding.hit != Hit::none; });
    return hits;
}

Hits hits_of_octree(const Scene& scene) {
    std::vector<glm::vec3> entries = scene.start.position;
    if (scene.switches.obstacles_in_cdt != ObstaclesInCdt::off)
        entries.insert(entries.end(), scene.obstacles.positions.begin(), scene.obstacles.positions.end());
    std::vector<std::int32_t> leaf(entries.size());
    std::transform(entries.begin(), entries.end(), leaf.begin(),
                   [&](glm::vec3 position) { return octree_leaf(position, scene.constants.octree_size); });
    const NeighbourLists in_range = list_neighbours(entries, scene.constants.collision_range);
    Hits hits(scene.start.size());
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const auto near = in_range.of(i);
        hits[i] = leaf[i] != no_leaf && std::any_of(near.begin(), near.end(), [&](std::int32_t j) {
                      return leaf[static_cast<std::size_t>(j)] == leaf[i];
                  });
    }
    return hits;
}

Hits hits_of_depth(Scene scene, const Profile& profile) {
    scene.switches.search = Search::depth;
    std::fill(scene.start.collide_time.begin(), scene.start.collide_time.end(), -1.0F);
    const FrameParams params = frame_params(scene, 0);
    CollisionImage depth = empty_cdt(scene);
    ReferenceSimulation(scene, profile).draw(scene.start, scene.start, params, depth);
    Particles after;
    depth_pass(scene.start, depth, params, profile, after);
    Hits hits(after.size());
    std::transform(after.collide_time.begin(), after.collide_time.end(), hits.begin(),
                   [&](float time) { return time == params.constants.collision_time; });
    return hits;
}

double share_of_hits(const Hits& hits, std::span<const std::size_t> particles) {
    const auto hit = std::count_if(particles.begin(), particles.end(), [&](std::size_t i) { return hits[i]; });
    return particles.empty() ? std::numeric_limits<double>::quiet_NaN()
                             : static_cast<double>(hit) / static_cast<double>(particles.size());
}

} // namespace lockstep
