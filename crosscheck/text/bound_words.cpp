#include "crosscheck/text/bound_words.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include <fmt/format.h>

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

void copy_uniform(GLuint from, GLuint to, std::string name, GLint size, GLenum kind) {
    if (name.ends_with("[0]"))
        name.resize(name.size() - 3);
    for (GLint i = 0; i < size; ++i) {
        const std::string one = size > 1 ? fmt::format("{}[{}]", name, i) : name;
        const GLint source = gl::GetUniformLocation(from, one.c_str()), at = gl::GetUniformLocation(to, one.c_str());
        if (source < 0 || at < 0)
            continue;
        std::array<GLfloat, 16> reals{};
        std::array<GLint, 16> numbers{};
        const auto* const unsigned_numbers = reinterpret_cast<const GLuint*>(numbers.data());
        switch (kind) {
        case GL_FLOAT:
        case GL_FLOAT_VEC2:
        case GL_FLOAT_VEC3:
        case GL_FLOAT_VEC4:
        case GL_FLOAT_MAT2:
        case GL_FLOAT_MAT3:
        case GL_FLOAT_MAT4:
            gl::GetUniformfv(from, source, reals.data());
            break;
        default:
            gl::GetUniformiv(from, source, numbers.data());
        }
        switch (kind) {
        case GL_FLOAT:
            gl::Uniform1fv(at, 1, reals.data());
            break;
        case GL_FLOAT_VEC2:
            gl::Uniform2fv(at, 1, reals.data());
            break;
        case GL_FLOAT_VEC3:
            gl::Uniform3fv(at, 1, reals.data());
            break;
        case GL_FLOAT_VEC4:
            gl::Uniform4fv(at, 1, reals.data());
            break;
        case GL_FLOAT_MAT2:
            gl::UniformMatrix2fv(at, 1, GL_FALSE, reals.data());
            break;
        case GL_FLOAT_MAT3:
            gl::UniformMatrix3fv(at, 1, GL_FALSE, reals.data());
            break;
        case GL_FLOAT_MAT4:
            gl::UniformMatrix4fv(at, 1, GL_FALSE, reals.data());
            break;
        case GL_BOOL_VEC2:
        case GL_INT_VEC2:
            gl::Uniform2iv(at, 1, numbers.data());
            break;
        case GL_UNSIGNED_INT:
            gl::Uniform1uiv(at, 1, unsigned_numbers);
            break;
        case GL_UNSIGNED_INT_VEC2:
            gl::Uniform2uiv(at, 1, unsigned_numbers);
            break;
        case GL_UNSIGNED_INT_VEC3:
            gl::Uniform3uiv(at, 1, unsigned_numbers);
            break;
        case GL_UNSIGNED_INT_VEC4:
            gl::Uniform4uiv(at, 1, unsigned_numbers);
            break;
        case GL_BOOL_VEC4:
        case GL_INT_VEC4:
            gl::Uniform4iv(at, 1, numbers.data());
            break;
        case GL_BOOL_VEC3:
        case GL_INT_VEC3:
            gl::Uniform3iv(at, 1, numbers.data());
            break;
        default: // int, bool, samplers
            gl::Uniform1i(at, numbers[0]);
        }
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
        std::array<std::uint32_t, 16> value{};
        if (uniform.is_real)
            gl::GetUniformfv(program, location, reinterpret_cast<GLfloat*>(value.data()));
        else
            gl::GetUniformiv(program, location, reinterpret_cast<GLint*>(value.data()));
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
