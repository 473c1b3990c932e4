#include "gpu/state_image.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

struct NamedFormat {
    std::string_view name;
    ImageFormat format;
};

constexpr std::array formats{
    NamedFormat{"r32f", {{GL_R32F, GL_RED, GL_FLOAT}, Scalar::float32, 1, 4}},
    NamedFormat{"rg32f", {{GL_RG32F, GL_RG, GL_FLOAT}, Scalar::float32, 2, 4}},
    NamedFormat{"rgba32f", {{GL_RGBA32F, GL_RGBA, GL_FLOAT}, Scalar::float32, 4, 4}},
    NamedFormat{"r16f", {{GL_R16F, GL_RED, GL_FLOAT}, Scalar::float32, 1, 2}},
    NamedFormat{"rg16f", {{GL_RG16F, GL_RG, GL_FLOAT}, Scalar::float32, 2, 2}},
    NamedFormat{"rgba16f", {{GL_RGBA16F, GL_RGBA, GL_FLOAT}, Scalar::float32, 4, 2}},
    NamedFormat{"r32i", {{GL_R32I, GL_RED_INTEGER, GL_INT}, Scalar::int32, 1, 4}},
    NamedFormat{"rgba32i", {{GL_RGBA32I, GL_RGBA_INTEGER, GL_INT}, Scalar::int32, 4, 4}},
    NamedFormat{"r32ui", {{GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT}, Scalar::uint32, 1, 4}},
    NamedFormat{"rgba32ui", {{GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT}, Scalar::uint32, 4, 4}},
    NamedFormat{"r8", {{GL_R8, GL_RED, GL_UNSIGNED_BYTE}, Scalar::uint32, 1, 1}},
    NamedFormat{"srgb8_alpha8", {{GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE}, Scalar::uint32, 4, 1}},
    NamedFormat{"rgba8", {{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE}, Scalar::uint32, 4, 1}},
};

bool are_codes(const ImageFormat& format) { return format.bytes == 1; }

std::size_t words(const Extent& extent, const ImageFormat& format) {
    return extent.count() * static_cast<std::size_t>(format.components);
}

} // namespace

ImageFormat image_format(const Resource& image) {
    std::string names;
    for (const NamedFormat& one : formats) {
        if (one.name == image.format) {
            const Field& field = image.fields.front();
            if (field.scalar == one.format.scalar && field.components == one.format.components)
                return one.format;
            const Field right{.name = {}, .scalar = one.format.scalar, .components = one.format.components};
            throw Error(fmt::format("'{}': its texels are {}s; an image of format {} has {}s", image.name,
                                    glsl_type(field), image.format, glsl_type(right)));
        }
        names += (names.empty() ? "" : ", ") + std::string(one.name);
    }
    throw Error(fmt::format("'{}': no image has format '{}'; there are {}", image.name, image.format, names));
}

GLenum sampler_type(const Resource& image) {
    const bool flat = image.dimensions == 2;
    const ImageFormat format = image_format(image);
    if (format.scalar == Scalar::float32 || are_codes(format))
        return flat ? GL_SAMPLER_2D : GL_SAMPLER_3D;
    if (format.scalar == Scalar::int32)
        return flat ? GL_INT_SAMPLER_2D : GL_INT_SAMPLER_3D;
    return flat ? GL_UNSIGNED_INT_SAMPLER_2D : GL_UNSIGNED_INT_SAMPLER_3D;
}

GLenum image_type(const Resource& image) {
    const bool flat = image.dimensions == 2;
    const ImageFormat format = image_format(image);
    if (format.scalar == Scalar::float32 || are_codes(format))
        return flat ? GL_IMAGE_2D : GL_IMAGE_3D;
    if (format.scalar == Scalar::int32)
        return flat ? GL_INT_IMAGE_2D : GL_INT_IMAGE_3D;
    return flat ? GL_UNSIGNED_INT_IMAGE_2D : GL_UNSIGNED_INT_IMAGE_3D;
}

GLenum StateImage::target() const { return about_->dimensions == 2 ? GL_TEXTURE_2D : GL_TEXTURE_3D; }

StateImage::StateImage(const Resource& image, const Extent& extent)
    : about_(&image), extent_(extent), format_(image_format(image)) {
    GLint limit = 0;
    gl::GetIntegerv(image.dimensions == 2 ? GL_MAX_TEXTURE_SIZE : GL_MAX_3D_TEXTURE_SIZE, &limit);
    const std::size_t longest = std::max({extent.width, extent.height, extent.depth});
    if (extent.count() == 0 || longest > static_cast<std::size_t>(limit))
        throw Error(fmt::format("'{}' of {} x {} x {} texels: this GL allows 1 to {} a side", image.name, extent.width,
                                extent.height, extent.depth, limit));
    put(nullptr);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl::TexParameteri(target(), filter, GL_NEAREST);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        gl::TexParameteri(target(), wrap, GL_CLAMP_TO_EDGE);
    gl::TexParameteri(target(), GL_TEXTURE_MAX_LEVEL, 0);
    check_gl(fmt::format("'{}' of {} x {} x {} texels", image.name, extent.width, extent.height, extent.depth));
}

void StateImage::bind() const {
    gl::BindTexture(target(), texture_.id());
    gl::PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl::PixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

void StateImage::put(const void* texels) {
    bind();
    const auto width = static_cast<GLsizei>(extent_.width), height = static_cast<GLsizei>(extent_.height);
    const TexelLayout& layout = format_.layout;
    if (about_->dimensions == 2)
        gl::TexImage2D(target(), 0, static_cast<GLint>(layout.internal), width, height, 0, layout.format, layout.type,
                       texels);
    else
        gl::TexImage3D(target(), 0, static_cast<GLint>(layout.internal), width, height,
                       static_cast<GLsizei>(extent_.depth), 0, layout.format, layout.type, texels);
}

void StateImage::upload(const View& state) {
    if (!are_codes(format_))
        return put(state.columns[0]);
    std::vector<std::uint8_t> codes(words(extent_, format_));
    for (std::size_t i = 0; i < codes.size(); ++i)
        codes[i] = static_cast<std::uint8_t>(state.columns[0][i * sizeof(std::uint32_t)]); // little-endian
    put(codes.data());
}

void StateImage::read(const WritableView& state) const {
    bind();
    if (!are_codes(format_)) {
        gl::GetTexImage(target(), 0, format_.layout.format, format_.layout.type, state.columns[0]);
        return check_gl(about_->name + ", read-back");
    }
    std::vector<std::uint8_t> codes(words(extent_, format_));
    gl::GetTexImage(target(), 0, format_.layout.format, format_.layout.type, codes.data());
    for (std::size_t i = 0; i < codes.size(); ++i) {
        const std::uint32_t word = codes[i];
        std::memcpy(state.columns[0] + i * sizeof word, &word, sizeof word);
    }
    check_gl(about_->name + ", read-back");
}

void StateImage::clear() {
    const std::vector<std::uint32_t> zeros(words(extent_, format_));
    put(zeros.data());
}

void StateImage::fill(std::uint32_t word) {
    if (format_.bytes < 4)
        return clear();
    const std::vector<std::uint32_t> all(words(extent_, format_), word);
    put(all.data());
}

void StateImage::copy(const StateImage& other) {
    std::vector<std::uint32_t> texels(words(extent_, format_));
    other.bind();
    gl::GetTexImage(target(), 0, format_.layout.format, format_.layout.type, texels.data());
    put(texels.data());
}

} // namespace lockstep
