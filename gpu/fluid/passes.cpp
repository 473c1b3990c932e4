#include "gpu/fluid/passes.hpp"

#include <string_view>
#include <vector>

#include <glm/gtc/type_ptr.hpp>

#include "gpu/encode_pass.hpp"
#include "gpu/gl_pass_list.hpp"
#include "reference/model/fluid/schema.hpp"

namespace lockstep::fluid {
namespace {

/// All that any pass is handed; each takes what it has.
Uniforms uniforms(const Host& host) {
    const Settings& s = host.settings();
    return {{"mView", host.view()},
            {"projection", host.projection()},
            {"u_InverseView", host.inverse_view()},
            {"u_ProjView", host.view_projection()},
            {"u_Slope", host.slope()},
            {"u_DepthCoefficients", host.depth_coefficients()},
            {"u_Near", host.near_plane()},
            {"u_DepthScale", host.depth_scale()},
            {"u_DepthCodes", depth_codes},
            {"screenSize", host.screen_size()},
            {"u_ClientWidth", s.width},
            {"u_ClientHeight", s.height},
            {"pointRadius", s.radius},
            {"pointScale", host.point_scale()},
            {"u_ThicknessGain", host.thickness_gain()},
            {"filterRadius", s.filter_radius},
            {"blurScale", host.blur_scale()},
            {"u_RangeScale", host.range_scale()},
            {"u_NarrowScale", host.narrow_scale()},
            {"u_NarrowDelta", host.narrow_delta()},
            {"u_NarrowMu", host.narrow_mu()},
            {"u_FlowScale", host.flow_scale()},
            {"u_FlowStep", s.flow_step},
            {"u_FlowReach", host.flow_reach()},
            {"color", glm::make_vec4(fluid_colour.data())},
            {"u_ThicknessFloor", s.shading.thickness_floor},
            {"u_FresnelR0", s.shading.fresnel_r0},
            {"u_FresnelPower", s.shading.fresnel_power},
            {"u_SkyBias", s.shading.sky_bias},
            {"u_ParticleCount", static_cast<unsigned>(s.particles.size())}};
}

/// The same in every frame, with one of them replaced.
std::function<Uniforms(int)> uniforms_with(const HostPtr& host, std::string name, UniformValue value) {
    return [host, name = std::move(name), value = std::move(value)](int) {
        Uniforms all = uniforms(*host);
        all[name] = value;
        return all;
    };
}

void define_choice(GlPass& pass, std::string_view name, const std::vector<std::string_view>& values,
                   std::size_t chosen) {
    const ShaderDefines one = choice_defines(name, values, chosen);
    pass.defines.insert(pass.defines.end(), one.begin(), one.end());
}

/// Where a pass takes its depths from.
void read_depth(const Switches& on, bool of_spheres, GlPass& pass) {
    define_choice(pass, "source", {"depth", "smooth_depth"}, of_spheres ? 0 : 1);
    if (on.depth_fetch == DepthFetch::linear)
        pass.filters[of_spheres ? depth_image : smooth_depth_image] = GlFilter::linear;
}

GlDraw sprites(const Switches& on) {
    GlDraw draw{.buffer = particle_buffer};
    if (on.sprite == Sprite::points) {
        draw.sized = true;
    } else {
        draw.primitive = GlDraw::Primitive::triangles;
        draw.vertices = 6;
    }
    return draw;
}

void add_scene(GlPassList& all) {
    all.add("scene_pass", Stage::vertex, scene_image).draw =
        GlDraw{.buffer = corner_buffer,
               .primitive = GlDraw::Primitive::triangles,
               .has_depth = true,
               .cleared_to = {{scene_sky[0], scene_sky[1], scene_sky[2], 1.0F}, glm::vec4(1.0F)},
               .has_geometry = true};
    all.add_second("scene_pass_depth", Stage::vertex, scene_depth_image);
}

void add_spheres(const Switches& on, GlPassList& all) {
    GlDraw draw = sprites(on);
    draw.has_depth = true;
    draw.cleared_to = {glm::vec4(on.depth_value == DepthValue::view ? 0.0F : 1.0F)};
    all.add("sphere_depth_pass", Stage::vertex, depth_image).draw = draw;
}

void add_filter(const HostPtr& host, GlPassList& all) {
    for (const FilterStep& step : host->filter_steps()) {
        GlPass& pass = all.add("depth_filter_pass", Stage::compute, smooth_depth_image);
        pass.uniforms = uniforms_with(host, "blurDir", step.direction);
        define_choice(pass, "filter_step", {"along", "plane"}, static_cast<std::size_t>(step.shape));
        read_depth(host->switches(), step.of_spheres, pass);
        pass.data["weightBuffer"] = [host](int) {
            return std::vector<float>(host->weights().begin(), host->weights().end());
        };
    }
}

void add_thickness(const HostPtr& host, GlPassList& all) {
    const Switches& on = host->switches();
    const bool counts = on.thickness_sum == ThicknessSum::fixed;
    if (counts)
        all.add("thickness_clear_pass", Stage::compute, thickness_image);
    GlPass& pass = all.add("thickness_pass", counts ? Stage::compute : Stage::vertex, thickness_image);
    pass.uniforms = uniforms_with(host, "pointRadius", host->thickness_radius());
    if (counts) {
        pass.invocations = [count = host->settings().particles.size()](int) { return count; };
    } else {
        pass.draw = sprites(on);
        pass.draw->blend = GlDraw::Blend::added;
    }
}

} // namespace

std::vector<GlPass> passes(const HostPtr& host) {
    const Switches& on = host->switches();
    const bool filters = !host->filter_steps().empty();
    GlPassList all(switch_defines(on), [host](int) { return uniforms(*host); });
    if (host->moves())
        all.add("motion_pass", Stage::compute, particle_buffer).data["positionBuffer"] = [host](int frame) {
            return host->positions(frame);
        };
    add_scene(all);
    add_spheres(on, all);
    add_filter(host, all);
    read_depth(on, !filters, all.add("normal_pass", Stage::compute, normal_image));
    add_thickness(host, all);
    GlPass& shade = all.add("fluid_shade_pass", Stage::compute, lit_image);
    read_depth(on, !filters, shade);
    if (on.scene_fetch == SceneFetch::linear)
        shade.filters[scene_image] = GlFilter::linear;
    add_encode_pass(on.encoding, encoded_image, particle_buffer, all);
    return all.take();
}

} // namespace lockstep::fluid
