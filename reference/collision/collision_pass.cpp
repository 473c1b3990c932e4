#include "reference/collision/collision_pass.hpp"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_twin.hpp"
#include "reference/collision/step_stage.hpp"
#include "reference/window.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

template <class R> ParticleState as_floats(const ParticleTwinState<R>& v) {
    return {floats(v.position), floats(v.direction), static_cast<float>(v.speed), static_cast<float>(v.collide_time)};
}

template <class A> void update(A fp, const Particles& before, const CollisionImage& cdt, const FrameParams& params,
                               const Profile& profile, Particles& after) {
    const auto count = static_cast<std::ptrdiff_t>(before.size());
#pragma omp parallel
    {
        const FlushSubnormals guard = flush_in_step(params.switches, profile);
        Values<A> values(fp);
        const CollisionTwin step(values, cdt, params);
#pragma omp for schedule(static)
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const auto p = static_cast<std::size_t>(i);
            after.set(p, as_floats(step(before[p])));
        }
    }
}

/// Where clip space lies on the image (listing, lines 2 to 4).
template <class A> BaseTexelIndex base_texel(A fp, glm::vec4 clip, const FrameParams& params) {
    Values<A> values(fp);
    const BaseTexelTwin twin(values, params);
    const auto texel = twin.base_texel(twin.image_position({clip.x, clip.y, clip.z, clip.w}));
    return texel ? BaseTexelIndex{texel->x, texel->y} : BaseTexelIndex{};
}

/// The fixed function decides, in the driver's way.
template <class A>
PointFragment rasterised_point(A fp, glm::vec4 clip, const FrameParams& params, const RasterRules& rules) {
    if (!in_clip_volume(clip, params.clip_depth))
        return {};
    const WindowPosition window = window_position(clip, params.width, params.height, rules, params.clip_depth);
    const int x = point_pixel(snap_point(window.x, rules), rules);
    const int y = point_pixel(snap_point(window.y, rules), rules);
    if (x < 0 || y < 0 || x >= params.width || y >= params.height)
        return {};
    const auto by_reciprocal = [&] {
        return (clip.z * fp.reciprocal(clip.w)) * params.clip_depth.scale() + params.clip_depth.offset();
    };
    return {x, y, rules.depth_by_driver_reciprocal ? by_reciprocal() : window.z};
}

/// The pass itself decides: the texel that the next frame will compute. With arithmetic exact its depth is on a grid of
/// 2^-24, so that a driver that draws it has nothing left to round.
template <class A> PointFragment placed_point(A fp, glm::vec4 clip, const FrameParams& params) {
    const BaseTexelIndex texel = base_texel(fp, clip, params);
    const float ndc = fp.divide(clip.z, clip.w);
    const float depth = params.clip_depth.from_zero() ? ndc : (ndc + 1.0F) * 0.5F;
    if (texel.x < 0 || !(clip.w > 0.0F) || !(depth >= 0.0F) || !(depth <= 1.0F))
        return {};
    const float kept = std::is_same_v<A, Portable> ? std::floor(depth * 0x1p24F) * 0x1p-24F : depth;
    return {texel.x, texel.y, params.clip_depth.sign() * kept};
}

template <class A>
PointFragment fragment(A fp, glm::vec3 position, const FrameParams& params, const RasterRules& rules) {
    const glm::vec4 clip = fp.transform(params.collision_proj_view, position);
    return places_points(params.switches) ? placed_point(fp, clip, params) : rasterised_point(fp, clip, params, rules);
}

} // namespace

void update_particles(const Particles& before, const CollisionImage& cdt, const FrameParams& params,
                      const Profile& profile, Particles& after) {
    assert(&before != &after && cdt.width == params.width && cdt.height == params.height);
    after.resize(before.size());
    with_arithmetic(profile, params.switches.arithmetic,
                    [&](auto fp) { update(fp, before, cdt, params, profile, after); });
}

void rasterise_particles(const Particles& before, const Particles& after, const FrameParams& params,
                         const Profile& profile, CollisionImage& cdt, DepthImage& depth) {
    const auto& positions =
        params.switches.raster_position == RasterPosition::updated ? after.position : before.position;
    const CollisionCode code(params);
    with_arithmetic(profile, params.switches.arithmetic, [&](auto fp) {
        const FlushSubnormals guard = flush_in_step(params.switches, profile);
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const PointFragment point = fragment(fp, positions[i], params, profile.raster);
            if (point.x < 0 || !(point.depth < depth.at(point.x, point.y)))
                continue;
            depth.at(point.x, point.y) = point.depth;
            cdt.at(point.x, point.y) = code.encode(after.position[i]);
        }
    });
}

PointFragment point_fragment(glm::vec3 position, const FrameParams& params, const Profile& profile) {
    const FlushSubnormals guard = flush_in_step(params.switches, profile);
    return with_arithmetic(profile, params.switches.arithmetic,
                           [&](auto fp) { return fragment(fp, position, params, profile.raster); });
}

PointFragment placed_fragment(glm::vec4 clip, const FrameParams& params, const Profile& profile) {
    const FlushSubnormals guard = flush_in_step(params.switches, profile);
    return with_arithmetic(profile, params.switches.arithmetic,
                           [&](auto fp) { return placed_point(fp, clip, params); });
}

BaseTexelIndex base_texel(glm::vec3 position, const FrameParams& params, const Profile& profile) {
    const FlushSubnormals guard = flush_in_step(params.switches, profile);
    return with_arithmetic(profile, params.switches.arithmetic, [&](auto fp) {
        return base_texel(fp, fp.transform(params.collision_proj_view, position), params);
    });
}

std::vector<std::int32_t> collision_texels(std::span<const glm::vec3> positions, const CollisionImage& cdt,
                                           const FrameParams& params, const Profile& profile) {
    assert(cdt.width == params.width && cdt.height == params.height);
    std::vector<std::int32_t> texels(positions.size());
    const auto count = static_cast<std::ptrdiff_t>(positions.size());
    with_arithmetic(profile, params.switches.arithmetic, [&]<class A>(A fp) {
#pragma omp parallel
        {
            const FlushSubnormals guard = flush_in_step(params.switches, profile);
            Values<A> values(fp);
            const CollisionTwin step(values, cdt, params);
#pragma omp for schedule(static)
            for (std::ptrdiff_t i = 0; i < count; ++i) {
                const auto p = static_cast<std::size_t>(i);
                const auto collision = step.collision(positions[p]);
                texels[p] =
                    collision ? static_cast<std::int32_t>(cdt.index(collision->texel.x, collision->texel.y)) : no_texel;
            }
        }
    });
    return texels;
}

} // namespace lockstep
