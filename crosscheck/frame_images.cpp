#include "crosscheck/frame_images.hpp"

#include <vector>

#include "crosscheck/pictures.hpp"
#include "crosscheck/png.hpp"

namespace lockstep {

void FrameImages::keep(const ComparedFrame& frame) {
    if (differs_)
        return;
    frame_ = frame.frame;
    differs_ = !frame.comparison.agree();
    reference_ = frame.reference;
    gpu_ = frame.gpu;
    reference_cdt_ = frame.reference_cdt;
    gpu_cdt_ = frame.gpu_cdt;
}

void FrameImages::write(const std::filesystem::path& directory) const {
    if (frame_ < 0)
        return;
    const Box box = code_box(reference_cdt_);
    const std::vector<std::pair<const char*, ColorImage>> pictures{
        {"cdt_reference.png", picture(reference_cdt_, box)},
        {"cdt_gpu.png", picture(gpu_cdt_, box)},
        {"cdt_difference.png", difference_picture(reference_cdt_, gpu_cdt_)},
    };
    std::vector<std::filesystem::path> written;
    try {
        for (const auto& [name, image] : pictures) {
            write_png(directory / name, image);
            written.push_back(directory / name);
        }
    } catch (...) {
        for (const std::filesystem::path& path : written)
            std::filesystem::remove(path);
        throw;
    }
}

} // namespace lockstep
