#include "crosscheck/judge/coded_image.hpp"

#include <cstddef>
#include <cstdint>

namespace lockstep {

ColorImage coded_image(const SystemState& state, FieldId codes) {
    const Extent extent = state.extent(codes.resource);
    ColorImage image(static_cast<int>(extent.width), static_cast<int>(extent.height));
    const SystemView seen = state.view();
    for (std::size_t i = 0; i < extent.count(); ++i) {
        const auto code = [&](int c) { return static_cast<std::uint8_t>(seen.word(codes, i, c)); };
        image.texels[i] = {code(0), code(1), code(2), 255};
    }
    return image;
}

} // namespace lockstep
