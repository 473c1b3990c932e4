#include "reference/collision/octree_pass.hpp"

#include <cassert>
#include <cstddef>

#include "reference/collision/octree/octree_leaves.hpp"
#include "reference/collision/octree/octree_twin.hpp"
#include "reference/subnormals.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

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

void octree_pass(const Particles& before, const Mesh& obstacles, const FrameParams& params, const Profile& profile,
                 Particles& after) {
    assert(&before != &after);
    after.resize(before.size());
    const OctreeLeaves leaves = fill_leaves(before.position, obstacles, params);
    with_arithmetic(profile, params.switches.arithmetic, [&]<class A>(A fp) {
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
    const OctreeLeaves leaves = fill_leaves(positions, obstacles, params);
    std::vector<std::int32_t> partners(positions.size());
    with_arithmetic(profile, params.switches.arithmetic, [&]<class A>(A fp) {
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
