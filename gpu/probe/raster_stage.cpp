#include "gpu/probe/raster_stage.hpp"

#include <array>
#include <cstddef>

#include "gpu/check.hpp"

namespace lockstep::probing {
namespace {

Program link_raster_stage(Primitive primitive, bool geometry, bool point_coord) {
    const ShaderFolders folders = shader_folders();
    std::vector<ShaderSource> stages{load_stage(folders, "probe/raster", Stage::vertex,
                                                geometry      ? ShaderDefines{{"WITH_GEOMETRY", "1"}}
                                                : point_coord ? ShaderDefines{{"WITH_POINT_SIZE", "1"}}
                                                              : ShaderDefines{})};
    if (geometry)
        stages.push_back(
            load_stage(folders, primitive == Primitive::points ? "probe/points" : "probe/triangles", Stage::geometry));
    stages.push_back(load_stage(folders, "probe/raster", Stage::fragment,
                                point_coord ? ShaderDefines{{"WITH_POINT_COORD", "1"}} : ShaderDefines{}));
    return {"probe/raster", stages};
}

} // namespace

IdImage::IdImage(int width, int height)
    : width_(width), height_(height), color_(make_texture(r32f, width, height, nullptr)),
      depth_(make_texture(depth32f, width, height, nullptr)),
      framebuffer_(make_framebuffer(std::array<const GlTexture*, 1>{&color_}, &depth_)) {}

void IdImage::clear() const {
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    gl::Viewport(0, 0, width_, height_);
    const float none[4] = {-1.0F, 0.0F, 0.0F, 0.0F};
    const float far_plane = 1.0F;
    gl::ClearBufferfv(GL_COLOR, 0, none);
    gl::ClearBufferfv(GL_DEPTH, 0, &far_plane);
}

Floats IdImage::ids() const {
    return read_texture<float>(color_, r32f, static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
}

Floats IdImage::depths() const {
    return read_texture<float>(depth_, depth32f, static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
}

RasterStage::RasterStage(Primitive primitive, bool geometry, bool point_coord)
    : primitive_(primitive), program_(link_raster_stage(primitive, geometry, point_coord)) {}

void RasterStage::draw(std::span<const RasterVertex> vertices) const {
    const GlBuffer buffer;
    const GlVertexArray array;
    gl::BindVertexArray(array.id());
    gl::BindBuffer(GL_ARRAY_BUFFER, buffer.id());
    gl::BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size_bytes()), vertices.data(), GL_STREAM_DRAW);
    const auto feed = [&](const char* name, GLint components, GLenum type, std::size_t offset) {
        const auto location = static_cast<GLuint>(program_.attribute(name, type));
        gl::EnableVertexAttribArray(location);
        gl::VertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, sizeof(RasterVertex),
                                reinterpret_cast<const void*>(offset));
    };
    feed("a_Clip", 4, GL_FLOAT_VEC4, offsetof(RasterVertex, clip));
    feed("a_Id", 1, GL_FLOAT, offsetof(RasterVertex, id));
    program_.use();
    gl::DrawArrays(primitive_ == Primitive::points ? GL_POINTS : GL_TRIANGLES, 0,
                   static_cast<GLsizei>(vertices.size()));
    gl::BindVertexArray(0);
    check_gl("probe/raster");
}

} // namespace lockstep::probing
