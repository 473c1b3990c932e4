#include "crosscheck/text/bound_words.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <fmt/format.h>

#include "gpu/glsl_type.hpp"
#include "gpu/uniform_words.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

std::vector<std::uint32_t> words_of_buffer(GLenum target, GLenum start_name, GLenum size_name, GLuint point) {
    GLint buffer = 0, start = 0, size = 0;
    gl::GetIntegeri_v(target, point, &buffer);
    gl::GetIntegeri_v(start_name, point, &start);
    gl::GetIntegeri_v(size_name, point, &size);
    gl::BindBuffer(GL_COPY_READ_BUFFER, static_cast<GLuint>(buffer));
    if (size == 0)
        gl::GetBufferParameteriv(GL_COPY_READ_BUFFER, GL_BUFFER_SIZE, &size);
    std::vector<std::uint32_t> words(static_cast<std::size_t>(size) / sizeof(std::uint32_t));
    gl::GetBufferSubData(GL_COPY_READ_BUFFER, start, static_cast<GLsizeiptr>(words.size() * sizeof words[0]),
                         words.data());
    gl::BindBuffer(GL_COPY_READ_BUFFER, 0);
    return words;
}

using UniformRead = std::array<std::uint32_t, 16>; ///< as much as a mat4 has

UniformRead value_at(GLuint program, GLint location, bool is_real) {
    UniformRead value{};
    if (is_real)
        gl::GetUniformfv(program, location, reinterpret_cast<GLfloat*>(value.data()));
    else
        gl::GetUniformiv(program, location, reinterpret_cast<GLint*>(value.data()));
    return value;
}

std::size_t components_of(GLenum type) {
    if (type >= GL_BOOL && type <= GL_BOOL_VEC4)
        return type - GL_BOOL + 1;
    return static_cast<std::size_t>(std::max(output_components(type), 1));
}

/// `to` is in use.
void copy_uniform(GLuint from, GLuint to, std::string name, GLint size, GLenum type) {
    if (name.ends_with("[0]"))
        name.resize(name.size() - 3);
    for (GLint i = 0; i < size; ++i) {
        const std::string one = size > 1 ? fmt::format("{}[{}]", name, i) : name;
        const GLint source = gl::GetUniformLocation(from, one.c_str()), at = gl::GetUniformLocation(to, one.c_str());
        if (source < 0 || at < 0)
            continue;
        const UniformRead value = value_at(from, source, is_float_type(type));
        if (!set_uniform_words(at, type, std::span(value).first(components_of(type)))) // of a sampler, its unit
            gl::Uniform1i(at, static_cast<GLint>(value[0]));
    }
}

} // namespace

GLuint current_program() {
    GLint current = 0;
    gl::GetIntegerv(GL_CURRENT_PROGRAM, &current);
    return static_cast<GLuint>(current);
}

std::vector<std::uint32_t> words_of_block(GLuint program, const text::Block& block) {
    const GLuint index = gl::GetProgramResourceIndex(
        program, block.is_storage ? GL_SHADER_STORAGE_BLOCK : GL_UNIFORM_BLOCK, block.name.c_str());
    if (index == GL_INVALID_INDEX)
        return std::vector<std::uint32_t>(1);
    const GLenum property = GL_BUFFER_BINDING;
    GLint binding = 0;
    gl::GetProgramResourceiv(program, block.is_storage ? GL_SHADER_STORAGE_BLOCK : GL_UNIFORM_BLOCK, index, 1,
                             &property, 1, nullptr, &binding);
    return block.is_storage ? words_of_buffer(GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
                                              GL_SHADER_STORAGE_BUFFER_SIZE, static_cast<GLuint>(binding))
                            : words_of_buffer(GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START,
                                              GL_UNIFORM_BUFFER_SIZE, static_cast<GLuint>(binding));
}

