#include "gpu/collision/collision_pass.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/collision/host_depth.hpp"
#include "gpu/collision/step_uniforms.hpp"
#include "gpu/probe/points_alike.hpp"
#include "gpu/shader_source.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// Whether a user's folder has a stage of points, in GLSL or SPIR-V.
bool has_own_points(const std::filesystem::path& shaders) {
    constexpr std::array names{"collision_pass.vert", "collision_pass.geom", "collision_pass.vert.spv",
                               "collision_pass.geom.spv"};
    return !shaders.empty() && std::any_of(names.begin(), names.end(),
                                           [&](const char* name) { return std::filesystem::exists(shaders / name); });
}

/// In `exact` a point stands on a texel's centre, where no rounding moves it to another.
bool can_do_without_geometry(const ShaderSource& vertex, const Switches& switches,
                             const std::filesystem::path& shaders) {
    return !has_own_points(shaders) && vertex.bindings == nullptr &&
           (switches.arithmetic == ArithmeticSwitch::exact || points_alike_without_geometry());
}

/// The vertex stage with what the geometry stage does at its end: behind a geometry stage NVIDIA's transform feedback
/// takes a quarter longer (docs/speed.md).
ShaderSource points_alone(const ShaderFolders& folders, ShaderDefines defines) {
    defines.emplace_back("main", "collision_step");
    return continued(load_stage(folders, "collision_pass", Stage::vertex, defines),
                     load_stage(folders, "without_geometry", Stage::vertex));
}

std::vector<ShaderSource> load(const Switches& switches, const std::filesystem::path& shaders, const ClipDepth& depth) {
    ShaderDefines defines = switch_defines(switches);
    for (const auto& define : clip_depth_defines(depth))
        defines.push_back(define);
    const ShaderFolders folders = collision_shaders(shaders);
    constexpr std::array all{Stage::vertex, Stage::geometry, Stage::fragment};
    std::vector<ShaderSource> sources = load_stages(folders, "collision_pass", all, defines);
    if (can_do_without_geometry(sources.front(), switches, shaders)) {
        sources.front() = points_alone(folders, defines);
        std::erase_if(sources, [](const ShaderSource& source) { return source.stage == Stage::geometry; });
    }
    return sources;
}

Program link(const Switches& switches, const std::filesystem::path& shaders, const ClipDepth& depth) {
    const std::vector<ShaderSource> sources = load(switches, shaders, depth);
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
