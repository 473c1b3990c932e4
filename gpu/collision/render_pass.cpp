#include "gpu/collision/render_pass.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <span>
#include <string>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/shader_source.hpp"
#include "gpu/texture.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

Program link(const std::string& name, std::span<const Stage> stages, const Switches& switches,
             const std::filesystem::path& shaders) {
    return {name, load_stages(collision_shaders(shaders), name, stages, switch_defines(switches))};
}

/// In order, a slice after the other: a software driver holds the triangles of a draw until they are drawn.
/// gl_PrimitiveID counts anew in each.
void draw_points(std::size_t count) {
    constexpr std::size_t slice = std::size_t{1} << 20U;
    for (std::size_t first = 0; first < count; first += slice) {
        gl::DrawArrays(GL_POINTS, static_cast<GLint>(first), static_cast<GLsizei>(std::min(slice, count - first)));
        if (first + slice < count)
            gl::Finish();
    }
}

constexpr std::array two_stages{Stage::vertex, Stage::fragment};
constexpr std::array three_stages{Stage::vertex, Stage::geometry, Stage::fragment};

} // namespace

RenderPass::RenderPass(const Switches& switches, const std::filesystem::path& shaders, int width, int height)
    : width_(width), height_(height), background_(link("render_background", two_stages, switches, shaders)),
      obstacles_(link("render_obstacles", three_stages, switches, shaders)),
      particles_(link("render_pass", three_stages, switches, shaders)) {
    GLint limit = 0;
    gl::GetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (width < 1 || height < 1 || width > limit || height > limit)
        throw Error(
            fmt::format("rendered image of {} x {} pixels: this GL allows 1 to {} a side", width, height, limit));
    allocate_texture(color_.id(), {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE}, width, height);
    allocate_texture(depth_.id(), depth32f, width, height);
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
    gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
    const std::string what = fmt::format("rendered image of {} x {} pixels", width, height);
    check_gl(what);
    check_framebuffer(GL_FRAMEBUFFER, what);
}

void RenderPass::run(const ParticleBuffer& particles, const MeshBuffer& obstacles, const FrameParams& params) {
    assert(params.render_width == width_ && params.render_height == height_);
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    gl::Viewport(0, 0, width_, height_);
    gl::Enable(GL_DEPTH_TEST);
    gl::DepthFunc(GL_LESS);
    const float far_plane = 1.0F;
    gl::ClearBufferfv(GL_DEPTH, 0, &far_plane);

    const GlVertexArray no_attributes;
    gl::BindVertexArray(no_attributes.id());
    set_uniforms(background_, params);
    gl::Disable(GL_DEPTH_TEST); // and with it depth writes
    gl::DrawArrays(GL_TRIANGLES, 0, 3);
    gl::Enable(GL_DEPTH_TEST);

    const GlVertexArray corners = mesh_vertex_array(obstacles, obstacles_);
    gl::BindVertexArray(corners.id());
    set_uniforms(obstacles_, params);
    gl::DrawElements(GL_TRIANGLES, obstacles.index_count(), GL_UNSIGNED_INT, nullptr);

    const GlVertexArray points = vertex_array(particles, particles_);
    gl::BindVertexArray(points.id());
    set_uniforms(particles_, params);
    draw_points(particles.size());
    gl::BindVertexArray(0);
    check_gl("render_pass");
}

void RenderPass::set_uniforms(const Program& program, const FrameParams& params) const {
    program.set("u_View", params.render_view);
    program.set("u_Projection", params.render_projection);
    program.set("u_ClientWidth", width_);
    program.set("u_ClientHeight", height_);
    program.set("u_BillboardRadius", params.constants.billboard_radius);
    program.set("u_CollisionTime", params.constants.collision_time);
    program.check_interface();
}

void RenderPass::read(ColorImage& image) const {
    image = ColorImage(width_, height_);
    gl::BindTexture(GL_TEXTURE_2D, color_.id());
    gl::GetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, image.texels.data());
    check_gl("rendered image read-back");
}

} // namespace lockstep
