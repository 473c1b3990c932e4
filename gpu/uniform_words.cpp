#include "gpu/uniform_words.hpp"

#include <algorithm>

namespace lockstep {

bool set_uniform_words(GLint location, GLenum type, std::span<const std::uint32_t> words, bool transposed) {
    const GLboolean by_rows = transposed ? GL_TRUE : GL_FALSE;
    const auto* const floats = reinterpret_cast<const GLfloat*>(words.data());
    const auto* const integers = reinterpret_cast<const GLint*>(words.data());
    const auto count = [&](std::size_t components) {
        return static_cast<GLsizei>(std::max<std::size_t>(words.size() / components, 1));
    };
    switch (type) {
    case GL_FLOAT:
        gl::Uniform1fv(location, count(1), floats);
        return true;
    case GL_FLOAT_VEC2:
        gl::Uniform2fv(location, count(2), floats);
        return true;
    case GL_FLOAT_VEC3:
        gl::Uniform3fv(location, count(3), floats);
        return true;
    case GL_FLOAT_VEC4:
        gl::Uniform4fv(location, count(4), floats);
        return true;
    case GL_INT:
    case GL_BOOL:
        gl::Uniform1iv(location, count(1), integers);
        return true;
    case GL_INT_VEC2:
    case GL_BOOL_VEC2:
        gl::Uniform2iv(location, count(2), integers);
        return true;
    case GL_INT_VEC3:
    case GL_BOOL_VEC3:
        gl::Uniform3iv(location, count(3), integers);
        return true;
    case GL_INT_VEC4:
    case GL_BOOL_VEC4:
        gl::Uniform4iv(location, count(4), integers);
        return true;
    case GL_UNSIGNED_INT:
        gl::Uniform1uiv(location, count(1), words.data());
        return true;
    case GL_UNSIGNED_INT_VEC2:
        gl::Uniform2uiv(location, count(2), words.data());
        return true;
    case GL_UNSIGNED_INT_VEC3:
        gl::Uniform3uiv(location, count(3), words.data());
        return true;
    case GL_UNSIGNED_INT_VEC4:
        gl::Uniform4uiv(location, count(4), words.data());
        return true;
    case GL_FLOAT_MAT2:
        gl::UniformMatrix2fv(location, count(4), by_rows, floats);
        return true;
    case GL_FLOAT_MAT3:
        gl::UniformMatrix3fv(location, count(9), by_rows, floats);
        return true;
    case GL_FLOAT_MAT4:
        gl::UniformMatrix4fv(location, count(16), by_rows, floats);
        return true;
    default:
        return false;
    }
}

} // namespace lockstep
