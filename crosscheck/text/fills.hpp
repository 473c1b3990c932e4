#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "reference/text/memory.hpp"

namespace lockstep {

/// What blocks, members of blocks (NAME.member) and images hold instead of numbers that look random: `zero`, `iota`,
/// which is 0, 1, 2, ... one after the other, or one number for all.
using Fills = std::map<std::string, std::string>;

/// Names that Fills may have.
std::vector<std::string> fill_names(const text::Program& program);
/// Of these, members and images of integers that are arrays: such as others are indexed by.
std::vector<std::string> index_names(const text::Program& program);

/// `count`: elements of the array at the block's end. Throws Error for what is no number of the type.
void fill_block(const Fills& fills, const text::Block& block, std::size_t count, std::span<std::uint32_t> words);
void fill_image(const Fills& fills, const text::ImageUniform& image, const text::TexelMemory& texels);

} // namespace lockstep
