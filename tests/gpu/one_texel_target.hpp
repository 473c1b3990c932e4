#pragma once
#include "gpu/object.hpp"
#include "gpu/texture.hpp"

namespace lockstep::test {

/// A framebuffer to draw into while it lives: a context without a surface has none, and a draw needs a complete one
/// even where the rasterizer is off.
class OneTexelTarget {
  public:
    OneTexelTarget() {
        allocate_texture(color_.id(), {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE}, 1, 1);
        gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
        gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
    }
    ~OneTexelTarget() { gl::BindFramebuffer(GL_FRAMEBUFFER, 0); }
    OneTexelTarget(const OneTexelTarget&) = delete;
    OneTexelTarget& operator=(const OneTexelTarget&) = delete;

  private:
    GlTexture color_;
    GlFramebuffer framebuffer_;
};

} // namespace lockstep::test
