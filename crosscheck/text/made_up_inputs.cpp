#include "crosscheck/text/made_up_inputs.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/files/number_table.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "reference/half.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// Floats from 0 to 1 that look random, the same everywhere.
class MadeUp {
  public:
    explicit MadeUp(std::uint32_t seed) : state_(seed * 747796405U + 2891336453U) {}

    std::uint32_t word() { return std::bit_cast<std::uint32_t>(static_cast<float>(bits() >> 8U) * 0x1p-24F); }
    /// An integer below `end`; 0 where that is 0.
    std::uint32_t integer(std::uint32_t end) {
        return end == 0 ? 0 : static_cast<std::uint32_t>(std::uint64_t{bits()} * end >> 32U);
    }

  private:
    std::uint32_t bits() {
        state_ = state_ * 747796405U + 2891336453U;
        const std::uint32_t mixed = ((state_ >> ((state_ >> 28U) + 4U)) ^ state_) * 277803737U;
        return (mixed >> 22U) ^ mixed;
    }
    std::uint32_t state_;
};

/// How the numbers of a uniform, an input or a block's member are written; of integers the text has the sign.
template <class Variable> TableColumn numbers_of(const Variable& of) {
    TableColumn column{.name = {}, .scalar = of.is_real ? Scalar::float32 : Scalar::int32};
    if constexpr (requires { of.is_boolean; })
        column.is_bool = of.is_boolean;
    return column;
}

/// The words of `cells` numbers that are given for `name`.
std::vector<std::uint32_t> words_of(std::string_view option, std::string_view name, std::size_t cells,
                                    const TableColumn& column, const std::vector<std::string>& given) {
    if (given.size() != cells)
        throw Error(fmt::format("{} {}: expected {} numbers, got {}", option, name, cells, given.size()));
    std::vector<std::uint32_t> words;
    for (const std::string& number : given) {
        std::optional<std::uint32_t> word = number_bits(number, column);
        if (!word && column.scalar == Scalar::int32 && !column.is_bool)
            word = number_bits(number, {.name = {}, .scalar = Scalar::uint32});
        if (!word)
            throw Error(fmt::format("{} {}: '{}' is {}", option, name, plain_line(number), no_number(column)));
        words.push_back(*word);
    }
    return words;
}

std::vector<std::uint32_t> block_words(const Examination& of, const text::Block& block, std::size_t count,
                                       MadeUp& made_up) {
    std::vector<std::uint32_t> words(block.words(count));
    const auto fill = [&](std::size_t first, const std::vector<text::Leaf>& leaves, std::uint32_t integers) {
        for (const text::Leaf& leaf : leaves)
            words.at(first + leaf.word) = leaf.is_real ? made_up.word() : made_up.integer(integers);
    };
    if (block.name != block_of_uniforms)
        fill(0, block.leaves, 0);
    for (std::size_t i = 0; block.array_stride > 0 && i < count; ++i)
        fill((block.array_offset + i * block.array_stride) / text::word_bytes, block.element, of.integers);
    fill_block(of.fills, block, count, words);
    give_members(of, block, words);
    return words;
}

/// A float from 0 to 1 as a texel's word has it.
std::uint32_t code_of(std::uint32_t word, text::TexelMemory::Code code) {
    const auto x = std::bit_cast<float>(word);
    return code == text::TexelMemory::Code::unorm8 ? static_cast<std::uint32_t>(x * 255.0F)
           : code == text::TexelMemory::Code::half ? std::bit_cast<std::uint32_t>(half_nearest(x))
                                                   : word;
}

/// Invocations along each axis; of stages other than compute they lie in a square whose sides are even.
std::array<std::uint32_t, 3> extent_of(const Examination& of, const text::Program& program) {
    if (program.stage != spv::ExecutionModelGLCompute) {
        const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(invocations_of(of, program)) / 2.0));
        return {2 * side, 2 * side, 1};
    }
    std::array<std::uint32_t, 3> invocations{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        invocations[axis] = of.groups[axis] * program.group[axis];
    return invocations;
}

/// Blocks to which the text gives one binding are one buffer (GL 4.6, 7.8): the longest's words.
void share_buffers(const std::vector<text::Block>& blocks, std::vector<std::span<std::uint32_t>>& words) {
    const std::vector<std::span<std::uint32_t>> own = words;
    for (std::size_t a = 0; a < blocks.size(); ++a) {
        if (!blocks[a].binding)
            continue;
        std::span<std::uint32_t> longest;
        for (std::size_t b = 0; b < blocks.size(); ++b)
            if (blocks[a].binding == blocks[b].binding && blocks[a].is_storage == blocks[b].is_storage &&
                own[b].size() > longest.size())
                longest = own[b];
        words[a] = longest;
    }
}

