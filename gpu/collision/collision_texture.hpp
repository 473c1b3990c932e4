#pragma once
#include "gpu/object.hpp"
#include "reference/model/collision/switches.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// The collision detection texture with a depth buffer (DEPTH_COMPONENT32F) and the framebuffer that draws into both.
/// Texels are as CollisionImage holds them: stored codes, bit for bit. No mipmaps, nearest filtering.
class CollisionTexture {
  public:
    /// Cleared. Throws Error if GL allows no texture of this size.
    CollisionTexture(int width, int height, CdtFormat format);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] CdtFormat format() const { return format_; }
    [[nodiscard]] GLuint id() const { return color_.id(); }

    /// Every texel zero, depth `far_plane`; leaves the framebuffer bound. Current write masks and scissor box apply.
    void clear(float far_plane = 1.0F);

    /// Binds the framebuffer and sets the viewport to the whole image.
    void bind_target() const;

    /// Binds the texture to texture unit `unit`.
    void bind_texture(int unit) const;

    /// `image` has this texture's size and holds codes of its format.
    void upload(const CollisionImage& image);
    void read(CollisionImage& image) const;
    void read(DepthImage& depth) const;

  private:
    int width_;
    int height_;
    CdtFormat format_;
    GlTexture color_;
    GlTexture depth_;
    GlFramebuffer framebuffer_;
};

} // namespace lockstep
