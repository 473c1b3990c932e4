#include "gpu/lights/passes.hpp"

#include <cmath>

#include <glm/vec3.hpp>

#include "gpu/encode_pass.hpp"
#include "gpu/gl_pass_list.hpp"
#include "reference/model/lights/schema.hpp"

namespace lockstep::lights {
namespace {

/// All that any pass is handed; each takes what it has.
Uniforms uniforms(const Host& host) {
    const Settings& s = host.settings();
    const Grid& grid = s.grid;
    return {{"u_GridOrigin", grid.origin},
            {"u_GridEnd", host.end()},
            {"u_VoxelSize", grid.voxel},
            {"u_InvVoxelSize", host.inv_voxel()},
            {"u_VoxelOffset", host.point_offset()},
            {"u_GridSize", grid.size},
            {"u_LightCount", static_cast<unsigned>(s.lights.size())},
            {"u_Reach", host.reach()},
            {"u_Tick", s.tick},
            {"u_FixedBits", host.fixed_bits()},
            {"u_FixedScale", std::ldexp(1.0F, host.fixed_bits())},
            {"u_ProjView", host.view_projection()},
            {"u_ClientWidth", s.width},
            {"u_ClientHeight", s.height},
            {"u_Eye", s.camera.eye},
            {"u_Ambient", s.ambient},
            {"u_Background", s.background},
            {"u_DiscScale", host.disc_scale()},
            {"u_GlowGain", s.glow_gain}};
}

/// What shades by the texture unit's own filter.
void filter(const Switches& on, GlPass& pass) {
    if (on.interpolation != Interpolation::trilinear_hw)
        return;
    const GlFilter how = on.outside == Outside::black ? GlFilter::linear_in_black : GlFilter::linear;
    pass.filters = {{colour_image, how}, {direction_image, how}};
}

void add_scatter(const HostPtr& host, GlPassList& all) {
    all.add("light_volume_clear", Stage::compute, accumulator_image).writes_words = true;
    GlPass& scatter = all.add("light_volume_scatter", Stage::compute, accumulator_image);
    scatter.invocations = [count = host->settings().lights.size()](int) { return count; };
    scatter.writes_words = host->switches().accumulate != Accumulate::float_atomic;
    all.add("light_volume_resolve", Stage::compute, colour_image);
    all.add_second("light_volume_resolve_direction", Stage::compute, direction_image);
}

void add_gather(const HostPtr& host, GlPassList& all) {
    GlPass& sort = all.add("light_sort_pass", Stage::compute, cell_buffer);
    const glm::ivec3 size = host->grid().size;
    sort.invocations = [rows = static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z)](int) {
        return rows;
    };
    all.add_second("light_sort_pass_lights", Stage::compute, sorted_buffer);
    all.add("light_volume_gather", Stage::compute, colour_image);
    all.add_second("light_volume_gather_direction", Stage::compute, direction_image);
}

void add_blend(const HostPtr& host, GlPassList& all) {
    const auto side = static_cast<std::size_t>(2 * host->reach() + 1);
    all.add("light_volume_blend", Stage::vertex, colour_image).draw = GlDraw{
        .buffer = light_buffer, .blend = GlDraw::Blend::added, .has_geometry = true, .instances = side * side * side};
    all.add_second("light_volume_blend_direction", Stage::vertex, direction_image);
}

void add_surfaces(const HostPtr& host, GlPassList& all) {
    const Settings& s = host->settings();
    const glm::vec4 nothing(0.0F), far(1.0F);
    GlDraw draw{
        .buffer = corner_buffer, .primitive = GlDraw::Primitive::triangles, .has_depth = true, .has_geometry = true};
    if (s.switches.pipeline == Pipeline::forward) {
        draw.cleared_to = {glm::vec4(s.background, 1.0F), far};
        GlPass& forward = all.add("forward_light_pass", Stage::vertex, lit_image);
        forward.draw = draw;
        filter(s.switches, forward);
        all.add_second("forward_light_pass_depth", Stage::vertex, depth_image);
        return;
    }
    draw.cleared_to = {nothing, nothing, nothing, far};
    all.add("gbuffer_pass", Stage::vertex, position_image).draw = draw;
    all.add_second("gbuffer_pass_normal", Stage::vertex, normal_image);
    all.add_second("gbuffer_pass_albedo", Stage::vertex, albedo_image);
    all.add_second("gbuffer_pass_depth", Stage::vertex, depth_image);
    filter(s.switches, all.add("deferred_light_pass", Stage::compute, lit_image));
}

std::size_t voxels_reached(const Host& host, const Light& light) {
    const Grid& grid = host.grid();
    std::size_t count = 0;
    for (int z = 0; z < grid.size.z; ++z)
        for (int y = 0; y < grid.size.y; ++y) {
            const glm::vec3 row = grid.origin + (glm::vec3(0, y, z) + host.point_offset()) * grid.voxel;
            const glm::vec3 away = light.position - row;
            const float left = light.range * light.range - away.y * away.y - away.z * away.z;
            if (left < 0.0F)
                continue;
            const float half = std::sqrt(left), last = static_cast<float>(grid.size.x - 1);
            const float low = std::fmax(std::ceil((away.x - half) * host.inv_voxel()), 0.0F),
                        high = std::fmin(std::floor((away.x + half) * host.inv_voxel()), last);
            count += low <= high ? static_cast<std::size_t>(high - low) + 1 : 0;
        }
    return count;
}

/// The mean of at most some thousand of the lights.
std::size_t voxels_each(const Host& host) {
    const std::vector<Light>& lights = host.settings().lights;
    const std::size_t step = lights.size() / 2048 + 1;
    std::size_t sum = 0, looked_at = 0;
    for (std::size_t i = 0; i < lights.size(); i += step, ++looked_at)
        sum += voxels_reached(host, lights[i]);
    return looked_at == 0 ? 0 : (sum + looked_at / 2) / looked_at;
}

} // namespace

