#include "gpu/collision_texture.hpp"

#include <cassert>
#include <cstdint>
#include <vector>

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include "gpu/check.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

GLenum internal_format(CdtFormat format) {
    switch (format) {
    case CdtFormat::rgba32f:
        return GL_RGBA32F;
    case CdtFormat::rgba16f:
        return GL_RGBA16F;
    case CdtFormat::rgba8:
        break;
    }
    return GL_RGBA8;
}

void allocate(GLuint texture, GLenum internal, int width, int height, GLenum format) {
    gl::BindTexture(GL_TEXTURE_2D, texture);
    gl::TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(internal), width, height, 0, format, GL_FLOAT, nullptr);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl::TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

// Halves and bytes travel as such and are converted here, so that no driver's conversion is in the way.
void store(float value, std::uint16_t& half) { half = glm::packHalf1x16(value); }
void store(float value, std::uint8_t& code) { code = static_cast<std::uint8_t>(value); }
float to_float(std::uint16_t half) { return glm::unpackHalf1x16(half); }
float to_float(std::uint8_t code) { return static_cast<float>(code); }

template <class Component> void upload_converted(const CollisionImage& image, GLenum type) {
    std::vector<Component> stored(image.texels.size() * 4);
    const auto n = static_cast<std::ptrdiff_t>(stored.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i)
        store(image.texels[i / 4][static_cast<int>(i % 4)], stored[i]);
    gl::TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.width, image.height, GL_RGBA, type, stored.data());
}

template <class Component> void read_converted(CollisionImage& image, GLenum type) {
    std::vector<Component> stored(image.texels.size() * 4);
    gl::GetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, type, stored.data());
    const auto n = static_cast<std::ptrdiff_t>(stored.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i)
        image.texels[i / 4][static_cast<int>(i % 4)] = to_float(stored[i]);
}

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
    allocate(color_.id(), internal_format(format), width, height, GL_RGBA);
    allocate(depth_.id(), GL_DEPTH_COMPONENT32F, width, height, GL_DEPTH_COMPONENT);
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
    gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
    const std::string what = fmt::format("CDT of {} x {} texels", width, height);
    check_gl(what);
    check_framebuffer(GL_FRAMEBUFFER, what);
    clear();
}

void CollisionTexture::clear() {
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    const float zero[4] = {0.0F, 0.0F, 0.0F, 0.0F};
    const float far_plane = 1.0F;
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
    switch (format_) {
    case CdtFormat::rgba32f:
        gl::TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGBA, GL_FLOAT, image.texels.data());
        break;
    case CdtFormat::rgba16f:
        upload_converted<std::uint16_t>(image, GL_HALF_FLOAT);
        break;
    case CdtFormat::rgba8:
        upload_converted<std::uint8_t>(image, GL_UNSIGNED_BYTE);
        break;
    }
    check_gl("CDT upload");
}

void CollisionTexture::read(CollisionImage& image) const {
    fit(image, width_, height_);
    gl::BindTexture(GL_TEXTURE_2D, color_.id());
    switch (format_) {
    case CdtFormat::rgba32f:
        gl::GetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, image.texels.data());
        break;
    case CdtFormat::rgba16f:
        read_converted<std::uint16_t>(image, GL_HALF_FLOAT);
        break;
    case CdtFormat::rgba8:
        read_converted<std::uint8_t>(image, GL_UNSIGNED_BYTE);
        break;
    }
    check_gl("CDT read-back");
}

void CollisionTexture::read(DepthImage& depth) const {
    fit(depth, width_, height_);
    gl::BindTexture(GL_TEXTURE_2D, depth_.id());
    gl::GetTexImage(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, GL_FLOAT, depth.texels.data());
    check_gl("CDT depth read-back");
}

} // namespace lockstep