/// Images to which the text gives one unit are one image (GL 4.6, 8.26). Throws Error where their kinds, sizes or
/// formats differ, since GL then defines nothing; one that is only stored to need not have a format.
void share_images(const std::vector<text::ImageUniform>& images, std::vector<text::TexelMemory>& memory) {
    const auto kind = [&](std::size_t i) {
        const text::ImageShape& shape = images[i].shape;
        return std::tuple(shape.dimensions, shape.is_arrayed, shape.has_samples, images[i].is_real, images[i].is_signed,
                          memory[i].size);
    };
    const auto has_format = [&](std::size_t i) { return images[i].shape.format != spv::ImageFormatUnknown; };
    const auto take = [&](std::size_t to, std::size_t from) {
        memory[to].words = memory[from].words;
        memory[to].components = memory[from].components;
        memory[to].code = memory[from].code;
    };
    for (std::size_t a = 0; a < images.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            if (!images[a].is_storage || !images[b].is_storage || !images[a].binding ||
                images[a].binding != images[b].binding)
                continue;
            if (kind(a) != kind(b) ||
                (has_format(a) && has_format(b) && images[a].shape.format != images[b].shape.format))
                throw Error(
                    fmt::format("images {} and {} are on one unit, {}; expected one type, one size and one format",
                                images[b].name, images[a].name, images[a].binding->number));
            if (has_format(b))
                take(a, b);
            else
                take(b, a);
        }
}

std::uint32_t made_up_size(const text::ImageShape& shape, std::uint32_t axis,
                           const std::array<std::uint32_t, 3>& invocations) {
    constexpr std::uint32_t samples = 4, faces = 6;
    if (shape.dimensions == spv::DimCube)
        return axis == 2 ? faces : invocations[0];
    return shape.has_samples && axis + 1 == shape.axes() ? samples : invocations[axis];
}

constexpr std::size_t most_made_up = std::size_t{1} << 26U; ///< words that are made up, and invocations that run

/// The product of `numbers`. Throws Error where it is more than `most_made_up`; `what`: what it counts.
std::size_t counted(std::string_view option, std::string_view what, std::initializer_list<std::size_t> numbers) {
    std::size_t product = 1;
    for (const std::size_t number : numbers) {
        if (number > 0 && product > most_made_up / number)
            throw Error(
                fmt::format("{}: {} {}; expected at most {}", option, fmt::join(numbers, " * "), what, most_made_up));
        product *= number;
    }
    return product;
}

} // namespace

std::uint32_t invocations_of(const Examination& of, const text::Program& program) {
    return program.stage == spv::ExecutionModelFragment ? (of.invocations + 3) / 4 * 4 : of.invocations;
}

void check_invocations(const Examination& of, const text::Program& program) {
    const std::array<std::uint32_t, 3>& groups = of.groups;
    if (program.stage == spv::ExecutionModelGLCompute)
        counted(fmt::format("--groups {}", fmt::join(groups, ",")), "invocations",
                {groups[0], groups[1], groups[2], program.invocations()});
    else
        counted(fmt::format("--invocations {}", of.invocations), "vertices",
                {invocations_of(of, program), std::max(program.most_vertices, 1U)});
}

void give_members(const Examination& of, const text::Block& block, std::vector<std::uint32_t>& words) {
    for (const text::Block::Member& member : block.members)
        if (const auto given = of.uniforms.find(member.name); given != of.uniforms.end()) {
            const std::vector<std::uint32_t> numbers = words_of("--uniform", member.name, member.leaves.size(),
                                                                numbers_of(member.leaves.front()), given->second);
            for (std::size_t i = 0; i < numbers.size(); ++i)
                words.at(member.leaves[i].word) = numbers[i];
        }
}

std::vector<std::vector<std::uint32_t>> given_uniforms(const Examination& of, const text::Program& program) {
    std::vector<std::vector<std::uint32_t>> all;
    for (const text::PlainUniform& uniform : program.uniforms) {
        if (const auto known = of.uniform_words.find(uniform.name);
            known != of.uniform_words.end() && known->second.size() == uniform.cells) {
            all.push_back(known->second);
            continue;
        }
        const auto given = of.uniforms.find(uniform.name);
        all.push_back(given == of.uniforms.end()
                          ? std::vector<std::uint32_t>{}
                          : words_of("--uniform", uniform.name, uniform.cells, numbers_of(uniform), given->second));
    }
    return all;
}

