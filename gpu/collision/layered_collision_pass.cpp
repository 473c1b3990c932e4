#include "gpu/collision/layered_collision_pass.hpp"

#include <limits>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/collision/step_uniforms.hpp"
#include "gpu/shader_source.hpp"
#include "gpu/texture.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

Program link_step(const Switches& switches, const std::filesystem::path& shaders) {
    const std::array stages{Stage::vertex};
    const std::vector<ShaderSource> sources =
        load_stages(collision_shaders(shaders), "layered_collision_pass", stages, switch_defines(switches));
    Program program("layered_collision_pass", sources, particle_records().captures());
    check_nothing_lost(sources, particle_records().captures());
    return program;
}

Program link_draw(const Switches& switches, const std::filesystem::path& shaders) {
    const std::array stages{Stage::vertex, Stage::fragment};
    return {"layered_cdt", load_stages(collision_shaders(shaders), "layered_cdt", stages, switch_defines(switches))};
}

const glm::mat4& proj_view(const FrameParams& params, int camera) {
    return camera == 0 ? params.collision_proj_view : params.second_proj_view;
}

constexpr std::array<float, 4> empty{0.0F, 0.0F, 0.0F, 0.0F};
constexpr float farthest = 1.0F;
constexpr std::array<GLint, 4> largest_key{std::numeric_limits<GLint>::max(), std::numeric_limits<GLint>::max(), 0, 0};

} // namespace

LayeredCollisionPass::LayeredCollisionPass(const Switches& switches, const std::filesystem::path& shaders, int width,
                                           int height)
    : width_(width), height_(height), planes_(cdt_planes(switches)), step_(link_step(switches, shaders)),
      draw_(link_draw(switches, shaders)) {
    allocate_texture(depth_.id(), depth32f, width, height);
    for (const GlTexture& key : keys_)
        allocate_texture(key.id(), {GL_RG32I, GL_RG_INTEGER, GL_INT}, width, height);
    for (const GlFramebuffer* target : {&obstacle_plane_, &layer_}) {
        gl::BindFramebuffer(GL_FRAMEBUFFER, target->id());
        gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
    }
    const GLenum velocities = planes_.velocities ? GL_COLOR_ATTACHMENT2 : GL_NONE;
    const std::array<GLenum, 3> position_key_velocity{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, velocities};
    gl::DrawBuffers(3, position_key_velocity.data());
    const std::array<GLenum, 3> position_velocity{GL_COLOR_ATTACHMENT0, GL_NONE, velocities};
    gl::BindFramebuffer(GL_FRAMEBUFFER, all_planes_.id());
    gl::DrawBuffers(3, position_velocity.data());
    check_gl("layered CDT");
}

void LayeredCollisionPass::run(const FrameParams& params, const MeshBuffer& obstacles, ObstaclePass& obstacle_pass,
                               const ParticleBuffer& from, ParticleBuffer& to, const LayeredTexture& cdt,
                               const LayeredTexture& target) {
    clear(target);
    step(params, obstacles.vertex_count() > 0, from, to, cdt);
    gl::Viewport(0, 0, width_, height_);
    gl::Enable(GL_DEPTH_TEST);
    gl::DepthFunc(GL_LESS);
    for (int camera = 0; camera < planes_.cameras; ++camera) {
        FrameParams seen = params;
        seen.collision_proj_view = proj_view(params, camera);
        if (obstacles.vertex_count() > 0)
            draw_obstacles(camera, seen, obstacles, obstacle_pass, target);
        draw_.set("u_ProjView", seen.collision_proj_view);
        draw_.set("u_ClientWidth", params.width);
        draw_.set("u_ClientHeight", params.height);
        set_collision_code(draw_, params);
        draw_.set_unit("u_KeyBefore", 0, GL_INT_SAMPLER_2D);
        draw_.set("u_Layer", 0);
        const GlVertexArray vertices = vertex_array(to, draw_);
        draw_.check_interface();
        gl::BindVertexArray(vertices.id());
        for (int layer = 0; layer < planes_.layers; ++layer)
            draw_layer(camera, layer, to, target);
    }
    check_gl("layered_collision_pass");
}

