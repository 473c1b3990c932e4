#include "gpu/probe/vertex_stage.hpp"

#include <array>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "gpu/probe/images.hpp"
#include "reference/model/error.hpp"

namespace lockstep::probing {
namespace {

GLenum float_type(int components) {
    constexpr GLenum types[] = {GL_FLOAT, GL_FLOAT_VEC2, GL_FLOAT_VEC3, GL_FLOAT_VEC4};
    return types[components - 1];
}

std::size_t components_of(GLenum type) {
    return type == GL_FLOAT ? 1 : type == GL_FLOAT_VEC2 ? 2 : type == GL_FLOAT_VEC3 ? 3 : 4;
}

Program link_vertex_stage(const std::string& name, const ShaderDefines& defines, std::span<const Capture> outputs,
                          bool geometry) {
    const ShaderFolders folders = shader_folders();
    std::vector<ShaderSource> stages{load_stage(folders, name, Stage::vertex, defines)};
    if (geometry)
        stages.push_back(load_stage(folders, name, Stage::geometry, defines));
    return {name, stages, outputs};
}

} // namespace

VertexStage::VertexStage(const std::string& name, const ShaderDefines& defines, std::vector<Attribute> attributes,
                         std::vector<Capture> outputs, bool geometry)
    : attributes_(std::move(attributes)), outputs_(std::move(outputs)),
      program_(link_vertex_stage(name, defines, outputs_, geometry)), target_(make_texture(r32f, 1, 1, nullptr)),
      framebuffer_(make_framebuffer(std::array<const GlTexture*, 1>{&target_})) {}

Floats VertexStage::run(std::size_t count, const std::vector<Attribute>& given, std::string_view output) const {
    const GlVertexArray array;
    gl::BindVertexArray(array.id());
    std::vector<GlBuffer> buffers(attributes_.size());
    const Floats ones(count * 4, 1.0F);
    for (std::size_t i = 0; i < attributes_.size(); ++i) {
        Attribute attribute = attributes_[i];
        for (const Attribute& other : given)
            if (other.name == attribute.name)
                attribute.values = other.values;
        const GLint location = program_.attribute(attribute.name, float_type(attribute.components));
        if (location < 0)
            throw Error(fmt::format("{}: there is no attribute {}", program_.name(), attribute.name));
        gl::BindBuffer(GL_ARRAY_BUFFER, buffers[i].id());
        gl::BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(count * attribute.components * sizeof(float)),
                       attribute.values != nullptr ? attribute.values : ones.data(), GL_STREAM_DRAW);
        gl::EnableVertexAttribArray(static_cast<GLuint>(location));
        gl::VertexAttribPointer(static_cast<GLuint>(location), attribute.components, GL_FLOAT, GL_FALSE, 0, nullptr);
    }
    std::size_t stride = 0, offset = 0, width = 0;
    for (const Capture& capture : outputs_) {
        if (capture.name == output) {
            offset = stride;
            width = components_of(capture.type);
        }
        stride += components_of(capture.type);
    }

    const GlBuffer captured;
    const GlQuery written;
    const auto bytes = static_cast<GLsizeiptr>(count * stride * sizeof(float));
    gl::BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, captured.id());
    gl::BufferData(GL_TRANSFORM_FEEDBACK_BUFFER, bytes, nullptr, GL_STREAM_READ);
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    program_.use();
    gl::Enable(GL_RASTERIZER_DISCARD);
    gl::BeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, written.id());
    gl::BeginTransformFeedback(GL_POINTS);
    gl::DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(count));
    gl::EndTransformFeedback();
    gl::EndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    gl::Disable(GL_RASTERIZER_DISCARD);
    GLuint primitives = 0;
    gl::GetQueryObjectuiv(written.id(), GL_QUERY_RESULT, &primitives);
    Floats all(count * stride);
    gl::GetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, bytes, all.data());
    gl::BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    gl::BindVertexArray(0);
    gl::BindFramebuffer(GL_FRAMEBUFFER, 0);
    check_gl(program_.name());
    if (primitives != count)
        throw Error(fmt::format("{}: transform feedback wrote {} of {} vertices", program_.name(), primitives, count));

    Floats values;
    values.reserve(count * width);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < width; ++c)
            values.push_back(all[i * stride + offset + c]);
    return values;
}

} // namespace lockstep::probing
