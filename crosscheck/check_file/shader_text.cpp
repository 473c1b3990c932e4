#include "crosscheck/check_file/shader_text.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/check_file/value_words.hpp"
#include "crosscheck/text/glsl_module.hpp"

namespace lockstep::check_file {
namespace {

std::string suffix_of(std::string_view member) {
    std::string name;
    for (const char c : member)
        if (c == '.' || c == '[')
            name += '_';
        else if (c != ']')
            name += c;
    return name;
}

/// "position" of "boids.position", where an element is a structure; "data" of "data".
std::string field_name(const std::string& member) {
    const std::size_t dot = member.find('.');
    return suffix_of(dot == std::string::npos ? std::string_view(member) : std::string_view(member).substr(dot + 1));
}

/// A field for each vector of a member: columns of matrices and elements of arrays by themselves.
void add_fields(const text::Block::Member& member, Record& to) {
    const text::BasicType& type = member.type;
    const std::string name = field_name(member.name);
    const std::size_t vectors = member.leaves.size() / type.rows;
    for (std::size_t v = 0; v < vectors; ++v) {
        const auto leaf = [&](std::uint32_t r) { return member.leaves[v * type.rows + r].word; };
        const std::string of_vector = vectors == 1 ? name : fmt::format("{}_{}", name, v);
        if (leaf(type.rows - 1) == leaf(0) + type.rows - 1) {
            to.fields.push_back({.name = of_vector,
                                 .scalar = scalar_of(type),
                                 .components = static_cast<int>(type.rows),
                                 .at = leaf(0)});
            continue;
        }
        for (std::uint32_t r = 0; r < type.rows; ++r) // a matrix by rows
            to.fields.push_back({.name = fmt::format("{}_{}", of_vector, r), .scalar = scalar_of(type), .at = leaf(r)});
    }
}

} // namespace

ShaderText shader_text(const ShaderFolders& folders, const std::string& name, Stage stage) {
    const auto source = std::make_shared<const ShaderSource>(load_stages(folders, name, std::array{stage}).front());
    text::Program program = program_of(source);
    text::Accesses accesses = text::accesses_of(program);
    return {std::move(program), std::move(accesses), source->files.front()};
}

bool Record::is_like(const Record& other) const {
    return words == other.words && std::ranges::equal(fields, other.fields, [](const Field& a, const Field& b) {
               return a.scalar == b.scalar && a.components == b.components && a.at == b.at;
           });
}

Record record_of(const text::Block& block, const std::string& file) {
    Record record;
    record.declared = fmt::format("{} of {}", block.name, file);
    if (block.records) {
        record.words = block.records->words;
        record.count = block.records->count;
        for (const text::Block::Member& member : block.records->members)
            add_fields(member, record);
    } else if (block.array_stride == 0) {
        record.words = static_cast<std::uint32_t>(block.words(0));
        record.count = 1;
        for (const text::Block::Member& member : block.members)
            add_fields({"." + member.name.substr(member.name.find('.') + 1), member.leaves, member.type}, record);
    }
    return record;
}

} // namespace lockstep::check_file
