#include "gpu/lifecycle/passes.hpp"

#include <algorithm>
#include <bit>
#include <initializer_list>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <glm/vec2.hpp>

#include "gpu/lifecycle/graphs.hpp"
#include "reference/model/lifecycle/schema.hpp"
#include "reference/model/lifecycle/sort_steps.hpp"

namespace lockstep::lifecycle {
namespace {

std::vector<float> floats_of(const std::vector<HostForce>& forces) {
    std::vector<float> all;
    for (const HostForce& f : forces)
        all.insert(all.end(),
                   {static_cast<float>(f.kind), f.centre.x, f.centre.y, f.centre.z, f.axis.x, f.axis.y, f.axis.z,
                    f.strength, f.radius, f.falloff, f.pull, f.square, f.drag, f.seed, 0.0F, 0.0F});
    return all;
}

/// All that any kernel is handed; each takes what it has.
Uniforms uniforms(const Host& host, const HostEmitter& of, int frame) {
    const Emitter& e = of.settings();
    const Settings& s = host.settings();
    Uniforms all{{"u_Emitter", static_cast<unsigned>(of.number)},
                 {"u_Base", static_cast<unsigned>(of.base)},
                 {"u_Capacity", static_cast<unsigned>(e.capacity)},
                 {"u_FirstBlock", static_cast<unsigned>(of.first_block)},
                 {"u_FirstInRing", static_cast<unsigned>(of.first_in_ring)},
                 {"u_Window", static_cast<unsigned>(of.window)},
                 {"u_FirstKey", static_cast<unsigned>(of.first_key)},
                 {"u_Keys", static_cast<unsigned>(of.keys)},
                 {"u_Request", static_cast<unsigned>(of.request(frame))},
                 {"u_Frame", static_cast<unsigned>(frame)},
                 {"u_Corners", static_cast<unsigned>(host.sprite_corners().size())},
                 {"u_View", view_matrix(s.camera)},
                 {"u_UvScale", e.uv_scale},
                 {"u_Seed", of.seed},
                 {"u_Tick", s.tick},
                 {"u_HalfTickSquared", host.half_tick_squared()},
                 {"u_Time", host.time(frame)},
                 {"u_BoxLow", s.box_low},
                 {"u_BoxScale", host.box_scale()},
                 {"u_BoxStep", host.box_step()},
                 {"u_ShapeLow", e.min},
                 {"u_ShapeSize", e.max - e.min},
                 {"u_Radius", e.radius},
                 {"u_Origin", of.origin(frame)},
                 {"u_LastOrigin", of.origin(frame - 1)},
                 {"u_OriginVelocity", of.origin_velocity(frame)},
                 {"u_Direction", of.basis.ahead},
                 {"u_Side", of.basis.side},
                 {"u_Up", of.basis.up},
                 {"u_Jitter", e.direction_jitter},
                 {"u_Speed", e.speed},
                 {"u_SpeedJitter", e.speed_jitter},
                 {"u_ConeDepth", of.cone_depth},
                 {"u_Acceleration", e.acceleration},
                 {"u_Lifetime", glm::vec2(e.lifetime[0], e.lifetime[1])},
                 {"u_Sizes", glm::vec2(e.size[0], e.size[1])},
                 {"u_Color", e.color[0]},
                 {"u_EndColor", e.color[1]},
                 {"u_ForceCount", static_cast<int>(e.forces.size())}};
    add_stage_parameters(all, e);
    return all;
}

void add(ShaderDefines& all, std::string_view name, std::initializer_list<std::string_view> values,
         std::size_t chosen) {
    const std::vector<std::string_view> names(values);
    const ShaderDefines one = choice_defines(name, names, chosen);
    all.insert(all.end(), one.begin(), one.end());
}

ShaderDefines defines(const Host& host, const HostEmitter& of) {
    ShaderDefines all = switch_defines(host.switches());
    add(all, "shape", {"point", "box", "sphere"}, static_cast<std::size_t>(of.settings().shape));
    add(all, "dies", {"window", "none", "all"}, static_cast<std::size_t>(of.dies));
    add(all, "uv", {"segment", "stretched", "distance"}, static_cast<std::size_t>(of.settings().uv));
    all.emplace_back("RIBBON", of.settings().draw == Emitter::Draw::ribbon ? "1" : "0");
    all.emplace_back("CONE", of.settings().cone >= 0.0F ? "1" : "0");
    return all;
}

/// The kernels of an emitter.
class Kernels {
  public:
    Kernels(std::vector<GlPass>& all, const HostPtr& host, const HostEmitter& of) : all_(all), host_(host), of_(of) {}

