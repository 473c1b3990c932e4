#include "gpu/collision/compute_collision_pass.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "gpu/collision/collision_pass.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/collision/particle_groups.hpp"
#include "gpu/collision/step_uniforms.hpp"
#include "gpu/shader_source.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

void check_room(const Scene& scene) {
    if (!gl::offers(4, 3))
        throw Error("collision_pass: step = compute needs compute shaders and storage buffers, GL 4.3; this context is "
                    "of an earlier version; --set step=transform_feedback needs none");
    GLint64 largest = 0;
    gl::GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
    const auto needed = static_cast<GLint64>(scene.start.size() * particle_records().bytes());
    if (needed > largest)
        throw Error(
            fmt::format("collision_pass: {} particles need a storage buffer of {} bytes; this context allows {}",
                        scene.start.size(), needed, largest));
}

Program link_compute(const Scene& scene, const std::filesystem::path& shaders, const std::string& name) {
    check_room(scene);
    ShaderDefines defines = switch_defines(scene.switches);
    if (gl::has_extension("GL_NV_shader_atomic_int64") && gl::has_extension("GL_ARB_gpu_shader_int64"))
        defines.emplace_back("LOCKSTEP_INT64_ATOMICS", "1");
    const std::array stages{Stage::compute};
    return {name, load_stages(collision_shaders(shaders), name, stages, defines)};
}

Program link_draw(const Scene& scene, const std::filesystem::path& shaders) {
    const std::array stages{Stage::vertex, Stage::fragment};
    constexpr std::array<std::string_view, 2> buffers{"After", "Nearest"};
    return {"collision_texels",
            load_stages(collision_shaders(shaders), "collision_texels", stages, switch_defines(scene.switches)),
            {},
            buffers};
}

void dispatch(const Program& program, std::size_t invocations, std::size_t group) {
    dispatch_particles(program, invocations, group);
    gl::MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

} // namespace

BoundStorage bind_particles(const Program& program) {
    static const std::array<std::string, 4> ours{"Before", "After", "Nearest", "Offers"};
    return bind_storage(program, ours, trace_binding + 1, {"Before", "After", &particle_records()});
}

ComputeCollisionPass::ComputeCollisionPass(const Scene& scene, const std::filesystem::path& shaders)
    : clear_(link_compute(scene, shaders, "clear_nearest")), step_(link_compute(scene, shaders, "collision_pass")),
      nearest_(link_compute(scene, shaders, "nearest_particle")), draw_(link_draw(scene, shaders)),
      bound_(bind_particles(step_.program)), nearest_bound_(bind_particles(nearest_.program)),
      texels_(static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height)),
      clear_group_(group_size(clear_.program, texels_)), step_group_(group_size(step_.program, scene.start.size())),
      nearest_group_(group_size(nearest_.program, scene.start.size())),
      has_offers_(step_.program.uses_storage(offers_binding)) {
    if (bound_.only_reads() && !step_.program.uses_storage(after_binding))
        throw Error(fmt::format("{}: /storage_blocks: no block has the state after the pass; right is After, or its "
                                "fields by member, After.position, ...",
                                step_.program.bindings()->file));
    step_.ends_with_last = lengths_asked(step_.program, trace_binding); // at the points that were given
    nearest_.ends_with_last = lengths_asked(nearest_.program, trace_binding);
    constexpr std::size_t pair = 2 * sizeof(GLuint);
    nearest_particles_.allocate({"Nearest", "texel", texels_, pair, {}}, largest_group(), nullptr, GL_DYNAMIC_COPY);
    if (has_offers_)
        offers_.allocate({"Offers", "particle", scene.start.size(), pair, {}}, largest_group(), nullptr,
                         GL_DYNAMIC_COPY);
    check_gl("collision_pass");
}

