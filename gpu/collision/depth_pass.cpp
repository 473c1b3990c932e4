#include "gpu/collision/depth_pass.hpp"

#include <array>
#include <string>

#include "gpu/check.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/collision/particle_groups.hpp"
#include "gpu/collision/step_uniforms.hpp"
#include "gpu/shader_source.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr GLuint depth_before_binding = 0, depth_after_binding = 1;

Program link_depth(const Scene& scene, const std::filesystem::path& shaders) {
    if (!gl::offers(4, 3))
        throw Error("depth_pass: search = depth needs compute shaders and storage buffers, GL 4.3; this context is of "
                    "an earlier version");
    const std::array stages{Stage::compute};
    return {"depth_pass",
            load_stages(collision_shaders(shaders), "depth_pass", stages, switch_defines(scene.switches))};
}

BoundStorage bind_depth(const Program& program) {
    static const std::array<std::string, 2> ours{"Before", "After"};
    return bind_storage(program, ours, ours.size(), {"Before", "After", &particle_records()});
}

} // namespace

void set_depth_uniforms(const Program& program, const FrameParams& params) {
    set_step_uniforms(program, params);
    program.set("u_ProjView", params.earlier_proj_view);
    program.set("u_InverseProjView", params.earlier_inverse);
    program.set("u_SurfaceThickness", params.constants.surface_thickness);
    program.set("u_ClientWidth", params.width);
    program.set("u_ClientHeight", params.height);
    program.set_unit("u_Depth", 0, GL_SAMPLER_2D);
}

DepthPass::DepthPass(const Scene& scene, const std::filesystem::path& shaders)
    : program_(link_depth(scene, shaders)), bound_(bind_depth(program_)),
      group_(group_size(program_, scene.start.size())), ends_with_last_(lengths_asked(program_, 2)) {}

void DepthPass::check_ends(const ParticleBuffer& from, const ParticleBuffer& to) const {
    check_margin(program_, to.range("After"));
    check_margin(program_, from.range("Before"));
}

void DepthPass::run(const FrameParams& params, const ParticleBuffer& from, ParticleBuffer& to,
                    const CollisionTexture& depth) {
    program_.set("u_ParticleCount", static_cast<unsigned>(from.size()));
    set_depth_uniforms(program_, params);
    program_.check_interface();
    depth.bind_texture(0);
    from.range("Before").bind(depth_before_binding, ends_with_last_[depth_before_binding]);
    to.range("After").bind(depth_after_binding, ends_with_last_[depth_after_binding]);
    const RecordBuffer* const read[] = {&from};
    const RecordBuffer* const written[] = {&to};
    bound_.fill(read, written);
    dispatch_particles(program_, from.size(), group_);
    bound_.collect(written);
    gl::MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT |
                      GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    gl::UseProgram(0);
    check_gl("depth_pass");
}

} // namespace lockstep
