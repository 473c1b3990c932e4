#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include <omp.h>

#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_pass_fast.hpp"
#include "reference/collision/step_stage.hpp"
#include "reference/collision/texel_lookup.hpp"
#include "reference/vector_loops.hpp"
#include "reference/window.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

/// What the depth test keeps in a texel: depth above, particle below, so that the least key is the nearest particle
/// and, of equally near ones, the first.
using DrawingKey = std::uint64_t;
constexpr DrawingKey undrawn = ~DrawingKey{0};

/// Ordered like the depths.
DrawingKey drawing_key(float depth, std::size_t particle) {
    constexpr std::uint32_t sign = 0x80000000U;
    const auto bits = std::bit_cast<std::uint32_t>(depth);
    return DrawingKey{(bits & sign) != 0 ? ~bits : bits | sign} << 32U | particle;
}

float depth_of(DrawingKey key) {
    constexpr std::uint32_t sign = 0x80000000U;
    const auto bits = static_cast<std::uint32_t>(key >> 32U);
    return std::bit_cast<float>((bits & sign) != 0 ? bits & ~sign : ~bits);
}

std::size_t particle_of(DrawingKey key) { return key & 0xffffffffU; }

/// Texel index and depth of a block's points, -1 for those that are not drawn: point_fragment() without branches.
template <class A, ViewportRounding viewport, SnapRounding snap>
void point_fragments(A fp, const Columns& position, std::size_t count, const FrameParams& params, RasterRules rules,
                     std::int32_t* texel, float* depth) {
    rules.viewport = viewport; // known to the compiler
    rules.point_snap = snap;
    const glm::mat4 proj_view = params.collision_proj_view;
    const int width = params.width;
    const int height = params.height;
    const ClipDepth clip_depth = params.clip_depth;
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec4 clip = fp.transform(proj_view, position.at(i));
        const bool inside = in_clip_volume(clip, clip_depth);
        const WindowPosition window = window_position(clip, width, height, rules, clip_depth);
        const int x = point_pixel(snap_point(inside ? window.x : 0.0F, rules), rules);
        const int y = point_pixel(snap_point(inside ? window.y : 0.0F, rules), rules);
        const bool drawn = inside & (x >= 0) & (y >= 0) & (x < width) & (y < height);
        texel[i] = drawn ? y * width + x : -1;
        depth[i] = window.z;
    }
}

/// The same where the pass places its points itself.
template <class A> void placed_fragments(A fp, const Columns& position, std::size_t count, const FrameParams& params,
                                         std::int32_t* texel, float* depth) {
    const glm::mat4 proj_view = params.collision_proj_view;
    const TexelLookup lookup(fp, params);
    const int width = params.width;
    const bool from_zero = params.clip_depth.from_zero();
    const float sign = params.clip_depth.sign();
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec4 clip = fp.transform(proj_view, position.at(i));
        const auto base = lookup(clip);
        const float ndc = fp.divide(clip.z, clip.w);
        const float z = from_zero ? ndc : (ndc + 1.0F) * 0.5F;
        const bool drawn = base.inside & (clip.w > 0.0F) & (z >= 0.0F) & (z <= 1.0F);
        texel[i] = drawn ? base.y * width + base.x : -1;
        depth[i] = sign * (std::is_same_v<A, Portable> ? std::floor(z * 0x1p24F) * 0x1p-24F : z);
    }
}

/// Draws particles first .. last - 1 into `keys`.
template <class A, ViewportRounding viewport, SnapRounding snap>
LOCKSTEP_VECTOR_CLONES void draw_slice(A fp, const std::vector<glm::vec3>& positions, std::size_t first,
                                       std::size_t last, const FrameParams& params, const RasterRules& rules,
                                       DrawingKey* keys) {
    std::array<std::int32_t, block_size> texel;
    std::array<float, block_size> depth;
    Columns position;
    for (; first < last; first += block_size) {
        const std::size_t count = std::min(block_size, last - first);
        position.load(&positions[first], count);
        if (places_points(params.switches))
            placed_fragments(fp, position, count, params, texel.data(), depth.data());
        else
            point_fragments<A, viewport, snap>(fp, position, count, params, rules, texel.data(), depth.data());
        for (std::size_t i = 0; i < count; ++i)
            if (texel[i] >= 0)
                keys[texel[i]] = std::min(keys[texel[i]], drawing_key(depth[i], first + i));
    }
}

