#pragma once
#include "gpu/gl.hpp"

namespace lockstep {

/// How texels lie in memory: GL's names.
struct TexelLayout {
    GLenum internal = GL_RGBA32F;
    GLenum format = GL_RGBA;
    GLenum type = GL_FLOAT;
};

inline constexpr TexelLayout depth32f{GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT};

/// A 2D texture without mipmaps, filtering or repetition; `texels` may be null. Stays bound.
void allocate_texture(GLuint texture, const TexelLayout& layout, int width, int height, const void* texels = nullptr);

} // namespace lockstep