AtomicsAlone atomics_alone(const HostPtr& host) {
    const Accumulate how = host->switches().accumulate;
    if (how != Accumulate::fixed64 && how != Accumulate::fixed32)
        return {};
    const std::size_t each = voxels_each(*host);
    const int words = how == Accumulate::fixed64 ? 15 : 8;
    GlPassList all({}, [host, each, words](int) {
        return Uniforms{{"u_GridSize", host->grid().size},
                        {"u_LightCount", static_cast<unsigned>(host->settings().lights.size())},
                        {"u_VoxelsEach", static_cast<unsigned>(each)},
                        {"u_WordCount", words}};
    });
    for (const char* name : {"atomics_at_random", "atomics_in_one_voxel"}) {
        GlPass& pass = all.add(name, Stage::compute, accumulator_image);
        pass.invocations = [count = host->settings().lights.size()](int) { return count; };
        pass.writes_words = true;
    }
    return {all.take(), each, words};
}

std::vector<GlPass> passes(const HostPtr& host) {
    const Switches& on = host->switches();
    GlPassList all(switch_defines(on), [host](int) { return uniforms(*host); });
    all.add("light_step_pass", Stage::compute, light_buffer);
    if (scatters(on.accumulate))
        add_scatter(host, all);
    else if (blends(on.accumulate))
        add_blend(host, all);
    else
        add_gather(host, all);
    add_surfaces(host, all);
    if (on.glow == OffOn::on)
        all.add("glow_pass", Stage::vertex, lit_image).draw = GlDraw{.buffer = light_buffer,
                                                                     .primitive = GlDraw::Primitive::triangles,
                                                                     .blend = GlDraw::Blend::added,
                                                                     .clears = false,
                                                                     .vertices = 6};
    add_encode_pass(on.encoding, encoded_image, light_buffer, all);
    return all.take();
}

} // namespace lockstep::lights
