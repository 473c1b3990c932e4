#pragma once
#include <span>

#include "gpu/object.hpp"
#include "gpu/probe/judge.hpp"
#include "gpu/texture.hpp"

namespace lockstep::probing {

inline constexpr TexelLayout rgba32f{GL_RGBA32F, GL_RGBA, GL_FLOAT};
inline constexpr TexelLayout rgba16f{GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT};
inline constexpr TexelLayout rgba8{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};
inline constexpr TexelLayout r32f{GL_R32F, GL_RED, GL_FLOAT};

/// A texture without mipmaps or filtering; `texels` may be null.
GlTexture make_texture(const TexelLayout& layout, int width, int height, const void* texels);

/// Its texels, `components` a texel.
template <class Component>
std::vector<Component> read_texture(const GlTexture& texture, const TexelLayout& layout, std::size_t count) {
    std::vector<Component> texels(count);
    gl::BindTexture(GL_TEXTURE_2D, texture.id());
    gl::GetTexImage(GL_TEXTURE_2D, 0, layout.format, layout.type, texels.data());
    return texels;
}

/// A framebuffer that draws into `colors`, in this order, and `depth` if given. Stays bound.
GlFramebuffer make_framebuffer(std::span<const GlTexture* const> colors, const GlTexture* depth = nullptr);

} // namespace lockstep::probing
