#include "gpu/collision/stored_codes.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/gtc/packing.hpp>

namespace lockstep {
namespace {

void store(float value, std::uint16_t& half) { half = glm::packHalf1x16(value); }
void store(float value, std::uint8_t& code) { code = static_cast<std::uint8_t>(value); }
float to_float(std::uint16_t half) { return glm::unpackHalf1x16(half); }
float to_float(std::uint8_t code) { return static_cast<float>(code); }

template <class Component> std::vector<Component> converted(const CollisionImage& image) {
    std::vector<Component> stored(image.texels.size() * 4);
    const auto n = static_cast<std::ptrdiff_t>(stored.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i)
        store(image.texels[i / 4][static_cast<int>(i % 4)], stored[i]);
    return stored;
}

template <class Component>
void read_converted(CollisionImage& image, GLenum type, const std::function<void(GLenum, void*)>& transfer) {
    std::vector<Component> stored(image.texels.size() * 4);
    transfer(type, stored.data());
    const auto n = static_cast<std::ptrdiff_t>(stored.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i)
        image.texels[i / 4][static_cast<int>(i % 4)] = to_float(stored[i]);
}

} // namespace

GLenum stored_format(CdtFormat format) {
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

void upload_codes(const CollisionImage& image, CdtFormat format,
                  const std::function<void(GLenum, const void*)>& transfer) {
    switch (format) {
    case CdtFormat::rgba32f:
        return transfer(GL_FLOAT, image.texels.data());
    case CdtFormat::rgba16f:
        return transfer(GL_HALF_FLOAT, converted<std::uint16_t>(image).data());
    case CdtFormat::rgba8:
        return transfer(GL_UNSIGNED_BYTE, converted<std::uint8_t>(image).data());
    }
}

void read_codes(CollisionImage& image, CdtFormat format, const std::function<void(GLenum, void*)>& transfer) {
    switch (format) {
    case CdtFormat::rgba32f:
        return transfer(GL_FLOAT, image.texels.data());
    case CdtFormat::rgba16f:
        return read_converted<std::uint16_t>(image, GL_HALF_FLOAT, transfer);
    case CdtFormat::rgba8:
        return read_converted<std::uint8_t>(image, GL_UNSIGNED_BYTE, transfer);
    }
}

} // namespace lockstep
