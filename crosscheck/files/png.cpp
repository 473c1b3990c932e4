#include "crosscheck/files/png.hpp"

#include <utility>

#include <png.h>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {

std::string png(const ColorImage& image) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = static_cast<png_uint_32>(image.width);
    header.height = static_cast<png_uint_32>(image.height);
    header.format = PNG_FORMAT_RGBA;
    const auto bottom_up = -4 * image.width; // a negative stride: our row 0 is the bottom one
    std::string file(PNG_IMAGE_PNG_SIZE_MAX(header), '\0');
    png_alloc_size_t size = file.size();
    if (png_image_write_to_memory(&header, file.data(), &size, 0, image.texels.data(), bottom_up, nullptr) == 0)
        throw Error(fmt::format("no PNG of {} x {} pixels: {}", image.width, image.height, header.message));
    file.resize(size);
    return file;
}

ColorImage read_png(std::string_view bytes, const std::string& name, int largest) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0)
        throw Error(fmt::format("{}: {}; right is a PNG file", name, header.message));
    if (header.width > static_cast<png_uint_32>(largest) || header.height > static_cast<png_uint_32>(largest)) {
        const auto [width, height] = std::pair(header.width, header.height);
        png_image_free(&header);
        throw Error(fmt::format("{}: {} x {} pixels; right is at most {} along a side", name, width, height, largest));
    }
    header.format = PNG_FORMAT_RGBA;
    ColorImage image(static_cast<int>(header.width), static_cast<int>(header.height));
    if (png_image_finish_read(&header, nullptr, image.texels.data(), -4 * image.width, nullptr) == 0)
        throw Error(fmt::format("{}: {}; right is a whole PNG file", name, header.message));
    return image;
}

} // namespace lockstep
