#include "reference/collision/step_trace.hpp"

#include <array>
#include <cmath>

#include "reference/collision/collision_twin.hpp"
#include "reference/collision/step_stage.hpp"
#include "reference/collision/texel_lookup.hpp"
#include "reference/plain_arithmetic.hpp"
#include "reference/readings/recording.hpp"
#include "reference/window.hpp"

namespace lockstep {
namespace {

constexpr glm::vec4 nowhere{0.0F, 0.0F, 2.0F, 1.0F};

glm::vec4 texel_centre(glm::vec4 clip, const FrameParams& params) {
    const float w = params.switches.perspective_divide == PerspectiveDivide::on ? clip.w : 1.0F;
    const auto texel = TexelLookup(params)(Portable::divide(clip.x, w), Portable::divide(clip.y, w));
    const float ndc = Portable::divide(clip.z, clip.w);
    const bool from_zero = params.clip_depth.from_zero();
    const float depth = from_zero ? ndc : (ndc + 1.0F) * 0.5F;
    if (!texel.inside || !(clip.w > 0.0F) || !(depth >= 0.0F) || !(depth <= 1.0F))
        return nowhere;
    const auto centre = [](std::int32_t index, int size) {
        return static_cast<float>(2 * index + 1) * Portable::divide(1.0F, static_cast<float>(size)) - 1.0F;
    };
    const float on_grid = std::floor(depth * 0x1p24F) * 0x1p-24F;
    return {centre(texel.x, params.width), centre(texel.y, params.height), from_zero ? on_grid : 2.0F * on_grid - 1.0F,
            1.0F};
}

/// What the listing's sites came to, put where the table wants it.
void fill_in(StepTrace& trace, const RecordedRow& row, bool zero_is_hit) {
    using Kind = RecordedRow::Kind;
    const auto is = [&](const Site& site, Kind kind = Kind::value) { return row.site == &site && row.kind == kind; };
    const std::array<float, 4>& v = row.values;
    const glm::vec3 vector(v[0], v[1], v[2]);
    if (is(site::base_texel))
        trace.base = {static_cast<int>(v[0]), static_cast<int>(v[1])};
    else if (is(site::own_position))
        trace.own_position = vector;
    else if (is(site::neighbour, Kind::fetch))
        trace.neighbours.push_back(
            {.texel = {static_cast<int>(v[0]), static_cast<int>(v[1])}, .on_image = v[2] != 0.0F});
    if (trace.neighbours.empty())
        return;
    NeighbourTrace& neighbour = trace.neighbours.back();
    if (is(site::neighbour, Kind::texel)) {
        neighbour.stored = {v[0], v[1], v[2], v[3]};
    } else if (is(site::stored_position)) {
        neighbour.holds_particle = true;
        neighbour.position = vector;
    } else if (is(site::apart)) {
        neighbour.apart = vector;
    } else if (is(site::distance)) {
        neighbour.distance = v[0];
    } else if (is(site::nearest, Kind::offer)) {
        neighbour.compared = v[0] != 0.0F || zero_is_hit;
        neighbour.became_nearest = v[1] != 0.0F;
        if (neighbour.became_nearest)
            trace.nearest = trace.neighbours.size() - 1;
    }
}

} // namespace

glm::vec4 point_position(glm::vec4 clip, const FrameParams& params) {
    const glm::vec4 placed = params.switches.arithmetic == ArithmeticSwitch::exact ? texel_centre(clip, params) : clip;
    return in_clip_volume(placed, params.clip_depth) ? placed : nowhere;
}

PointWindow point_window(glm::vec4 point_position, const FrameParams& params, const RasterRules& rules) {
    if (!in_clip_volume(point_position, params.clip_depth))
        return {};
    const WindowPosition window =
        window_position(point_position, params.width, params.height, rules, params.clip_depth);
    return {{window.x, window.y, window.z}, {snap_point(window.x, rules), snap_point(window.y, rules)}};
}

PointFragment drawn_point(glm::vec4 point_position, const FrameParams& params, const RasterRules& rules) {
    if (!in_clip_volume(point_position, params.clip_depth))
        return {};
    const PointWindow window = point_window(point_position, params, rules);
    const int x = point_pixel(window.snapped.x, rules);
    const int y = point_pixel(window.snapped.y, rules);
    if (x < 0 || y < 0 || x >= params.width || y >= params.height)
        return {};
    return {x, y, window.position.z};
}

StepTrace trace_step(const ParticleState& before, const CollisionImage& cdt, const FrameParams& params,
                     const Profile& profile) {
    StepTrace trace;
    trace.before = before;
    const FlushSubnormals guard = flush_in_step(params.switches, profile);
    with_plain_arithmetic(profile, params.switches.arithmetic, [&]<class A>(A fp) {
        Recording<A> reading(fp);
        const auto v = CollisionTwin(reading, cdt, params)(before);
        trace.after = {floats(v.position), floats(v.direction), static_cast<float>(v.speed),
                       static_cast<float>(v.collide_time)};
        for (const RecordedRow& row : reading.rows())
            fill_in(trace, row, params.switches.zero_distance == ZeroDistance::hit);
    });
    trace.searches = trace.base.x >= 0;
    if (!trace.searches) // not asked for
        trace.base = base_texel(before.position, params, profile);
    const glm::vec3 drawn =
        params.switches.raster_position == RasterPosition::updated ? trace.after.position : before.position;
    trace.raster_clip = with_plain_arithmetic(profile, params.switches.arithmetic,
                                              [&](auto fp) { return fp.transform(params.collision_proj_view, drawn); });
    trace.point_position = point_position(trace.raster_clip, params);
    trace.window = point_window(trace.point_position, params, profile.raster);
    trace.fragment = point_fragment(drawn, params, profile);
    return trace;
}

} // namespace lockstep
