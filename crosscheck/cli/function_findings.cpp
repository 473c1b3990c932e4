#include "crosscheck/cli/function_findings.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/package/function_signature.hpp"
#include "crosscheck/text/glsl_module.hpp"
#include "crosscheck/text/pass_text.hpp"
#include "gpu/shader_words.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

using function_twin::Column;

constexpr const char* const stage_name = "ls_function";

/// An argument from the words of a row, from `first` on.
std::string argument(const Column& column, std::size_t first) {
    std::vector<std::string> parts;
    for (int c = 0; c < column.components; ++c) {
        const std::string word = fmt::format("ls_words[{}]", first + static_cast<std::size_t>(c));
        parts.push_back(column.is_bool                     ? word + " != 0u"
                        : column.scalar == Scalar::float32 ? fmt::format("uintBitsToFloat({})", word)
                        : column.scalar == Scalar::int32   ? fmt::format("int({})", word)
                                                           : word);
    }
    return fmt::format("{}({})", function_twin::type_of(column), fmt::join(parts, ", "));
}

/// Stores a result's components as words.
std::string stores(const Column& result) {
    std::string all;
    for (int c = 0; c < result.components; ++c) {
        const std::string part = result.components == 1 ? "ls_made" : fmt::format("ls_made[{}]", c);
        all += fmt::format("    ls_result[{}] = {}({});\n", c,
                           result.scalar == Scalar::float32 ? "floatBitsToUint" : "uint", part);
    }
    return all;
}

/// The text, its line #version empty: a stage has one, and its own stands first.
std::string without_version(std::string text) {
    std::string_view last;
    for (ShaderWords words(text); words.next(); last = words.token())
        if (last == "#" && words.token() == "version") {
            std::size_t begin = 0;
            for (std::size_t line = 1; line < words.line(); ++line)
                begin = text.find('\n', begin) + 1;
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            return text.erase(begin, end - begin);
        }
    return text;
}

/// A compute stage that calls the function with the words of a row, and stores its result.
std::shared_ptr<const ShaderSource> caller_of(const GlslFunction& function, const FunctionRows& rows) {
    const function_twin::Called called = function_twin::called(function, rows.columns);
    const std::string text = read_shader_file(function.file);
    const std::optional<Column> result = function_twin::column_of(function_twin::signature_of(function, text).result);
    std::vector<std::string> arguments;
    std::size_t first = 0;
    for (const Column& column : rows.columns) {
        arguments.push_back(argument(column, first));
        first += static_cast<std::size_t>(column.components);
    }
    const std::string file = std::filesystem::path(function.file).filename().string();
    ShaderTexts texts = called.passes.front().texts;
    texts[file] = without_version(text);
    texts[fmt::format("{}.comp", stage_name)] = fmt::format(
        "#version {} core\n#define main ls_main_of_the_file\n#include \"{}\"\n#undef main\n"
        "layout(local_size_x = 1) in;\nlayout(std430) buffer LsWords {{ uint ls_words[]; }};\n"
        "layout(std430) buffer LsResult {{ uint ls_result[]; }};\n"
        "void main() {{\n    {} ls_made = {}({});\n{}}}\n",
        450, file, function_twin::type_of(*result), function.name, fmt::join(arguments, ", "), stores(*result));
    const std::array stages{Stage::compute};
    return std::make_shared<ShaderSource>(
        load_stages(shader_folders(called.folder), stage_name, stages, function.defines, texts).front());
}

} // namespace

std::vector<UndefinedRow> undefined_rows(const GlslFunction& function, const FunctionRows& rows) try {
    const std::shared_ptr<const ShaderSource> source = caller_of(function, rows);
    const text::Program program = text::decoded(
        text::read_module(spirv_of(*source), [source](std::uint32_t line) { return line_name(*source, line); }));
    std::vector<std::uint32_t> words = rows.words, result(4);
    text::Bindings bindings;
    for (const text::PlainUniform& uniform : program.uniforms) {
        const auto given = function.uniforms.find(uniform.name);
        bindings.uniforms.push_back(given == function.uniforms.end() ? std::vector<std::uint32_t>{}
                                                                     : words_of(given->second));
    }
    if (!program.images.empty())
        return {};
    const Profile profile = named_profile("strict");
    std::uint32_t most_branches = text::Dispatch{}.most_branches;
    std::vector<UndefinedRow> found;
    for (std::size_t row = 0; row < rows.count(); ++row) {
        bindings.blocks.clear();
        for (const text::Block& block : program.blocks)
            bindings.blocks.push_back(block.name == "LsWords"
                                          ? std::span(words).subspan(row * rows.width(), rows.width())
                                          : std::span(result));
        text::Findings findings;
        text::run_dispatch(program, {.is_watched = true, .most_branches = most_branches}, bindings, profile, findings);
        if (!findings.all().empty()) {
            const text::Finding& first = findings.all().front();
            found.push_back({row, program.line_name(first.place.line), first.rule, first.what});
            if (first.rule == text::endless_rule) // a table of such rows shall end, too
                most_branches = 1'000'000;
        }
    }
    return found;
} catch (const Error&) {
    return {}; // what is wrong with the shader is the driver's to say, and a text need not be interpreted
}

FunctionRows without(const FunctionRows& rows, const std::vector<UndefinedRow>& undefined) {
    FunctionRows kept = rows;
    kept.words.clear();
    kept.lines.clear();
    if (kept.results)
        kept.results->clear();
    const std::size_t width = rows.width(), count = rows.count();
    const std::size_t result_width = rows.results ? rows.results->size() / count : 0;
    for (std::size_t row = 0; row < count; ++row) {
        if (std::ranges::binary_search(undefined, row, {}, &UndefinedRow::row))
            continue;
        const auto append = [&](auto& to, const auto& from, std::size_t n) {
            const auto first = from.begin() + static_cast<std::ptrdiff_t>(row * n);
            to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(n));
        };
        append(kept.words, rows.words, width);
        if (!rows.lines.empty())
            kept.lines.push_back(rows.lines[row]);
        if (rows.results)
            append(*kept.results, *rows.results, result_width);
    }
    return kept;
}

std::string undefined_text(const FunctionRows& rows, const std::vector<UndefinedRow>& undefined, std::size_t others) {
    constexpr std::size_t most = 20;
    std::string all = fmt::format(
        "verdict   UNDEFINED: {} of {} rows rest on an operation for which GLSL defines no result{}\n",
        undefined.size(), rows.count(), others > 0 ? fmt::format("; every bit of the other {} agrees", others) : "");
    const std::string file = std::filesystem::path(rows.file).filename().string();
    for (std::size_t k = 0; k < undefined.size() && k < most; ++k) {
        const UndefinedRow& one = undefined[k];
        all += fmt::format("row {:<5} {}{}: {}: {}\n", one.row,
                           rows.lines.empty() ? "" : fmt::format("{}:{}: ", file, rows.lines[one.row]), one.where,
                           one.rule, one.what);
    }
    if (undefined.size() > most)
        all += fmt::format("          and {} rows more\n", undefined.size() - most);
    return all;
}

} // namespace lockstep
