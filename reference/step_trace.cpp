#include "reference/step_trace.hpp"

#include <cmath>

#include "reference/deviating_pass.hpp"
#include "reference/subnormals.hpp"
#include "reference/texel_lookup.hpp"
#include "reference/window.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

constexpr glm::vec4 nowhere{0.0F, 0.0F, 2.0F, 1.0F};

glm::vec4 texel_centre(glm::vec4 clip, const FrameParams& params) {
    const auto texel = TexelLookup(Portable(), params)(clip);
    const float depth = (Portable::divide(clip.z, clip.w) + 1.0F) * 0.5F;
    if (!texel.inside || !(clip.w > 0.0F) || !(depth >= 0.0F) || !(depth <= 1.0F))
        return nowhere;
    const auto centre = [](std::int32_t index, int size) {
        return static_cast<float>(2 * index + 1) * Portable::divide(1.0F, static_cast<float>(size)) - 1.0F;
    };
    const float on_grid = std::floor(depth * 0x1p24F) * 0x1p-24F;
    return {centre(texel.x, params.width), centre(texel.y, params.height), 2.0F * on_grid - 1.0F, 1.0F};
}

} // namespace

glm::vec4 point_position(glm::vec4 clip, const FrameParams& params) {
    const glm::vec4 placed = params.switches.arithmetic == ArithmeticSwitch::exact ? texel_centre(clip, params) : clip;
    return in_clip_volume(placed) ? placed : nowhere;
}

PointWindow point_window(glm::vec4 point_position, const FrameParams& params, const RasterRules& rules) {
    if (!in_clip_volume(point_position))
        return {};
    const WindowPosition window = window_position(point_position, params.width, params.height, rules);
    return {{window.x, window.y, window.z}, {snap_point(window.x, rules), snap_point(window.y, rules)}};
}

PointFragment drawn_point(glm::vec4 point_position, const FrameParams& params, const RasterRules& rules) {
    if (!in_clip_volume(point_position))
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
    Particles one;
    one.resize(1);
    one.set(0, before);
    StepTrace trace;
    trace.after = deviating_step({.before = &one, .cdt = &cdt, .params = &params}, 0, profile, {}, &trace);
    const glm::vec3 drawn =
        params.switches.raster_position == RasterPosition::updated ? trace.after.position : before.position;
    const FlushSubnormals guard(profile.flush_subnormals);
    trace.raster_clip = with_arithmetic(profile, params.switches,
                                        [&](auto fp) { return fp.transform(params.collision_proj_view, drawn); });
    trace.point_position = point_position(trace.raster_clip, params);
    trace.window = point_window(trace.point_position, params, profile.raster);
    trace.fragment = point_fragment(drawn, params, profile);
    return trace;
}

} // namespace lockstep
