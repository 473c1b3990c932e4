#include "reference/octree_pass.hpp"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

#include "reference/octree/octree_twin.hpp"
#include "reference/subnormals.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

constexpr std::size_t leaf_count = std::size_t{1} << (3 * octree_depth);

/// What the leaves hold, leaf by leaf.
struct Leaves {
    std::vector<std::size_t> first; ///< leaf l has the entries [first[l], first[l + 1])
    std::vector<std::int32_t> entry;
    std::vector<glm::vec3> position; ///< of each entry
};

Leaves fill_leaves(std::span<const glm::vec3> particles, const Mesh& obstacles, const FrameParams& params) {
    const bool with_obstacles = params.switches.obstacles_in_cdt != ObstaclesInCdt::off;
    const std::size_t count = particles.size() + (with_obstacles ? obstacles.positions.size() : 0);
    const auto position = [&](std::size_t i) {
        return i < particles.size() ? particles[i] : obstacles.positions[i - particles.size()];
    };
    std::vector<std::vector<std::int32_t>> entries(leaf_count);
    for (std::size_t i = 0; i < count; ++i)
        if (const std::int32_t leaf = octree_leaf(position(i), params.constants.octree_size); leaf != no_leaf)
            entries[static_cast<std::size_t>(leaf)].push_back(static_cast<std::int32_t>(i));
    Leaves leaves;
    for (const std::vector<std::int32_t>& leaf : entries) {
        leaves.first.push_back(leaves.entry.size());
        leaves.entry.insert(leaves.entry.end(), leaf.begin(), leaf.end());
    }
    leaves.first.push_back(leaves.entry.size());
    for (const std::int32_t i : leaves.entry)
        leaves.position.push_back(position(static_cast<std::size_t>(i)));
    return leaves;
}

/// The leaf that a position lies in.
LeafEntries leaf_of(glm::vec3 position, const Leaves& leaves, const FrameParams& params) {
    const std::int32_t found = octree_leaf(position, params.constants.octree_size);
    if (found == no_leaf)
        return {};
    const auto leaf = static_cast<std::size_t>(found);
    const std::size_t first = leaves.first[leaf], count = leaves.first[leaf + 1] - first;
    return {{leaves.entry.data() + first, count}, {leaves.position.data() + first, count}};
}

template <class Work> void for_each_particle(std::size_t count, const Profile& profile, const Work& work) {
    const auto n = static_cast<std::ptrdiff_t>(count);
#pragma omp parallel
    {
        const FlushSubnormals guard(profile.compute_flush_subnormals,
                                    profile.compute_flush_results.value_or(profile.compute_flush_subnormals));
#pragma omp for schedule(dynamic, 256)
        for (std::ptrdiff_t i = 0; i < n; ++i)
            work(static_cast<std::size_t>(i));
    }
}

} // namespace

std::int32_t octree_leaf(glm::vec3 position, float size) {
    glm::vec3 low(-0.5F * size);
    glm::vec3 high(0.5F * size);
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(position[axis]) <= std::numeric_limits<float>::min())
            position[axis] = 0.0F;
        if (!(position[axis] >= low[axis] && position[axis] < high[axis]))
            return no_leaf;
    }
    std::int32_t leaf = 0;
    for (int depth = 0; depth < octree_depth; ++depth) {
        leaf *= 8;
        for (int axis = 0; axis < 3; ++axis) {
            const float middle = (low[axis] + high[axis]) * 0.5F;
            const bool upper = position[axis] >= middle;
            leaf += upper ? 1 << axis : 0;
            (upper ? low : high)[axis] = middle;
        }
    }
    return leaf;
}

void octree_pass(const Particles& before, const Mesh& obstacles, const FrameParams& params, const Profile& profile,
                 Particles& after) {
    assert(&before != &after);
    after.resize(before.size());
    const Leaves leaves = fill_leaves(before.position, obstacles, params);
    with_arithmetic(profile, params.switches, [&]<class A>(A fp) {
        for_each_particle(before.size(), profile, [&](std::size_t i) {
            Values<A> values(fp);
            const OctreeTwin step(values, params);
            const auto v = step(static_cast<std::int32_t>(i), before[i], leaf_of(before.position[i], leaves, params));
            after.set(i, {floats(v.position), floats(v.direction), static_cast<float>(v.speed),
                          static_cast<float>(v.collide_time)});
        });
    });
}

std::vector<std::int32_t> octree_partners(std::span<const glm::vec3> positions, const Mesh& obstacles,
                                          const FrameParams& params, const Profile& profile) {
    const Leaves leaves = fill_leaves(positions, obstacles, params);
    std::vector<std::int32_t> partners(positions.size());
    with_arithmetic(profile, params.switches, [&]<class A>(A fp) {
        for_each_particle(positions.size(), profile, [&](std::size_t i) {
            Values<A> values(fp);
            const OctreeTwin step(values, params);
            const auto own = values.read(site::position_before, positions[i]);
            const auto hit =
                step.nearest_collision(static_cast<std::int32_t>(i), own, leaf_of(positions[i], leaves, params));
            partners[i] = hit ? hit->entry : -1;
        });
    });
    return partners;
}

} // namespace lockstep
