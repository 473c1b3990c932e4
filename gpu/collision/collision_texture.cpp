#include "gpu/collision/collision_texture.hpp"

#include <cassert>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "gpu/collision/stored_codes.hpp"
#include "gpu/texture.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

template <class Texel> void fit(Image<Texel>& image, int width, int height) {
    if (image.width != width || image.height != height)
        image = Image<Texel>(width, height);
}

} // namespace

CollisionTexture::CollisionTexture(int width, int height, CdtFormat format)
    : width_(width), height_(height), format_(format) {
    GLint limit = 0;
    gl::GetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (width < 1 || height < 1 || width > limit || height > limit)
        throw Error(fmt::format("CDT of {} x {} texels: this GL allows 1 to {} a side", width, height, limit));
    allocate_texture(color_.id(), {stored_format(format), GL_RGBA, GL_FLOAT}, width, height);
    allocate_texture(depth_.id(), depth32f, width, height);
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
    gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
    const std::string what = fmt::format("CDT of {} x {} texels", width, height);
    check_gl(what);
    check_framebuffer(GL_FRAMEBUFFER, what);
    clear();
}

void CollisionTexture::clear(float far_plane) {
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    const float zero[4] = {0.0F, 0.0F, 0.0F, 0.0F};
    gl::ClearBufferfv(GL_COLOR, 0, zero);
    gl::ClearBufferfv(GL_DEPTH, 0, &far_plane);
}

void CollisionTexture::bind_target() const {
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    gl::Viewport(0, 0, width_, height_);
}

void CollisionTexture::bind_texture(int unit) const {
    gl::ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl::BindTexture(GL_TEXTURE_2D, color_.id());
}

void CollisionTexture::upload(const CollisionImage& image) {
    assert(image.width == width_ && image.height == height_);
    gl::BindTexture(GL_TEXTURE_2D, color_.id());
    upload_codes(image, format_, [&](GLenum type, const void* codes) {
        gl::TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGBA, type, codes);
    });
    check_gl("CDT upload");
}

void CollisionTexture::read(CollisionImage& image) const {
    fit(image, width_, height_);
    gl::BindTexture(GL_TEXTURE_2D, color_.id());
    read_codes(image, format_,
               [](GLenum type, void* codes) { gl::GetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, type, codes); });
    check_gl("CDT read-back");
}

void CollisionTexture::read(DepthImage& depth) const {
    fit(depth, width_, height_);
    gl::BindTexture(GL_TEXTURE_2D, depth_.id());
    gl::GetTexImage(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, GL_FLOAT, depth.texels.data());
    check_gl("CDT depth read-back");
}

} // namespace lockstep
