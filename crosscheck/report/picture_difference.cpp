#include "crosscheck/report/picture_difference.hpp"

#include <cstddef>
#include <cstdint>

namespace lockstep {
namespace {

constexpr Rgba8 pixel_differs{230, 60, 50, 255};

} // namespace

ColorImage difference_picture(const ColorImage& reference, const ColorImage& gpu) {
    ColorImage image = reference;
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        Rgba8& pixel = image.texels[i];
        if (pixel == gpu.texels[i])
            pixel = {static_cast<std::uint8_t>(pixel.r / 3), static_cast<std::uint8_t>(pixel.g / 3),
                     static_cast<std::uint8_t>(pixel.b / 3), 255};
        else
            pixel = pixel_differs;
    }
    return image;
}

} // namespace lockstep