    /// What a dispatch writes besides its first buffer: the name of the pass, and the buffer.
    using Besides = std::pair<std::string_view, std::uint8_t>;

    GlPass& add(std::string name, std::uint8_t resource, const std::vector<Besides>& besides) {
        GlPass pass{.name = std::move(name), .stage = Stage::compute, .resource = resource};
        pass.uniforms = [host = host_, of = &of_](int frame) { return uniforms(*host, *of, frame); };
        pass.defines = defines(*host_, of_);
        pass.texts = stage_texts(of_.settings());
        const std::size_t at = all_.size();
        all_.push_back(std::move(pass));
        for (const auto& [what, other] : besides)
            all_.push_back({.name = std::string(what), .stage = Stage::compute, .resource = other, .continues = true});
        return all_[at];
    }
    void one(const std::string& name, std::uint8_t resource, const std::vector<Besides>& besides) {
        add(name, resource, besides).invocations = [](int) { return std::size_t{1}; };
    }
    void many(const std::string& name, std::uint8_t argument, std::uint8_t resource,
              const std::vector<Besides>& besides, bool with_forces = false) {
        GlPass& pass = add(name, resource, besides);
        pass.indirect = GroupCounts{{argument_buffer, argument}, of_.number};
        if (with_forces)
            pass.data["Forces"] = [host = host_, of = &of_](int frame) { return floats_of(of->forces(frame)); };
    }

    void emit() {
        std::vector<Besides> besides;
        if (host_->lists())
            besides.push_back({"emit_list", survivor_buffer});
        besides.push_back({"emit_counters", counter_buffer});
        if (host_->switches().emit_when == EmitWhen::before_destroy)
            besides.push_back({"emit_arguments", argument_buffer});
        GlPass& pass = add("emit", particle_buffer, besides);
        pass.invocations = [of = &of_](int frame) { return std::max<std::size_t>(of->request(frame), 1); };
    }
    void destroy() {
        std::vector<Besides> besides;
        if (host_->switches().compaction == Compaction::atomic)
            besides.push_back({"destroy_count", counter_buffer});
        if (host_->lists())
            besides.push_back({"destroy_dead", dead_buffer});
        if (host_->switches().compaction == Compaction::atomic)
            return many("destroy", argument::destroy, survivor_buffer, besides);
        many("destroy_reduce", argument::destroy, sum_buffer, {});
        add("destroy_scan", counter_buffer, {{"destroy_scan_sums", sum_buffer}}).invocations = [](int) {
            return std::size_t{256};
        };
        many("destroy", argument::destroy, survivor_buffer, besides);
    }
    /// The points of a ribbon, by their times of birth.
    void sort() {
        add("pre_sort", key_buffer, {}).invocations = [of = &of_](int) { return of->keys; };
        for_each_sort_step(of_.keys, [&](std::uint32_t run, std::uint32_t apart) {
            GlPass& pass = add("sort", key_buffer, {});
            pass.invocations = [of = &of_](int) { return of->keys / 2; };
            pass.uniforms = [host = host_, of = &of_, run, apart](int frame) {
                Uniforms all = uniforms(*host, *of, frame);
                all["u_Run"] = run;
                all["u_Apart"] = apart;
                return all;
            };
        });
    }
    void ribbon() {
        if (host_->lists())
            sort();
        many("ribbon_distance", argument::ribbon, particle_buffer, {});
        many("prefix_reduce", argument::ribbon, length_buffer, {{"prefix_reduce_sums", block_length_buffer}});
        add("prefix_scan", block_length_buffer, {}).invocations = [](int) { return std::size_t{256}; };
        many("prefix_sum", argument::ribbon, length_buffer, {{"prefix_sum_particles", particle_buffer}});
        many("ribbon", argument::ribbon, point_buffer, {});
    }
    void simulating(const std::string& name, std::uint8_t argument, bool simulates) {
        if (simulates && counts_in_simulation(*host_, of_))
            many(name, argument, counter_buffer, {{name + "_particles", particle_buffer}}, true);
        else
            many(name, argument, particle_buffer, {}, true);
    }

