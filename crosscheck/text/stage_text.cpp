#include "crosscheck/text/stage_text.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/files/plain_text.hpp"
#include "gpu/any_dialect.hpp"
#include "reference/model/error.hpp"
#include "reference/text/stage_run.hpp"

namespace lockstep {
namespace {

/// The structure that a block is, or a counter's type, by the block's name in Program; nothing: it has none.
std::optional<std::uint32_t> type_of_block(const text::Module& module, std::string_view name) {
    name = name.substr(0, name.find('['));
    for (const text::Variable& variable : module.variables) {
        const text::Type& held = module.types[variable.type];
        const bool is_array = held.kind == text::Type::Kind::array;
        const std::uint32_t type = is_array ? held.element : variable.type;
        if ((variable.storage == spv::StorageClassUniform || variable.storage == spv::StorageClassStorageBuffer ||
             variable.storage == spv::StorageClassPushConstant) &&
            module.types[type].kind == text::Type::Kind::structure && module.types[type].name == name)
            return type;
        if (variable.storage == spv::StorageClassAtomicCounter && module.ids[variable.id].name == name)
            return type;
    }
    return {};
}

/// ".y", or "[7]" of what is no vector; nothing of a single number.
std::string component_name(std::size_t which, std::size_t count) {
    constexpr std::string_view names = "xyzw";
    return count == 1              ? std::string()
           : count <= names.size() ? fmt::format(".{}", names[which])
                                   : fmt::format("[{}]", which);
}

/// What lies at a byte of a type: ".boids[3].velocity.y".
NamedWord word_in(const text::Module& module, std::uint32_t type_id, std::size_t byte) {
    using enum text::Type::Kind;
    const text::Type& type = module.types[type_id];
    const auto within = [&](std::string name, std::uint32_t part, std::size_t rest) {
        NamedWord inner = word_in(module, part, rest);
        return NamedWord{std::move(name) + inner.name, inner.is_real};
    };
    switch (type.kind) {
    case structure: {
        const text::Type::Member* last = nullptr;
        for (const text::Type::Member& one : type.members)
            if (one.offset <= byte && (last == nullptr || one.offset >= last->offset))
                last = &one;
        if (last == nullptr)
            return {"", false};
        if (const text::Type& matrix_type = module.types[last->type];
            matrix_type.kind == matrix && last->matrix_stride > 0) {
            const std::size_t line = (byte - last->offset) / last->matrix_stride,
                              place = (byte - last->offset) % last->matrix_stride / text::word_bytes;
            return {fmt::format(".{}[{}][{}]", last->name, last->is_row_major ? place : line,
                                last->is_row_major ? line : place),
                    true};
        }
        return within("." + last->name, last->type, byte - last->offset);
    }
    case array:
        if (type.stride > 0)
            return within(fmt::format("[{}]", byte / type.stride), type.element, byte % type.stride);
        return {"", false};
    case vector:
        return within(component_name(byte / text::word_bytes, type.count), type.element, 0);
    default:
        return {"", type.kind == real || type.kind == matrix};
    }
}

NamedWord word_of_block(const StageText& stage, std::uint32_t block, std::size_t word) {
    const std::string& name = stage.program.blocks[block].name;
    const std::optional<std::uint32_t> type = type_of_block(stage.module, name);
    if (!type)
        return {fmt::format("{} word {}", name, word), false};
    const NamedWord found = word_in(stage.module, *type, word * text::word_bytes);
    return {name + found.name, found.is_real};
}

NamedWord word_of_image(const text::ImageUniform& image, const text::TexelMemory& texels, std::size_t word) {
    std::size_t texel = word / texels.components;
    std::string place;
    for (std::uint32_t axis = 0; axis < std::min(image.shape.axes(), 3U); ++axis) {
        place += fmt::format("{}{}", axis > 0 ? ", " : "", texel % texels.size[axis]);
        texel /= texels.size[axis];
    }
    return {fmt::format("{}({}){}", image.name, place, component_name(word % texels.components, texels.components)),
            image.is_real && texels.code != text::TexelMemory::Code::unorm8};
}

} // namespace

std::optional<Stage> stage_of(const std::filesystem::path& file) {
    const std::filesystem::path glsl = file.extension() == ".spv" ? file.stem() : file.filename();
    for (const Stage stage : {Stage::compute, Stage::vertex, Stage::geometry, Stage::fragment})
        if (glsl.extension() == extension(stage))
            return stage;
    return std::nullopt;
}

StageText read_stage(const std::filesystem::path& file, const ShaderDefines& defines, ConstantExpressions constants) {
    const std::optional<Stage> stage = stage_of(file);
    if (!stage)
        throw Error(
            fmt::format("{}: expected a stage NAME.comp, NAME.vert, NAME.geom or NAME.frag, or one of these with "
                        ".spv behind it",
                        plain_line(file.string())));
    return stage_text(std::make_shared<const ShaderSource>(load_any_dialect(file, *stage, defines)),
                      plain_line(file.string()), constants);
}

StageText stage_text(std::shared_ptr<const ShaderSource> source, std::string file, ConstantExpressions constants) {
    text::Module module = text::read_module(spirv_of(*source, constants),
                                            [source](std::uint32_t line) { return line_name(*source, line); });
    text::Program program = text::decoded(module);
    return {std::move(file), std::move(source), std::move(module), std::move(program)};
}

std::string line_text(const ShaderSource& stage, std::uint32_t line) {
    std::string_view rest = stage.text;
    for (std::uint32_t at = 1; at < line && !rest.empty(); ++at)
        rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
    rest = rest.substr(0, rest.find('\n'));
    if (const std::size_t comment = rest.find("//"); comment != std::string_view::npos)
        rest = rest.substr(0, comment);
    const std::size_t first = rest.find_first_not_of(" \t"), last = rest.find_last_not_of(" \t\r");
    return first == std::string_view::npos ? std::string() : std::string(rest.substr(first, last - first + 1));
}

NamedWord named_word(const StageText& stage, const text::Bindings& bindings, const text::WrittenPlace& place) {
    using Space = text::WrittenPlace::Space;
    if (place.space == Space::block)
        return word_of_block(stage, place.number, place.word);
    if (place.space == Space::texel)
        return word_of_image(stage.program.images[place.number], bindings.images[place.number], place.word);
    for (const text::StageVariable& output : stage.program.stage_outputs)
        if (place.word >= output.cell && place.word < output.cell + output.cells)
            return {text::name_of(output) + component_name(place.word - output.cell, output.cells), output.is_real};
    return {fmt::format("output {}", place.word), false};
}

} // namespace lockstep
