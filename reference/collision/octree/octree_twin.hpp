#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>

#include "reference/collision/octree/octree_leaves.hpp"
#include "reference/collision/particle_twin.hpp"
#include "reference/readings/values.hpp"

namespace lockstep {

namespace site {
inline constexpr Site entries{"leaf's entries"};
inline constexpr Site entry{"entry's position"};
inline constexpr Site corner{"corner's position"};
inline constexpr Site particles{"particles are entries"};
inline constexpr Site corners{"obstacles' corners are entries"};
inline constexpr Site itself{"particle itself"};
} // namespace site

/// One particle's step with the octree's search for the CDT's, over a reading `R`. Twin of
/// shaders/collision/octree_pass.comp.
template <class R> class OctreeTwin {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;

  public:
    struct Collision {
        std::int32_t entry; ///< its number
        Vec3 away;          ///< own position minus the entry's
    };
    struct State : ParticleTwinState<R> {
        std::optional<Collision> hit = {};
    };

    OctreeTwin(R& reading, const FrameParams& params)
        : r(reading), constants_(params.constants), switches_(params.switches), particle_(reading, params) {}

    /// `leaf`: of the particle's position; empty outside the root.
    [[nodiscard]] State operator()(std::int32_t self, const ParticleState& before, const LeafEntries& leaf) const {
        const ParticleTwinState<R> a = particle_.read(before);
        if (r.decide(site::searches, a.collide_time < 0.0F))
            if (const auto hit = nearest_collision(self, a.position, leaf))
                return {particle_.collide(a, hit->away), hit};
        return {particle_.integrate(a)};
    }

    /// The nearest entry of the leaf within the collision range.
    [[nodiscard]] std::optional<Collision> nearest_collision(std::int32_t self, const Vec3& own,
                                                             const LeafEntries& leaf) const {
        const bool zero_hits = r.setting(site::zero_distance_hits, switches_.zero_distance == ZeroDistance::hit);
        const Real range = r.uniform(site::collision_range, constants_.collision_range);
        auto nearest = least<Collision>(r, site::nearest, 100000.0F);
        for (const int at : r.range(site::entries, 0, static_cast<int>(leaf.number.size()) - 1)) {
            const auto e = static_cast<std::size_t>(at);
            const bool corner = leaf.number[e] >= leaf.particles;
            if (!r.setting(corner ? site::corners : site::particles, true))
                continue;
            if (r.decide(site::itself, leaf.number[e] == self))
                continue;
            const Vec3 apart = r.note(site::apart, own - r.read(corner ? site::corner : site::entry, leaf.position[e]));
            const Real len = r.note(site::distance, r.length(site::distance, apart));
            nearest.offer(site::in_range, range > len && (zero_hits || len != 0.0F), len, {leaf.number[e], apart});
        }
        return nearest.take();
    }

  private:
    R& r;
    const Constants& constants_;
    const Switches& switches_;
    ParticleTwin<R> particle_;
};

} // namespace lockstep
