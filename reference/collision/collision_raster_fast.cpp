#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include <omp.h>

#include "reference/collision/block_arithmetic.hpp"
#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_pass_fast.hpp"
#include "reference/collision/step_stage.hpp"
#include "reference/collision/texel_lookup.hpp"
#include "reference/vector_loops.hpp"
#include "reference/window.hpp"

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

/// Texels and depths of a block's points; -1 for those that are not drawn.
struct Points {
    alignas(64) std::array<std::int32_t, block_size> texel;
    alignas(64) Floats depth;
};

/// Clip space of a block, one array a coordinate; `divisor`: w as the arithmetic divides by it.
struct ClipColumns {
    alignas(64) Floats x, y, z, w, divisor;
};

template <class B>
void project(const B& fp, const glm::mat4& proj_view, Columns& position, std::size_t count, ClipColumns& clip) {
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec4 c = fp.transform(proj_view, fp.flush(position.at(i)));
        clip.x[i] = c.x;
        clip.y[i] = c.y;
        clip.z[i] = c.z;
        clip.w[i] = c.w;
    }
    fp.divisors(clip.w, count, clip.divisor);
}

/// point_fragment() without branches, where the rasteriser places points.
template <class B, ViewportRounding viewport, SnapRounding snap>
void point_fragments(const B& fp, const ClipColumns& clip, std::size_t count, const FrameParams& params,
                     RasterRules rules, Points& points) {
    rules.viewport = viewport; // known to the compiler
    rules.point_snap = snap;
    const int width = params.width;
    const int height = params.height;
    const ClipDepth clip_depth = params.clip_depth;
    const bool by_reciprocal = rules.depth_by_driver_reciprocal;
    const float *const clip_x = clip.x.data(), *const clip_y = clip.y.data(), *const clip_z = clip.z.data(),
                       *const clip_w = clip.w.data(), *const divisor = clip.divisor.data();
    std::int32_t* const texel = points.texel.data();
    float* const depth = points.depth.data();
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec4 c{clip_x[i], clip_y[i], clip_z[i], clip_w[i]};
        const bool inside = in_clip_volume(c, clip_depth);
        const WindowPosition window = window_position(c, width, height, rules, clip_depth);
        const int x = point_pixel(snap_point(inside ? window.x : 0.0F, rules), rules);
        const int y = point_pixel(snap_point(inside ? window.y : 0.0F, rules), rules);
        const bool drawn = inside & (x >= 0) & (y >= 0) & (x < width) & (y < height);
        const float z = (c.z * fp.reciprocal_of(divisor[i])) * clip_depth.scale() + clip_depth.offset();
        texel[i] = drawn ? y * width + x : -1;
        depth[i] = by_reciprocal ? z : window.z;
    }
}

/// The same where the pass places its points itself.
template <class B> void placed_fragments(const B& fp, const ClipColumns& clip, std::size_t count,
                                         const FrameParams& params, Points& points) {
    const TexelLookup lookup(params);
    const bool divides = params.switches.perspective_divide == PerspectiveDivide::on;
    const int width = params.width;
    const bool from_zero = params.clip_depth.from_zero();
    const float sign = params.clip_depth.sign();
    const float *const clip_x = clip.x.data(), *const clip_y = clip.y.data(), *const clip_z = clip.z.data(),
                       *const clip_w = clip.w.data(), *const divisor = clip.divisor.data();
    std::int32_t* const texel = points.texel.data();
    float* const depth = points.depth.data();
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < count; ++i) {
        const float x = divides ? fp.quotient(clip_x[i], divisor[i]) : clip_x[i];
        const float y = divides ? fp.quotient(clip_y[i], divisor[i]) : clip_y[i];
        const auto base = lookup(x, y);
        const float ndc = fp.quotient(clip_z[i], divisor[i]);
        const float z = from_zero ? ndc : (ndc + 1.0F) * 0.5F;
        const bool drawn = base.inside & (clip_w[i] > 0.0F) & (z >= 0.0F) & (z <= 1.0F);
        texel[i] = drawn ? base.y * width + base.x : -1;
        depth[i] = sign * (std::is_same_v<B, PortableBlocks> ? std::floor(z * 0x1p24F) * 0x1p-24F : z);
    }
}

/// The points of at most block_size positions.
template <class B, ViewportRounding viewport, SnapRounding snap>
LOCKSTEP_VECTOR_CLONES void place(const B& fp, std::span<const glm::vec3> positions, const FrameParams& params,
                                  const RasterRules& rules, Points& points) {
    Columns position;
    ClipColumns clip;
    position.load(positions.data(), positions.size());
    project(fp, flushed<B>(params.collision_proj_view), position, positions.size(), clip);
    if (places_points(params.switches))
        placed_fragments(fp, clip, positions.size(), params, points);
    else
        point_fragments<B, viewport, snap>(fp, clip, positions.size(), params, rules, points);
}

template <class B>
using Place = void (*)(const B&, std::span<const glm::vec3>, const FrameParams&, const RasterRules&, Points&);

template <class B, ViewportRounding viewport> Place<B> place_for(SnapRounding snap) {
    switch (snap) {
    case SnapRounding::half_to_even:
        return place<B, viewport, SnapRounding::half_to_even>;
    case SnapRounding::half_up:
        return place<B, viewport, SnapRounding::half_up>;
    case SnapRounding::down:
        return place<B, viewport, SnapRounding::down>;
    case SnapRounding::half_away:
        break;
    }
    return place<B, viewport, SnapRounding::half_away>;
}

