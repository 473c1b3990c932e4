#include "crosscheck/files/png.hpp"

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

} // namespace lockstep
