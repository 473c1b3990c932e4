#include "crosscheck/text/made_up_world.hpp"

#include <algorithm>
#include <span>

namespace lockstep {

std::size_t MadeUpWorld::words_of_block(std::size_t block) const {
    const auto found =
        std::ranges::find(words, bindings.blocks[block].data(), [](const auto& one) { return one.data(); });
    return static_cast<std::size_t>(found - words.begin());
}

std::size_t MadeUpWorld::words_of_image(std::size_t image) const {
    const auto found =
        std::ranges::find(words, bindings.images[image].words.data(), [](const auto& one) { return one.data(); });
    return static_cast<std::size_t>(found - words.begin());
}

MadeUpWorld MadeUpWorld::copy() const {
    MadeUpWorld made{words, bindings};
    for (std::size_t b = 0; b < bindings.blocks.size(); ++b)
        made.bindings.blocks[b] = std::span(made.words[words_of_block(b)]).first(bindings.blocks[b].size());
    for (std::size_t i = 0; i < bindings.images.size(); ++i)
        made.bindings.images[i].words = made.words[words_of_image(i)];
    return made;
}

TexelFormat format_of(const text::ImageUniform& image) {
    using enum text::TexelMemory::Code;
    switch (image.shape.format) {
    case spv::ImageFormatUnknown:
        return {image.is_real ? "rgba32f" : image.is_signed ? "rgba32i" : "rgba32ui"};
    case spv::ImageFormatRgba32f:
        return {"rgba32f"};
    case spv::ImageFormatRg32f:
        return {"rg32f", 2};
    case spv::ImageFormatR32f:
        return {"r32f", 1};
    case spv::ImageFormatRgba16f:
        return {"rgba16f", 4, half};
    case spv::ImageFormatRg16f:
        return {"rg16f", 2, half};
    case spv::ImageFormatR16f:
        return {"r16f", 1, half};
    case spv::ImageFormatRgba8:
        return {"rgba8", 4, unorm8};
    case spv::ImageFormatR8:
        return {"r8", 1, unorm8};
    case spv::ImageFormatRgba32i:
        return {"rgba32i"};
    case spv::ImageFormatR32i:
        return {"r32i", 1};
    case spv::ImageFormatRgba32ui:
        return {"rgba32ui"};
    case spv::ImageFormatR32ui:
        return {"r32ui", 1};
    default:
        return {""};
    }
}

} // namespace lockstep
