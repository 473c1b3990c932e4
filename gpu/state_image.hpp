#pragma once
#include <cstdint>
#include <string>

#include "gpu/object.hpp"
#include "gpu/texture.hpp"
#include "reference/model/schema.hpp"
#include "reference/model/state_view.hpp"

namespace lockstep {

/// How the texels of a schema's image lie in GL, by Resource::format.
struct ImageFormat {
    TexelLayout layout;
    Scalar scalar = Scalar::float32;
    int components = 4;
    int bytes = 4; ///< of a component; fewer than 4: what a pass did not write cannot be told from what it did
};

/// r32f, rg32f, rgba32f, r16f, rg16f and rgba16f have floats; r32i, rgba32i integers; r32ui, rgba32ui, and r8, rgba8
/// and srgb8_alpha8, which have codes, unsigned ones. Throws Error naming these, or the type that the field should
/// have.
ImageFormat image_format(const Resource& image);

/// The types of what a shader reads and writes it by: GL_UNSIGNED_INT_SAMPLER_3D, GL_IMAGE_2D.
GLenum sampler_type(const Resource& image);
GLenum image_type(const Resource& image);

/// An image of a state: a texture without mipmaps or filtering.
class StateImage {
  public:
    /// `image` outlives this. Contents are undefined at first. Throws Error if GL allows no such texture.
    StateImage(const Resource& image, const Extent& extent);

    [[nodiscard]] GLuint id() const { return texture_.id(); }
    [[nodiscard]] GLenum target() const;
    [[nodiscard]] const Extent& extent() const { return extent_; }
    [[nodiscard]] const ImageFormat& format() const { return format_; }

    /// `state` has this extent. Bit for bit in formats of 32 bits; floats become the nearest half that GL makes of
    /// them.
    void upload(const View& state);
    void read(const WritableView& state) const;

    /// Every texel becomes 0.
    void clear();
    /// Every 32-bit word becomes `word`, in formats that have such.
    void fill(std::uint32_t word);
    /// The texels of `other`, of its image and size.
    void copy(const StateImage& other);

  private:
    void bind() const;
    void put(const void* texels);

    const Resource* about_;
    Extent extent_;
    ImageFormat format_;
    GlTexture texture_;
};

} // namespace lockstep