void ComputeCollisionPass::run(const FrameParams& params, const ParticleBuffer& from, ParticleBuffer& to,
                               const CollisionTexture& cdt, CollisionTexture& target, PassTimer& timer) {
    const std::vector<StorageRange> all = ranges(from, to);
    bind(clear_, all);
    clear_.program.check_interface();
    dispatch(clear_.program, texels_, clear_group_);
    check_stage(clear_, all);
    timer.mark("clear_nearest");
    step(params, from, to, cdt, timer);
    bind(draw_, all);
    draw(params, from.size(), target);
    check_stage(draw_, all);
    timer.mark("collision_texels");
    gl::MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT |
                      GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    gl::UseProgram(0);
    check_gl("collision_pass");
}

std::vector<StorageRange> ComputeCollisionPass::ranges(const ParticleBuffer& from, const ParticleBuffer& to) const {
    std::vector<StorageRange> all{from.range("Before"), to.range("After"), nearest_particles_.range()};
    if (has_offers_)
        all.push_back(offers_.range());
    return all;
}

void ComputeCollisionPass::bind(const Linked& stage, const std::vector<StorageRange>& all) const {
    for (GLuint point = 0; point < static_cast<GLuint>(all.size()); ++point)
        all[point].bind(point, stage.ends_with_last[point]);
    if (!has_offers_)
        gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, offers_binding, 0);
}

void ComputeCollisionPass::check_stage(const Linked& stage, const std::vector<StorageRange>& all) const {
    if (!checks_each_)
        return;
    gl::MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    for (const StorageRange& range : all)
        check_margin(stage.program, range);
}

void ComputeCollisionPass::check_ends(const FrameParams& params, const ParticleBuffer& from, ParticleBuffer& to,
                                      const CollisionTexture& cdt, CollisionTexture& target) {
    const std::vector<StorageRange> all = ranges(from, to);
    if (std::none_of(all.begin(), all.end(), [](const StorageRange& one) { return first_written(one.margin); }))
        return;
    for (const StorageRange& range : all)
        lay(range.margin);
    checks_each_ = true; // once more, to say which of them it is
    PassTimer timer;
    run(params, from, to, cdt, target, timer);
    throw Error("collision_pass: a stage wrote past the end of a storage buffer, and not when it ran again");
}

void ComputeCollisionPass::step(const FrameParams& params, const ParticleBuffer& from, const ParticleBuffer& to,
                                const CollisionTexture& cdt, PassTimer& timer) {
    step_.program.set("u_ParticleCount", static_cast<unsigned>(from.size()));
    set_collision_uniforms(step_.program, params);
    step_.program.check_interface();
    cdt.bind_texture(0);
    const std::vector<StorageRange> all = ranges(from, to);
    bind(step_, all);
    const RecordBuffer* const before[] = {&from};
    const RecordBuffer* const after[] = {&to};
    bound_.fill(before, after);
    dispatch(step_.program, from.size(), step_group_);
    bound_.collect(after);
    check_stage(step_, all);
    timer.mark("collision_pass");
    if (!has_offers_)
        return;
    nearest_.program.set("u_ParticleCount", static_cast<unsigned>(from.size()));
    nearest_.program.check_interface();
    bind(nearest_, all);
    nearest_bound_.fill(before, after);
    dispatch(nearest_.program, from.size(), nearest_group_);
    nearest_bound_.collect(after);
    check_stage(nearest_, all);
    timer.mark("nearest_particle");
}

void ComputeCollisionPass::draw(const FrameParams& params, std::size_t particles, CollisionTexture& target) {
    draw_.program.set("u_ParticleCount", static_cast<unsigned>(particles));
    draw_.program.set("u_ClientWidth", params.width);
    draw_.program.set("u_ClientHeight", params.height);
    set_collision_code(draw_.program, params);
    draw_.program.check_interface();
    target.bind_target();
    gl::Enable(GL_DEPTH_TEST);
    gl::DepthFunc(GL_LESS);
    gl::BindVertexArray(no_attributes_.id());
    gl::DrawArrays(GL_TRIANGLES, 0, 3);
}

} // namespace lockstep
