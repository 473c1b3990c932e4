#include "reference/collision_pass.hpp"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "reference/collision_code.hpp"
#include "reference/particle_step.hpp"
#include "reference/subnormals.hpp"
#include "reference/window.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

struct Collision {
    int x, y;       ///< the texel
    glm::vec3 away; ///< own position minus the one stored there
};

/// One particle's step, as the listing reads. `A`: the arithmetic (arithmetic.hpp).
template <class A> class Step {
  public:
    Step(const CollisionImage& cdt, const FrameParams& params)
        : cdt_(cdt), params_(params), constants_(params.constants), switches_(params.switches), code_(params),
          particle_step_(params) {}

    [[nodiscard]] ParticleState operator()(const ParticleState& before) const {
        const ParticleState a = ParticleStep<A>::flushed(before);
        const BaseTexelIndex base = base_texel(a.position);
        if (a.collide_time < 0.0F && base.x >= 0)
            if (const auto collision = nearest_collision(a.position, base))
                return particle_step_.collide(a, collision->away);
        return particle_step_.integrate(a);
    }

    /// Lines 2 to 4, in float: where clip space lies on the image, then the cast where it is defined.
    [[nodiscard]] BaseTexelIndex base_texel(glm::vec3 position) const {
        const glm::vec4 clip = A::transform(params_.collision_proj_view, position);
        return base_texel(clip);
    }

    [[nodiscard]] BaseTexelIndex base_texel(glm::vec4 clip) const {
        float x = clip.x;
        float y = clip.y;
        if (switches_.perspective_divide == PerspectiveDivide::on) {
            x = A::divide(clip.x, clip.w);
            y = A::divide(clip.y, clip.w);
        }
        x = (x + 1.0F) * 0.5F * static_cast<float>(params_.width);
        y = (y + 1.0F) * 0.5F * static_cast<float>(params_.height);
        const bool right = x < static_cast<float>(params_.width) && y < static_cast<float>(params_.height);
        const bool left = switches_.base_texel == BaseTexel::floor ? x >= 0.0F && y >= 0.0F : x > -1.0F && y > -1.0F;
        if (!left || !right)
            return {};
        return {static_cast<int>(x), static_cast<int>(y)};
    }

    /// Where a search from `position` ends, whatever the collide time.
    [[nodiscard]] std::int32_t collision_texel(glm::vec3 position) const {
        const glm::vec3 own = A::flush(position);
        const BaseTexelIndex base = base_texel(own);
        const auto collision = base.x >= 0 ? nearest_collision(own, base) : std::nullopt;
        return collision ? static_cast<std::int32_t>(cdt_.index(collision->x, collision->y)) : no_texel;
    }

  private:
    [[nodiscard]] bool holds_particle(glm::vec4 stored) const {
        return switches_.empty_texel == EmptyTexel::phantom || stored.a != 0.0F;
    }

    /// Lines 5 to 19: the nearest stored position within the collision range.
    [[nodiscard]] std::optional<Collision> nearest_collision(glm::vec3 position, BaseTexelIndex base) const {
        glm::vec3 curr_pos = position;
        if (switches_.self_position == SelfPosition::texel) {
            const glm::vec4 self = cdt_.at(base.x, base.y);
            if (!holds_particle(self))
                return {};
            curr_pos = A::flush(code_.decode(self));
        }
        float min_length = 100000.0F;
        std::optional<Collision> nearest;
        const int range = constants_.texel_collide_range;
        for (int ty = -range; ty <= range; ++ty) {
            for (int tx = -range; tx <= range; ++tx) {
                if ((tx == 0 && ty == 0) || !cdt_.contains(base.x + tx, base.y + ty))
                    continue;
                const glm::vec4 stored = cdt_.at(base.x + tx, base.y + ty);
                if (!holds_particle(stored))
                    continue;
                const glm::vec3 apart = A::flush(curr_pos - A::flush(code_.decode(stored)));
                const float len = A::length(apart);
                if (len == 0.0F && switches_.zero_distance == ZeroDistance::skip)
                    continue;
                if (constants_.collision_range > len && len < min_length) {
                    min_length = len;
                    nearest = Collision{base.x + tx, base.y + ty, apart};
                }
            }
        }
        return nearest;
    }

    const CollisionImage& cdt_;
    const FrameParams& params_;
    const Constants& constants_;
    const Switches& switches_;
    CollisionCode code_;
    ParticleStep<A> particle_step_;
};

