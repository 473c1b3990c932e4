#include "gpu/collision/collision_pass.hpp"

#include <array>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/collision/host_depth.hpp"
#include "gpu/collision/step_uniforms.hpp"
#include "gpu/shader_source.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

Program link(const Switches& switches, const std::filesystem::path& shaders, const ClipDepth& depth) {
    ShaderDefines defines = switch_defines(switches);
    for (const auto& define : clip_depth_defines(depth))
        defines.push_back(define);
    const std::array stages{Stage::vertex, Stage::geometry, Stage::fragment};
    const std::vector<ShaderSource> sources =
        load_stages(collision_shaders(shaders), "collision_pass", stages, defines);
    Program program("collision_pass", sources, particle_records().captures());
    check_nothing_lost(sources, particle_records().captures());
    return program;
}

} // namespace

void set_collision_uniforms(const Program& program, const FrameParams& params) {
    set_search_uniforms(program, params);
    set_step_uniforms(program, params);
    program.set_unit("u_CDTexture", 0);
}

CollisionPass::CollisionPass(const Switches& switches, const std::filesystem::path& shaders, const ClipDepth& depth)
    : program_(link(switches, shaders, depth)) {}

void CollisionPass::run(const FrameParams& params, const ParticleBuffer& from, ParticleBuffer& to,
                        const CollisionTexture& cdt, CollisionTexture& target) {
    set_collision_uniforms(program_, params);
    cdt.bind_texture(0);
    target.bind_target();
    const HostDepth host(params.clip_depth);
    const GlVertexArray vertices = vertex_array(from, program_);
    program_.check_interface();
    gl::BindVertexArray(vertices.id());
    to.bind_capture();
    gl::BeginQuery(GL_PRIMITIVES_GENERATED, emitted_.id());
    gl::BeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, written_.id());
    gl::BeginTransformFeedback(GL_POINTS);
    gl::DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(from.size()));
    gl::EndTransformFeedback();
    gl::EndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    gl::EndQuery(GL_PRIMITIVES_GENERATED);
    gl::UseProgram(0);
    check_gl("collision_pass");
}

void CollisionPass::verify_written(std::size_t expected) const {
    GLuint emitted = 0;
    GLuint written = 0;
    gl::GetQueryObjectuiv(emitted_.id(), GL_QUERY_RESULT, &emitted);
    gl::GetQueryObjectuiv(written_.id(), GL_QUERY_RESULT, &written);
    if (emitted != expected)
        throw Error(fmt::format("collision_pass: the shaders emitted {} points for {} particles; the last "
                                "vertex-processing stage must emit exactly one point a particle",
                                emitted, expected));
    if (written != expected)
        throw Error(fmt::format("collision_pass: transform feedback wrote {} of {} particles", written, expected));
}

} // namespace lockstep