  private:
    std::vector<GlPass>& all_;
    const HostPtr& host_;
    const HostEmitter& of_;
};

/// The corners of a polygon, bit by bit.
std::string polygon_text(const std::vector<glm::vec2>& corners) {
    std::string all;
    for (const glm::vec2 c : corners.empty() ? std::vector{glm::vec2(0.0F)} : corners)
        all += fmt::format("{}vec2(uintBitsToFloat(0x{:08x}u), uintBitsToFloat(0x{:08x}u))", all.empty() ? "" : ", ",
                           std::bit_cast<unsigned>(c.x), std::bit_cast<unsigned>(c.y));
    const std::size_t count = std::max<std::size_t>(corners.size(), 1);
    return fmt::format("#define POLYGON 1\nvec2 corner_of_sprite(int corner) {{\n    vec2 all[{0}] = vec2[{0}]({1});\n"
                       "    return all[min(corner, {2})];\n}}\n",
                       count, all, count - 1);
}

} // namespace

std::vector<GlPass> passes(const HostPtr& host) {
    std::vector<GlPass> all;
    const Switches& s = host->switches();
    const bool before = s.emit_when == EmitWhen::before_destroy;
    for (const HostEmitter& of : host->emitters()) {
        Kernels kernels(all, host, of);
        if (before)
            kernels.emit();
        if (host->lists())
            kernels.simulating("simulate", argument::move, true);
        kernels.destroy();
        if (!host->lists())
            kernels.simulating("move", argument::move, s.fuse == Fuse::fused);
        if (before)
            kernels.one("post_destroy", counter_buffer,
                        {{"post_destroy_ring", ring_buffer}, {"post_destroy_arguments", argument_buffer}});
        else
            kernels.one("post_destroy", counter_buffer, {{"post_destroy_arguments", argument_buffer}});
        if (!host->lists() && s.fuse == Fuse::split)
            kernels.simulating("simulate", argument::simulate, true);
        if (!before) {
            kernels.emit();
            kernels.one("post_emit", counter_buffer,
                        {{"post_emit_ring", ring_buffer}, {"post_emit_arguments", argument_buffer}});
        }
        if (of.settings().draw == Emitter::Draw::ribbon)
            kernels.ribbon();
        kernels.one("indirect", counter_buffer, {{"indirect_arguments", argument_buffer}});
    }
    return all;
}

GlPass draw_gl_pass(const HostPtr& host, const Drawing& drawing) {
    GlPass pass{.name = "draw", .stage = Stage::vertex, .resource = corner_buffer};
    pass.instances_of = quad_buffer;
    pass.defines = switch_defines(host->switches());
    pass.texts = rendering_texts(*host);
    const Sprite& sprite = host->settings().sprite;
    if (sprite.polygon != 0)
        pass.texts["polygon.glsl"] = polygon_text(host->sprite_corners());
    if (sprite.texture.width > 0) {
        pass.defines.emplace_back("TEXTURED", "1");
        add(pass.defines, "filter", {"nearest", "bilinear"}, static_cast<std::size_t>(sprite.filter));
    }
    const ShaderDefines looks = rendering_defines(*host);
    pass.defines.insert(pass.defines.end(), looks.begin(), looks.end());
    if (host->has_ribbons())
        pass.defines.emplace_back("SEGMENTS", "1");
    pass.uniforms = [host, drawing](int) {
        Uniforms all{{"u_View", drawing.view},
                     {"u_Projection", drawing.projection},
                     {"u_Frame", 0U},
                     {"u_Tick", host->settings().tick},
                     {"u_Time", drawing.time},
                     {"u_FirstQuad", 0U},
                     {"u_Blend", 0U},
                     {"u_AlphaCut", (static_cast<float>(host->settings().sprite.alpha_cut) + 0.5F) / 255.0F},
                     {"u_BoxLow", host->settings().box_low},
                     {"u_BoxScale", host->box_scale()},
                     {"u_BoxStep", host->box_step()}};
        add_rendering_parameters(all, *host);
        return all;
    };
    return pass;
}

} // namespace lockstep::lifecycle
