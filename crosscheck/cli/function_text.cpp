#include "crosscheck/cli/function_text.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/package/function_signature.hpp"
#include "crosscheck/text/glsl_module.hpp"
#include "crosscheck/text/pass_text.hpp"
#include "gpu/shader_words.hpp"
#include "reference/model/error.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep {
namespace {

using function_twin::Column;

constexpr const char* const stage_name = "ls_function";
constexpr std::string_view arguments_block = "LsWords";

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

/// A bool is an int of 0 or 1.
std::string_view word_type(const Column& column) {
    return column.scalar == Scalar::float32 ? "float" : column.scalar == Scalar::int32 ? "int" : "uint";
}

/// Stores a result's components.
std::string stores(const Column& result) {
    std::string all;
    for (int c = 0; c < result.components; ++c) {
        const std::string part = result.components == 1 ? "ls_made" : fmt::format("ls_made[{}]", c);
        all += fmt::format("    ls_result[{}] = {}({});\n", c, word_type(result), part);
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
std::shared_ptr<const ShaderSource> caller_of(const GlslFunction& function, const function_twin::Called& called,
                                              const std::vector<Column>& columns) {
    const std::string text = function_twin::text_of_file(function);
    std::vector<std::string> arguments;
    std::size_t first = 0;
    for (const Column& column : columns) {
        arguments.push_back(argument(column, first));
        first += static_cast<std::size_t>(column.components);
    }
    const std::string file = std::filesystem::path(function.file).filename().string();
    ShaderTexts texts = called.passes.front().texts;
    texts[file] = without_version(text);
    texts[fmt::format("{}.comp", stage_name)] = fmt::format(
        "#version {} core\n#define main {}\n#include \"{}\"\n#undef main\n"
        "layout(local_size_x = 1) in;\nlayout(std430) buffer {} {{ uint ls_words[]; }};\n"
        "layout(std430) buffer LsResult {{ {} ls_result[]; }};\n"
        "void main() {{\n    {} ls_made = {}({});\n{}}}\n",
        450, function_twin::main_of_the_file, file, arguments_block, word_type(called.result),
        function_twin::type_of(called.result), function.name, fmt::join(arguments, ", "), stores(called.result));
    const std::array stages{Stage::compute};
    return std::make_shared<ShaderSource>(
        load_stages(shader_folders(called.folder), stage_name, stages, function.defines, texts).front());
}

std::vector<std::uint32_t> arguments_of(const FunctionRows& rows, std::size_t row) {
    const auto first = rows.words.begin() + static_cast<std::ptrdiff_t>(row * rows.width());
    return {first, first + static_cast<std::ptrdiff_t>(rows.width())};
}

} // namespace

FunctionText::FunctionText(const GlslFunction& function, const std::vector<Column>& columns, Profile profile,
                           const KnownOperations& known)
    : FunctionText(function, function_twin::called(function, columns), columns, std::move(profile), known) {}

FunctionText::FunctionText(const GlslFunction& function, const function_twin::Called& called,
                           const std::vector<Column>& columns, Profile profile, const KnownOperations& known)
    : profile_(std::move(profile)), known_(known), source_(caller_of(function, called, columns)),
      program_(std::make_unique<const text::Program>(program_of(source_))), outcomes_(*program_),
      result_(called.result) {
    if (!program_->images.empty())
        throw Error(fmt::format("shader {}: a function that reads images is not interpreted", function.file));
    for (const text::PlainUniform& uniform : program_->uniforms)
        uniforms_.push_back(words_given(function.uniforms, uniform));
}

text::Bindings FunctionText::bound(std::span<std::uint32_t> arguments, std::span<std::uint32_t> result) const {
    text::Bindings bindings;
    bindings.uniforms = uniforms_;
    for (const text::Block& block : program_->blocks)
        bindings.blocks.push_back(block.name == arguments_block ? arguments : result);
    return bindings;
}

std::vector<UndefinedRow> FunctionText::undefined_rows(const FunctionRows& rows) const {
    std::vector<UndefinedRow> found;
    std::uint32_t most_branches = text::Dispatch{}.most_branches;
    for (std::size_t row = 0; row < rows.count(); ++row) {
        std::vector<std::uint32_t> arguments = arguments_of(rows, row), result(4);
        text::Findings findings;
        text::run_dispatch(*program_, {.is_watched = true, .most_branches = most_branches}, bound(arguments, result),
                           profile_, findings);
        if (!findings.all().empty()) {
            const text::Finding& first = findings.all().front();
            found.push_back({row, program_->line_name(first.place.line), first.rule, first.what});
            if (first.rule == text::endless_rule) // a table of such rows shall end, too
                most_branches = 1'000'000;
        }
    }
    return found;
}

std::vector<std::uint32_t> FunctionText::values(const FunctionRows& rows) const {
    std::vector<std::uint32_t> words;
    for (std::size_t row = 0; row < rows.count(); ++row) {
        std::vector<std::uint32_t> arguments = arguments_of(rows, row), result(4);
        text::Findings findings;
        text::run_dispatch(*program_, {}, bound(arguments, result), profile_, findings);
        words.insert(words.end(), result.begin(), result.begin() + result_.components);
    }
    return words;
}

std::vector<ItemOutcome> FunctionText::results(const FunctionRows& rows, std::size_t row,
                                               const TextTaken& taken) const {
    KnownOperations known = known_;
    if (taken.as_written) // what a port may have: of the driver nothing is known
        known = {};
    known.sums = known_.sums && !taken.in_any_order;
    const text::Constants constants = taken.as_written ? text::Constants::as_written : text::Constants::rounded;
    std::vector<std::uint32_t> arguments = arguments_of(rows, row), result(4);
    std::vector<ItemOutcome> all;
    for (const text::InvocationOutcome& one :
         outcomes_.of({}, {1, 1, 1}, bound(arguments, result), PassStage::vertex, profile_, known, constants)) {
        ItemOutcome outcome{.values = {}, .open = one.open, .undefined = one.undefined};
        for (const text::WrittenWord& word : one.written)
            outcome.values.push_back(word.set_in(result_.scalar));
        outcome.values.resize(static_cast<std::size_t>(result_.components), Interval::anything());
        all.push_back(std::move(outcome));
    }
    return all;
}

} // namespace lockstep