template <class A, ViewportRounding viewport> auto draw_slice_for(SnapRounding snap) {
    switch (snap) {
    case SnapRounding::half_to_even:
        return draw_slice<A, viewport, SnapRounding::half_to_even>;
    case SnapRounding::half_up:
        return draw_slice<A, viewport, SnapRounding::half_up>;
    case SnapRounding::down:
        return draw_slice<A, viewport, SnapRounding::down>;
    case SnapRounding::half_away:
        break;
    }
    return draw_slice<A, viewport, SnapRounding::half_away>;
}

template <class A> auto draw_slice_for(const RasterRules& rules) {
    return rules.viewport == ViewportRounding::fused ? draw_slice_for<A, ViewportRounding::fused>(rules.point_snap)
                                                     : draw_slice_for<A, ViewportRounding::separate>(rules.point_snap);
}

/// Each slice of the particles draws into keys of its own; the least key of a texel is the same however many slices
/// there are. Keys are 8 bytes a texel and slice, hence not more than a few.
constexpr int most_slices = 8;

template <class A> void rasterise(A fp, const std::vector<glm::vec3>& positions, const std::vector<glm::vec3>& stored,
                                  const FrameParams& params, const Profile& profile, CollisionImage& cdt,
                                  DepthImage& depth) {
    const auto draw = draw_slice_for<A>(profile.raster);
    const CollisionCode code(params);
    const std::size_t texels = cdt.texels.size();
    const int slices = std::min(omp_get_max_threads(), most_slices);
    const auto keys = std::make_unique_for_overwrite<DrawingKey[]>(texels * slices);
    const auto start = [&](int slice) { return positions.size() * slice / slices; };
#pragma omp parallel
    {
        const FlushSubnormals guard = flush_in_step(params.switches, profile);
#pragma omp for schedule(static, 1)
        for (int slice = 0; slice < slices; ++slice) {
            std::fill_n(&keys[texels * slice], texels, undrawn);
            draw(fp, positions, start(slice), start(slice + 1), params, profile.raster, &keys[texels * slice]);
        }
#pragma omp for schedule(static)
        for (std::ptrdiff_t t = 0; t < static_cast<std::ptrdiff_t>(texels); ++t) {
            DrawingKey key = undrawn;
            for (int slice = 0; slice < slices; ++slice)
                key = std::min(key, keys[texels * slice + t]);
            if (key == undrawn || !(depth_of(key) < depth.texels[t]))
                continue;
            depth.texels[t] = depth_of(key);
            cdt.texels[t] = code.encode(stored[particle_of(key)]);
        }
    }
}

} // namespace

void rasterise_particles_fast(const Particles& before, const Particles& after, const FrameParams& params,
                              const Profile& profile, CollisionImage& cdt, DepthImage& depth) {
    const bool exact = params.switches.arithmetic == ArithmeticSwitch::exact;
    const bool slow_points = !places_points(params.switches) && (profile.raster.depth_by_driver_reciprocal ||
                                                                 profile.raster.viewport == ViewportRounding::scaled);
    if (!exact && (profile.roots != nullptr || !has_fast_orders(profile) || slow_points))
        return rasterise_particles(before, after, params, profile, cdt, depth);
    const auto& positions =
        params.switches.raster_position == RasterPosition::updated ? after.position : before.position;
    with_arithmetic(profile, params.switches.arithmetic, [&]<class A>(A fp) {
        if constexpr (!std::is_same_v<A, DriverRoots> && !std::is_same_v<A, OwnOrders>)
            rasterise(fp, positions, after.position, params, profile, cdt, depth);
    });
}

} // namespace lockstep