template <class B> Place<B> place_for(const RasterRules& rules) {
    switch (rules.viewport) {
    case ViewportRounding::fused:
        return place_for<B, ViewportRounding::fused>(rules.point_snap);
    case ViewportRounding::scaled:
        return place_for<B, ViewportRounding::scaled>(rules.point_snap);
    case ViewportRounding::separate:
        break;
    }
    return place_for<B, ViewportRounding::separate>(rules.point_snap);
}

/// Exact points are placed by the pass itself, whatever the rules.
template <> Place<PortableBlocks> place_for<PortableBlocks>(const RasterRules& /*rules*/) {
    return place<PortableBlocks, ViewportRounding::separate, SnapRounding::half_away>;
}

/// Each slice of the particles draws into keys of its own; the least key of a texel is the same however many slices
/// there are. Keys are 8 bytes a texel and slice, hence not more than a few.
constexpr int most_slices = 8;

template <class B> void rasterise(const B& fp, const std::vector<glm::vec3>& positions,
                                  const std::vector<glm::vec3>& stored, const FrameParams& params,
                                  const Profile& profile, CollisionImage& cdt, DepthImage& depth,
                                  DrawingScratch& scratch, std::span<std::int32_t> texels_of_points) {
    const Place<B> place_block = place_for<B>(profile.raster);
    const CollisionCode code(params);
    const std::size_t texels = cdt.texels.size();
    const int slices = std::min(omp_get_max_threads(), most_slices);
    const std::size_t needed = texels * static_cast<std::size_t>(slices);
    if (scratch.size < needed)
        scratch = {std::make_unique_for_overwrite<DrawingKey[]>(needed), needed};
    DrawingKey* const keys = scratch.keys.get();
    const auto start = [&](int slice) { return positions.size() * slice / slices; };
#pragma omp parallel
    {
        const FlushSubnormals guard = flush_in_step(params.switches, profile);
#pragma omp for schedule(static, 1)
        for (int slice = 0; slice < slices; ++slice) {
            DrawingKey* const drawn = &keys[texels * static_cast<std::size_t>(slice)];
            std::fill_n(drawn, texels, undrawn);
            Points points;
            const std::size_t last = start(slice + 1);
            for (std::size_t first = start(slice); first < last; first += block_size) {
                const std::size_t count = std::min(block_size, last - first);
                place_block(fp, std::span(positions).subspan(first, count), params, profile.raster, points);
                if (!texels_of_points.empty())
                    std::copy_n(points.texel.data(), count, &texels_of_points[first]);
                for (std::size_t i = 0; i < count; ++i)
                    if (points.texel[i] >= 0)
                        drawn[points.texel[i]] =
                            std::min(drawn[points.texel[i]], drawing_key(points.depth[i], first + i));
            }
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

/// Calls `pass` with the block arithmetic of points, which have no sums of a length.
template <class Pass> bool with_point_arithmetic(const Profile& profile, const Switches& switches, Pass&& pass) {
    using Sums = OneOrder<DotOrder::left_to_right>;
    const bool asks_tables = profile.roots != nullptr && switches.arithmetic != ArithmeticSwitch::exact;
    const auto tables = asks_tables ? packed_roots(profile.roots) : nullptr;
    if (switches.arithmetic == ArithmeticSwitch::exact)
        pass(PortableBlocks());
    else if (!asks_tables)
        pass(RoundedBlocks(Sums()));
    else if (tables != nullptr)
        pass(TableBlocks(Sums(), *tables));
    return !asks_tables || tables != nullptr;
}

} // namespace

void draw_particles_fast(const Particles& before, const Particles& after, const FrameParams& params,
                         const Profile& profile, CollisionImage& cdt, DepthImage& depth, DrawingScratch& scratch,
                         std::span<std::int32_t> texels) {
    const auto& positions =
        params.switches.raster_position == RasterPosition::updated ? after.position : before.position;
    if (with_point_arithmetic(profile, params.switches, [&](const auto& fp) {
            rasterise(fp, positions, after.position, params, profile, cdt, depth, scratch, texels);
        }))
        return;
    rasterise_particles(before, after, params, profile, cdt, depth);
    if (!texels.empty())
        point_texels_fast(positions, params, profile, texels);
}

void rasterise_particles_fast(const Particles& before, const Particles& after, const FrameParams& params,
                              const Profile& profile, CollisionImage& cdt, DepthImage& depth) {
    DrawingScratch scratch;
    draw_particles_fast(before, after, params, profile, cdt, depth, scratch, {});
}

void point_texels_fast(std::span<const glm::vec3> positions, const FrameParams& params, const Profile& profile,
                       std::span<std::int32_t> texels) {
    const auto count = static_cast<std::ptrdiff_t>(positions.size());
    const auto find = [&]<class B>(const B& fp) {
        const Place<B> place_block = place_for<B>(profile.raster);
#pragma omp parallel
        {
            const FlushSubnormals guard = flush_in_step(params.switches, profile);
            Points points;
#pragma omp for schedule(static)
            for (std::ptrdiff_t first = 0; first < count; first += block_size) {
                const auto at = static_cast<std::size_t>(first);
                const std::size_t some = std::min(block_size, positions.size() - at);
                place_block(fp, positions.subspan(at, some), params, profile.raster, points);
                std::copy_n(points.texel.data(), some, &texels[at]);
            }
        }
    };
    if (with_point_arithmetic(profile, params.switches, find))
        return;
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        const PointFragment point = point_fragment(positions[static_cast<std::size_t>(i)], params, profile);
        texels[static_cast<std::size_t>(i)] = point.x < 0 ? no_texel : point.y * params.width + point.x;
    }
}

} // namespace lockstep