std::vector<std::uint32_t> words_of_uniform(GLuint program, const text::PlainUniform& uniform) {
    std::vector<std::uint32_t> words(uniform.cells);
    const auto location_of = [&](const std::string& name) { return gl::GetUniformLocation(program, name.c_str()); };
    const auto read = [&](GLint location, std::size_t first) {
        const UniformRead value = value_at(program, location, uniform.is_real);
        std::copy_n(value.begin(), std::min(value.size(), words.size() - first),
                    words.begin() + static_cast<std::ptrdiff_t>(first));
    };
    std::size_t elements = 0;
    while (elements < words.size() && location_of(fmt::format("{}[{}]", uniform.name, elements)) >= 0)
        ++elements;
    if (elements < 2) {
        const GLint location = location_of(uniform.name);
        if (location < 0)
            return {};
        read(location, 0);
        return words;
    }
    for (std::size_t i = 0; i < elements; ++i)
        read(location_of(fmt::format("{}[{}]", uniform.name, i)), i * (words.size() / elements));
    return words;
}

BoundTexels texels_of(GLuint program, const text::ImageUniform& image) {
    const bool is_flat = image.shape.dimensions == spv::Dim2D;
    if (image.is_storage || image.shape.has_samples || (!is_flat && image.shape.dimensions != spv::Dim3D))
        throw Error(fmt::format("{}: only textures of two and three dimensions are read back", image.name));
    BoundTexels texels;
    texels.memory.name = image.name;
    const GLenum target = !is_flat ? GL_TEXTURE_3D : image.shape.is_arrayed ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
    GLint unit = 0, before = 0;
    std::array<GLint, 3> size{1, 1, 1};
    if (const GLint location = gl::GetUniformLocation(program, image.name.c_str()); location >= 0)
        gl::GetUniformiv(program, location, &unit);
    gl::GetIntegerv(GL_ACTIVE_TEXTURE, &before);
    gl::ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl::GetTexLevelParameteriv(target, 0, GL_TEXTURE_WIDTH, &size[0]);
    gl::GetTexLevelParameteriv(target, 0, GL_TEXTURE_HEIGHT, &size[1]);
    gl::GetTexLevelParameteriv(target, 0, GL_TEXTURE_DEPTH, &size[2]);
    std::size_t count = texels.memory.components;
    for (std::size_t axis = 0; axis < size.size(); ++axis) {
        texels.memory.size[axis] = static_cast<std::uint32_t>(std::max(size[axis], 1));
        count *= texels.memory.size[axis];
    }
    texels.words.resize(count);
    gl::GetTexImage(target, 0, image.is_real ? GL_RGBA : GL_RGBA_INTEGER,
                    image.is_real     ? GL_FLOAT
                    : image.is_signed ? GL_INT
                                      : GL_UNSIGNED_INT,
                    texels.words.data());
    gl::ActiveTexture(static_cast<GLenum>(before));
    return texels;
}

void copy_bindings(GLuint from, GLuint to, GLuint binding) {
    GLint count = 0, size = 0;
    GLenum kind = 0;
    std::array<char, 256> name{};
    gl::GetProgramiv(to, GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; ++i) {
        gl::GetActiveUniform(to, static_cast<GLuint>(i), name.size(), nullptr, &size, &kind, name.data());
        copy_uniform(from, to, name.data(), size, kind);
    }
    for (const GLenum interface : {GL_SHADER_STORAGE_BLOCK, GL_UNIFORM_BLOCK}) {
        gl::GetProgramInterfaceiv(to, interface, GL_ACTIVE_RESOURCES, &count);
        for (GLint i = 0; i < count; ++i) {
            gl::GetProgramResourceName(to, interface, static_cast<GLuint>(i), name.size(), nullptr, name.data());
            const GLuint index = gl::GetProgramResourceIndex(from, interface, name.data());
            const GLenum property = GL_BUFFER_BINDING;
            GLint point = static_cast<GLint>(binding);
            if (index != GL_INVALID_INDEX)
                gl::GetProgramResourceiv(from, interface, index, 1, &property, 1, nullptr, &point);
            if (interface == GL_UNIFORM_BLOCK)
                gl::UniformBlockBinding(to, static_cast<GLuint>(i), static_cast<GLuint>(point));
            else
                gl::ShaderStorageBlockBinding(to, static_cast<GLuint>(i), static_cast<GLuint>(point));
        }
    }
}

} // namespace lockstep