template <class A> void update(const Particles& before, const CollisionImage& cdt, const FrameParams& params,
                               bool flush, Particles& after) {
    const Step<A> step(cdt, params);
    const auto count = static_cast<std::ptrdiff_t>(before.size());
#pragma omp parallel
    {
        const FlushSubnormals guard(flush);
#pragma omp for schedule(static)
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const auto p = static_cast<std::size_t>(i);
            after.set(p, step(before[p]));
        }
    }
}

/// Switch arithmetic plain: the fixed function decides, in the driver's way.
template <class A> PointFragment rasterised_point(glm::vec4 clip, const FrameParams& params, const RasterRules& rules) {
    if (!in_clip_volume(clip))
        return {};
    const WindowPosition window = window_position(clip, params.width, params.height, rules);
    const int x = point_pixel(snap_point(window.x, rules), rules);
    const int y = point_pixel(snap_point(window.y, rules), rules);
    if (x < 0 || y < 0 || x >= params.width || y >= params.height)
        return {};
    return {x, y, rules.depth_by_driver_reciprocal ? (clip.z * A::reciprocal(clip.w)) * 0.5F + 0.5F : window.z};
}

/// Switch arithmetic exact: the pass itself puts the point on the centre of the texel it computes, its depth on a grid
/// of 2^-24, so that no driver has anything left to round.
PointFragment placed_point(glm::vec4 clip, const FrameParams& params) {
    const CollisionImage none;
    const BaseTexelIndex texel = Step<Portable>(none, params).base_texel(clip);
    const float depth = (Portable::divide(clip.z, clip.w) + 1.0F) * 0.5F;
    if (texel.x < 0 || !(clip.w > 0.0F) || !(depth >= 0.0F) || !(depth <= 1.0F))
        return {};
    return {texel.x, texel.y, std::floor(depth * 0x1p24F) * 0x1p-24F};
}

template <class A> PointFragment fragment(glm::vec3 position, const FrameParams& params, const RasterRules& rules) {
    const glm::vec4 clip = A::transform(params.collision_proj_view, position);
    if constexpr (std::is_same_v<A, Portable>)
        return placed_point(clip, params);
    else
        return rasterised_point<A>(clip, params, rules);
}

} // namespace

void update_particles(const Particles& before, const CollisionImage& cdt, const FrameParams& params,
                      const Profile& profile, Particles& after) {
    assert(&before != &after && cdt.width == params.width && cdt.height == params.height);
    after.resize(before.size());
    with_arithmetic(profile, params.switches,
                    [&]<class A>(A) { update<A>(before, cdt, params, profile.flush_subnormals, after); });
}

void rasterise_particles(const Particles& before, const Particles& after, const FrameParams& params,
                         const Profile& profile, CollisionImage& cdt, DepthImage& depth) {
    const auto& positions =
        params.switches.raster_position == RasterPosition::updated ? after.position : before.position;
    const CollisionCode code(params);
    with_arithmetic(profile, params.switches, [&]<class A>(A) {
        const FlushSubnormals guard(profile.flush_subnormals);
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const PointFragment point = fragment<A>(positions[i], params, profile.raster);
            if (point.x < 0 || !(point.depth < depth.at(point.x, point.y)))
                continue;
            depth.at(point.x, point.y) = point.depth;
            cdt.at(point.x, point.y) = code.encode(after.position[i]);
        }
    });
}

PointFragment point_fragment(glm::vec3 position, const FrameParams& params, const Profile& profile) {
    const FlushSubnormals guard(profile.flush_subnormals);
    return with_arithmetic(profile, params.switches,
                           [&]<class A>(A) { return fragment<A>(position, params, profile.raster); });
}

BaseTexelIndex base_texel(glm::vec3 position, const FrameParams& params, const Profile& profile) {
    const FlushSubnormals guard(profile.flush_subnormals);
    const CollisionImage none;
    return with_arithmetic(profile, params.switches,
                           [&]<class A>(A) { return Step<A>(none, params).base_texel(position); });
}

std::vector<std::int32_t> collision_texels(std::span<const glm::vec3> positions, const CollisionImage& cdt,
                                           const FrameParams& params, const Profile& profile) {
    assert(cdt.width == params.width && cdt.height == params.height);
    std::vector<std::int32_t> texels(positions.size());
    const auto count = static_cast<std::ptrdiff_t>(positions.size());
    with_arithmetic(profile, params.switches, [&]<class A>(A) {
        const Step<A> step(cdt, params);
#pragma omp parallel
        {
            const FlushSubnormals guard(profile.flush_subnormals);
#pragma omp for schedule(static)
            for (std::ptrdiff_t i = 0; i < count; ++i)
                texels[static_cast<std::size_t>(i)] = step.collision_texel(positions[static_cast<std::size_t>(i)]);
        }
    });
    return texels;
}

} // namespace lockstep
