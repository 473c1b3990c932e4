#pragma once
#include <cstddef>
#include <vector>

#include "gpu/object.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/collision/switches.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// A CDT of several planes: a 2D array texture for positions, and one for velocities if there are any. Images are all
/// planes stacked bottom to top (layered_cdt.hpp), bit for bit. No mipmaps, nearest filtering.
class LayeredTexture {
  public:
    /// Contents are undefined at first. Throws Error if GL allows no texture of this size.
    LayeredTexture(int width, int height, const CdtPlanes& planes, CdtFormat format);

    [[nodiscard]] CdtFormat format() const { return format_; }

    /// Makes one plane, or all planes with positions or with velocities, an attachment of the bound framebuffer.
    void attach(GLenum attachment, int plane) const;
    void attach_positions(GLenum attachment) const;
    void attach_velocities(GLenum attachment) const;

    /// Bind the textures to texture unit `unit`; there are velocities with response = mutual only.
    void bind_positions(int unit) const;
    void bind_velocities(int unit) const;

    /// `image` is the stack of all planes and holds codes of the texture's format.
    void upload(const CollisionImage& image);
    void read(CollisionImage& image) const;

  private:
    [[nodiscard]] std::size_t array_size() const; ///< bytes, as codes travel

    int width_, height_;
    CdtPlanes planes_;
    CdtFormat format_;
    std::vector<GlTexture> arrays_; ///< positions, velocities
};

} // namespace lockstep