void LayeredCollisionPass::step(const FrameParams& params, bool obstacles, const ParticleBuffer& from,
                                ParticleBuffer& to, const LayeredTexture& cdt) {
    set_search_uniforms(step_, params);
    set_step_uniforms(step_, params);
    step_.set("u_SecondProjView", params.second_proj_view);
    step_.set("u_Reach", projected_reach(params.collision_proj_view, params));
    step_.set("u_SecondReach", projected_reach(params.second_proj_view, params));
    step_.set("u_WindowMargin", window_margin);
    step_.set("u_Obstacles", obstacles ? 1 : 0);
    step_.set_unit("u_CDTexture", 0, GL_SAMPLER_2D_ARRAY);
    cdt.bind_positions(0);
    if (planes_.velocities) {
        step_.set_unit("u_Velocities", 1, GL_SAMPLER_2D_ARRAY);
        cdt.bind_velocities(1);
    }
    const GlVertexArray vertices = vertex_array(from, step_);
    step_.check_interface();
    gl::BindVertexArray(vertices.id());
    to.bind_capture();
    gl::Enable(GL_RASTERIZER_DISCARD);
    gl::BeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, written_.id());
    gl::BeginTransformFeedback(GL_POINTS);
    gl::DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(from.size()));
    gl::EndTransformFeedback();
    gl::EndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    gl::Disable(GL_RASTERIZER_DISCARD);
}

void LayeredCollisionPass::clear(const LayeredTexture& target) {
    gl::BindFramebuffer(GL_FRAMEBUFFER, all_planes_.id());
    target.attach_positions(GL_COLOR_ATTACHMENT0);
    if (planes_.velocities)
        target.attach_velocities(GL_COLOR_ATTACHMENT2);
    check_framebuffer(GL_FRAMEBUFFER, "layered CDT, all planes");
    gl::ClearBufferfv(GL_COLOR, 0, empty.data());
    if (planes_.velocities)
        gl::ClearBufferfv(GL_COLOR, 2, empty.data());
}

void LayeredCollisionPass::draw_obstacles(int camera, const FrameParams& params, const MeshBuffer& obstacles,
                                          ObstaclePass& obstacle_pass, const LayeredTexture& target) {
    gl::BindFramebuffer(GL_FRAMEBUFFER, obstacle_plane_.id());
    target.attach(GL_COLOR_ATTACHMENT0, planes_.obstacles(camera));
    check_framebuffer(GL_FRAMEBUFFER, "layered CDT, obstacles");
    gl::ClearBufferfv(GL_DEPTH, 0, &farthest);
    obstacle_pass.run(obstacles, params);
}

void LayeredCollisionPass::draw_layer(int camera, int layer, const ParticleBuffer& particles,
                                      const LayeredTexture& target) {
    const GlTexture& key = keys_[static_cast<std::size_t>(layer % 2)];
    const GlTexture& key_before = keys_[static_cast<std::size_t>(1 - layer % 2)];
    gl::BindFramebuffer(GL_FRAMEBUFFER, layer_.id());
    target.attach(GL_COLOR_ATTACHMENT0, planes_.position(camera, layer));
    gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, key.id(), 0);
    if (planes_.velocities)
        target.attach(GL_COLOR_ATTACHMENT2, planes_.velocity(camera, layer));
    check_framebuffer(GL_FRAMEBUFFER, "layered CDT, one layer");
    gl::ClearBufferiv(GL_COLOR, 1, largest_key.data());
    gl::ClearBufferfv(GL_DEPTH, 0, &farthest);
    draw_.set("u_Layer", layer);
    gl::ActiveTexture(GL_TEXTURE0);
    gl::BindTexture(GL_TEXTURE_2D, key_before.id());
    gl::DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(particles.size()));
}

void LayeredCollisionPass::verify_written(std::size_t expected) const {
    GLuint written = 0;
    gl::GetQueryObjectuiv(written_.id(), GL_QUERY_RESULT, &written);
    if (written != expected)
        throw Error(
            fmt::format("layered_collision_pass: transform feedback wrote {} of {} particles", written, expected));
}

} // namespace lockstep
