#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "reference/text/memory.hpp"

namespace lockstep {

/// What a program's names are bound to in a run of it by itself.
struct MadeUpWorld {
    std::vector<std::vector<std::uint32_t>> words; ///< of its blocks, then of its images
    text::Bindings bindings;                       ///< refer to them; several may have one's words

    [[nodiscard]] MadeUpWorld copy() const;
    /// Whose words a block or an image has.
    [[nodiscard]] std::size_t words_of_block(std::size_t block) const;
    [[nodiscard]] std::size_t words_of_image(std::size_t image) const;
};

/// How the texels of an image lie in words.
struct TexelFormat {
    std::string name; ///< as Resource::format has it; empty: no state has such
    std::uint32_t components = 4;
    text::TexelMemory::Code code = text::TexelMemory::Code::number;
};

/// Of an image what its layout says; a sampler's texels have four components of 32 bits.
TexelFormat format_of(const text::ImageUniform& image);

} // namespace lockstep
