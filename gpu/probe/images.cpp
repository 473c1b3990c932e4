#include "gpu/probe/images.hpp"

#include "gpu/check.hpp"

namespace lockstep::probing {

GlTexture make_texture(const TexelLayout& layout, int width, int height, const void* texels) {
    GlTexture texture;
    allocate_texture(texture.id(), layout, width, height, texels);
    check_gl("probe: texture");
    return texture;
}

GlFramebuffer make_framebuffer(std::span<const GlTexture* const> colors, const GlTexture* depth) {
    GlFramebuffer framebuffer;
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    std::vector<GLenum> buffers;
    for (const GlTexture* color : colors) {
        buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(buffers.size()));
        gl::FramebufferTexture2D(GL_FRAMEBUFFER, buffers.back(), GL_TEXTURE_2D, color->id(), 0);
    }
    if (depth != nullptr)
        gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth->id(), 0);
    gl::DrawBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
    check_framebuffer(GL_FRAMEBUFFER, "probe");
    return framebuffer;
}

} // namespace lockstep::probing
