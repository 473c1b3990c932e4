#include "crosscheck/png.hpp"

#include <png.h>

#include <fmt/format.h>

#include "crosscheck/atomic_file.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

void write_png(const std::filesystem::path& path, const ColorImage& image) {
    write_atomically(path, [&](const std::filesystem::path& temporary) {
        png_image png{};
        png.version = PNG_IMAGE_VERSION;
        png.width = static_cast<png_uint_32>(image.width);
        png.height = static_cast<png_uint_32>(image.height);
        png.format = PNG_FORMAT_RGBA;
        const auto bottom_up = -4 * image.width; // a negative stride: our row 0 is the bottom one
        if (png_image_write_to_file(&png, temporary.c_str(), 0, image.texels.data(), bottom_up, nullptr) == 0)
            throw Error(fmt::format("{}: cannot be written: {}", path.string(), png.message));
    });
}

} // namespace lockstep
