#include "gpu/encode_pass.hpp"

#include <bit>
#include <vector>

namespace lockstep {
namespace {

std::vector<float> thresholds(int /*frame*/) {
    std::vector<float> all;
    for (const std::uint32_t bits : srgb_threshold_bits)
        all.push_back(std::bit_cast<float>(bits));
    return all;
}

} // namespace

void add_encode_pass(Encoding encoding, std::uint8_t encoded, std::uint8_t any_buffer, GlPassList& all) {
    if (encoding == Encoding::srgb_hw)
        all.add("encode_by_gl_pass", Stage::vertex, encoded).draw =
            GlDraw{.buffer = any_buffer, .primitive = GlDraw::Primitive::triangles, .vertices = 3, .once = true};
    else
        all.add("encode_pass", Stage::compute, encoded).data["thresholdBuffer"] = thresholds;
}

} // namespace lockstep