MadeUpWorld made_up_world(const Examination& of, const text::Program& program) {
    MadeUp made_up(of.seed);
    MadeUpWorld world;
    world.words.reserve(program.blocks.size() + program.images.size());
    const std::array<std::uint32_t, 3> invocations = extent_of(of, program);
    const auto size_of = [&](const std::string& name) {
        const auto found = of.sizes.find(name);
        return found == of.sizes.end() ? std::vector<std::uint32_t>{} : found->second;
    };
    std::size_t taken = 0;
    const auto take = [&](const std::string& name, std::initializer_list<std::size_t> numbers) {
        const std::size_t words = counted(fmt::format("--size {}", name), "words", numbers);
        taken += words;
        counted(fmt::format("--size {}", name), "words of blocks and images together", {taken});
        return words;
    };
    for (const text::Block& block : program.blocks) {
        const std::vector<std::uint32_t> size = size_of(block.name);
        if (!size.empty() && (block.array_stride == 0 || size.size() != 1))
            throw Error(fmt::format("--size {}: expected one number, of a block that ends with an array without a "
                                    "length",
                                    block.name));
        const std::size_t count = !size.empty() ? size[0]
                                  : program.stage == spv::ExecutionModelGLCompute
                                      ? std::size_t{invocations[0]} * invocations[1] * invocations[2]
                                      : invocations_of(of, program);
        take(block.name, {block.words(count)});
        world.words.push_back(block_words(of, block, count, made_up));
        world.bindings.blocks.emplace_back(world.words.back());
    }
    share_buffers(program.blocks, world.bindings.blocks);
    for (const text::ImageUniform& image : program.images) {
        const TexelFormat format = format_of(image);
        text::TexelMemory texels{.name = image.name, .components = format.components, .code = format.code};
        const std::uint32_t axes = image.shape.axes();
        const std::vector<std::uint32_t> size = size_of(image.name);
        if (!size.empty() && size.size() != axes)
            throw Error(fmt::format("--size {}: expected {} numbers, texels along each axis", image.name, axes));
        if (std::ranges::find(size, 0U) != size.end() ||
            (!size.empty() && image.shape.dimensions == spv::DimCube && (size[0] != size[1] || size[2] % 6 != 0)))
            throw Error(fmt::format("--size {}: expected texels along each axis from 1, of a cube N,N,6", image.name));
        for (std::uint32_t axis = 0; axis < axes; ++axis)
            texels.size[axis] = size.empty() ? made_up_size(image.shape, axis, invocations) : size[axis];
        std::vector<std::uint32_t>& all = world.words.emplace_back(
            take(image.name, {texels.size[0], texels.size[1], texels.size[2], texels.components}));
        for (std::uint32_t& word : all)
            word = image.is_real ? code_of(made_up.word(), format.code) : made_up.integer(of.integers);
        texels.words = all;
        fill_image(of.fills, image, texels);
        world.bindings.images.push_back(texels);
    }
    share_images(program.images, world.bindings.images);
    world.bindings.uniforms = given_uniforms(of, program);
    return world;
}

text::StageRun made_up_run(const Examination& of, const text::Program& program) {
    text::StageRun run{.invocations = invocations_of(of, program),
                       .is_watched = true,
                       .most_branches = most_branches,
                       .subgroup_size = of.subgroup_size,
                       .keeps_outputs = !of.reference.empty()};
    run.are_quads = program.stage == spv::ExecutionModelFragment;
    const std::uint32_t side = extent_of(of, program)[0];
    MadeUp made_up(of.seed + 1);
    for (const text::StageVariable& input : program.stage_inputs) {
        const std::string name = text::name_of(input);
        if (const auto given = of.inputs.find(name); given != of.inputs.end()) {
            run.inputs[name] = words_of("--input", name, input.words(), numbers_of(input), given->second);
        } else if (text::needs_words(input)) {
            std::vector<std::uint32_t>& words = run.inputs[name];
            const std::size_t count = counted(fmt::format("--invocations {}: input {}", of.invocations, name), "words",
                                              {run.invocations, input.words()});
            for (std::size_t w = 0; w < count; ++w)
                words.push_back(input.is_real ? made_up.word() : 0U);
            for (std::uint32_t i = 0; input.builtin == spv::BuiltInFragCoord && i < run.invocations; ++i) {
                const std::uint32_t quad = i / 4, across = side / 2; // pixel centres, quad after quad
                const std::array<std::uint32_t, 2> pixel{quad % across * 2 + i % 2, quad / across * 2 + i / 2 % 2};
                for (std::size_t c = 0; c < pixel.size(); ++c)
                    words[4 * i + c] = std::bit_cast<std::uint32_t>(static_cast<float>(pixel[c]) + 0.5F);
                words[4 * i + 3] = std::bit_cast<std::uint32_t>(1.0F);
            }
        }
    }
    return run;
}

} // namespace lockstep
