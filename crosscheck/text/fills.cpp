#include "crosscheck/text/fills.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "crosscheck/files/number_table.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "reference/half.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// The number `number` of a row of them.
std::uint32_t filled_word(const std::string& name, const std::string& fill, std::size_t number, bool is_real) {
    const auto word = [&](std::size_t n) {
        return is_real ? std::bit_cast<std::uint32_t>(static_cast<float>(n)) : static_cast<std::uint32_t>(n);
    };
    if (fill == "zero")
        return word(0);
    if (fill == "iota")
        return word(number);
    const TableColumn column{.name = {}, .scalar = is_real ? Scalar::float32 : Scalar::int32};
    std::optional<std::uint32_t> bits = number_bits(fill, column);
    if (!bits && !is_real)
        bits = number_bits(fill, {.name = {}, .scalar = Scalar::uint32});
    if (!bits)
        throw Error(fmt::format("--fill {}: expected iota, zero or a number; '{}' is {}", name, plain_line(fill),
                                no_number(column)));
    return *bits;
}

/// Calls f(name, scalars, whether it is of the array at the block's end) for each member.
template <class F> void each_member(const text::Block& block, const F& f) {
    const auto named = [&](const text::Block::Member& member) {
        return member.name.starts_with(block.name + ".") ? member.name : block.name + "." + member.name;
    };
    for (const text::Block::Member& member : block.members)
        f(named(member), member.leaves, false);
    for (const text::Block::Member& member : block.element_members)
        f(named(member), member.leaves, true);
}

bool has_integers(const std::vector<text::Leaf>& leaves) {
    return std::ranges::any_of(leaves, [](const text::Leaf& leaf) { return !leaf.is_real; });
}

} // namespace

std::vector<std::string> fill_names(const text::Program& program) {
    std::vector<std::string> names;
    for (const text::Block& block : program.blocks) {
        names.push_back(block.name);
        each_member(block, [&](const std::string& name, const auto&, bool) { names.push_back(name); });
    }
    for (const text::ImageUniform& image : program.images)
        names.push_back(image.name);
    return names;
}

std::vector<std::string> index_names(const text::Program& program) {
    std::vector<std::string> names;
    for (const text::Block& block : program.blocks)
        each_member(block, [&](const std::string& name, const std::vector<text::Leaf>& leaves, bool in_array) {
            constexpr std::size_t longest_vector = 4;
            if (has_integers(leaves) && (in_array || leaves.size() > longest_vector))
                names.push_back(name);
        });
    for (const text::ImageUniform& image : program.images)
        if (!image.is_real)
            names.push_back(image.name);
    return names;
}

void fill_block(const Fills& fills, const text::Block& block, std::size_t count, std::span<std::uint32_t> words) {
    const auto fill = [&](const std::string& name, const std::string& value, const std::vector<text::Leaf>& leaves,
                          bool in_array) {
        std::size_t number = 0;
        for (std::size_t i = 0; i < (in_array ? count : 1); ++i)
            for (const text::Leaf& leaf : leaves) {
                const std::size_t first =
                    in_array ? (block.array_offset + i * block.array_stride) / text::word_bytes : 0;
                words[first + leaf.word] = filled_word(name, value, number++, leaf.is_real);
            }
    };
    if (const auto whole = fills.find(block.name); whole != fills.end()) {
        fill(block.name, whole->second, block.leaves, false);
        each_member(block, [&](const std::string&, const std::vector<text::Leaf>& leaves, bool in_array) {
            fill(block.name, whole->second, leaves, in_array);
        });
    }
    each_member(block, [&](const std::string& name, const std::vector<text::Leaf>& leaves, bool in_array) {
        if (const auto given = fills.find(name); given != fills.end())
            fill(name, given->second, leaves, in_array);
    });
}

void fill_image(const Fills& fills, const text::ImageUniform& image, const text::TexelMemory& texels) {
    const auto given = fills.find(image.name);
    if (given == fills.end())
        return;
    for (std::size_t w = 0; w < texels.words.size(); ++w) {
        const std::uint32_t word = filled_word(image.name, given->second, w, image.is_real);
        const auto x = std::bit_cast<float>(word);
        texels.words[w] = texels.code == text::TexelMemory::Code::unorm8
                              ? static_cast<std::uint32_t>(std::clamp(x, 0.0F, 1.0F) * 255.0F)
                          : texels.code == text::TexelMemory::Code::half ? std::bit_cast<std::uint32_t>(half_nearest(x))
                                                                         : word;
    }
}

} // namespace lockstep
