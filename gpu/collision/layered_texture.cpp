#include "gpu/collision/layered_texture.hpp"

#include <cassert>
#include <cstddef>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "gpu/collision/stored_codes.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

std::size_t texel_size(CdtFormat format) {
    switch (format) {
    case CdtFormat::rgba32f:
        return 16;
    case CdtFormat::rgba16f:
        return 8;
    case CdtFormat::rgba8:
        break;
    }
    return 4;
}

} // namespace

LayeredTexture::LayeredTexture(int width, int height, const CdtPlanes& planes, CdtFormat format)
    : width_(width), height_(height), planes_(planes), format_(format), arrays_(planes.velocities ? 2 : 1) {
    GLint side = 0, layers = 0;
    gl::GetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
    gl::GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
    if (width < 1 || height < 1 || width > side || height > side || planes.positions() > layers)
        throw Error(
            fmt::format("CDT of {} planes of {} x {} texels: this GL allows 1 to {} planes, 1 to {} texels a side",
                        planes.positions(), width, height, layers, side));
    for (const GlTexture& array : arrays_) {
        gl::BindTexture(GL_TEXTURE_2D_ARRAY, array.id());
        gl::TexImage3D(GL_TEXTURE_2D_ARRAY, 0, static_cast<GLint>(stored_format(format)), width, height,
                       planes.positions(), 0, GL_RGBA, GL_FLOAT, nullptr);
        gl::TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
        gl::TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl::TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    check_gl(fmt::format("CDT of {} planes of {} x {} texels", planes.count(), width, height));
}

void LayeredTexture::attach(GLenum attachment, int plane) const {
    assert(plane >= 0 && plane < planes_.count());
    const int array = plane / planes_.positions();
    gl::FramebufferTextureLayer(GL_FRAMEBUFFER, attachment, arrays_[static_cast<std::size_t>(array)].id(), 0,
                                plane % planes_.positions());
}

void LayeredTexture::attach_positions(GLenum attachment) const {
    gl::FramebufferTexture(GL_FRAMEBUFFER, attachment, arrays_[0].id(), 0);
}

void LayeredTexture::attach_velocities(GLenum attachment) const {
    gl::FramebufferTexture(GL_FRAMEBUFFER, attachment, arrays_.at(1).id(), 0);
}

void LayeredTexture::bind_positions(int unit) const {
    gl::ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl::BindTexture(GL_TEXTURE_2D_ARRAY, arrays_[0].id());
}

void LayeredTexture::bind_velocities(int unit) const {
    gl::ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl::BindTexture(GL_TEXTURE_2D_ARRAY, arrays_.at(1).id());
}

void LayeredTexture::upload(const CollisionImage& image) {
    assert(image.width == width_ && image.height == height_ * planes_.count());
    upload_codes(image, format_, [&](GLenum type, const void* codes) {
        for (std::size_t i = 0; i < arrays_.size(); ++i) {
            gl::BindTexture(GL_TEXTURE_2D_ARRAY, arrays_[i].id());
            gl::TexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, width_, height_, planes_.positions(), GL_RGBA, type,
                              static_cast<const std::byte*>(codes) + i * array_size());
        }
    });
    check_gl("CDT upload");
}

void LayeredTexture::read(CollisionImage& image) const {
    if (image.width != width_ || image.height != height_ * planes_.count())
        image = CollisionImage(width_, height_ * planes_.count());
    read_codes(image, format_, [&](GLenum type, void* codes) {
        for (std::size_t i = 0; i < arrays_.size(); ++i) {
            gl::BindTexture(GL_TEXTURE_2D_ARRAY, arrays_[i].id());
            gl::GetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA, type, static_cast<std::byte*>(codes) + i * array_size());
        }
    });
    check_gl("CDT read-back");
}

std::size_t LayeredTexture::array_size() const {
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) *
           static_cast<std::size_t>(planes_.positions()) * texel_size(format_);
}

} // namespace lockstep
