#include "reference/collision/depth_pass.hpp"

#include <cassert>
#include <cstddef>

#include "reference/collision/depth/depth_twin.hpp"
#include "reference/subnormals.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {

void depth_pass(const Particles& before, const CollisionImage& depth, const FrameParams& params, const Profile& profile,
                Particles& after) {
    assert(&before != &after && depth.width == params.width && depth.height == params.height);
    after.resize(before.size());
    const auto count = static_cast<std::ptrdiff_t>(before.size());
    with_arithmetic(profile, params.switches.arithmetic, [&]<class A>(A fp) {
#pragma omp parallel
        {
            const FlushSubnormals guard(profile.compute_flush_subnormals,
                                        profile.compute_flush_results.value_or(profile.compute_flush_subnormals));
            Values<A> values(fp);
            const DepthTwin step(values, depth, params);
#pragma omp for schedule(static)
            for (std::ptrdiff_t i = 0; i < count; ++i) {
                const auto p = static_cast<std::size_t>(i);
                const auto v = step(before[p]);
                after.set(p, {floats(v.position), floats(v.direction), static_cast<float>(v.speed),
                              static_cast<float>(v.collide_time)});
            }
        }
    });
}

} // namespace lockstep
