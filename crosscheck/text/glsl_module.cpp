#include "crosscheck/text/glsl_module.hpp"

#include <cstring>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <spirv-tools/optimizer.hpp>

#include "crosscheck/text/condition_lines.hpp"
#include "crosscheck/text/open_constants.hpp"
#include "gpu/glsl_compiler.hpp"
#include "gpu/spirv_module.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// As bytes, with operands of constant expressions as far as the compiler then takes the text; empty: there are none.
std::string compiled_open(const ShaderSource& stage, const GlslReading& as) {
    constexpr int most_tries = 16;
    const EShLanguage in = glslang_language(stage.stage);
    if (as.is_old) // what stands before it would be part of what is compiled again
        return {};
    glslang::TShader shader(in);
    const char* const text = stage.text.c_str();
    set_up(shader, text, {}, in, as);
    std::string plain;
    glslang::TShader::ForbidIncluder none;
    if (!shader.preprocess(GetDefaultResources(), default_glsl_version, ENoProfile, false, false, glslang_messages(as),
                           &plain, none))
        return {};
    std::set<std::size_t> but; // lines where a constant is asked for
    for (int tries = 0; tries < most_tries; ++tries) {
        const std::optional<std::string> open = with_open_constants(plain, as.is_es, but);
        if (!open)
            return {};
        CompiledGlsl made = compile_glsl(stage, *open, as);
        if (!made.bytes.empty())
            return made.bytes;
        if (made.is_linkers || !but.insert(made.error_line()).second)
            return {};
    }
    return {};
}

std::pair<std::string, GlslReading> compiled(const ShaderSource& stage, ConstantExpressions constants) {
    std::pair<std::string, GlslReading> made = compile_any_dialect(stage);
    if (std::string open = constants == ConstantExpressions::open ? compiled_open(stage, made.second) : std::string();
        !open.empty())
        made.first = std::move(open);
    return made;
}

} // namespace

std::vector<std::uint32_t> spirv_of(const ShaderSource& stage, ConstantExpressions constants) {
    if (stage.module != nullptr)
        return stage.module->words;
    const std::string bytes = in_glslang_child(stage, [&] { return compiled(stage, constants); });
    std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return with_condition_lines(words, stage.text);
}

namespace {

text::Program decoded_words(std::vector<std::uint32_t> words, const std::shared_ptr<const ShaderSource>& stage) {
    return text::decoded(
        text::read_module(std::move(words), [stage](std::uint32_t line) { return line_name(*stage, line); }));
}

/// As they are where the passes do not take them.
std::vector<std::uint32_t> without_dead_code(const std::vector<std::uint32_t>& words) {
    spvtools::Optimizer optimizer(SPV_ENV_UNIVERSAL_1_5);
    optimizer.SetMessageConsumer([](spv_message_level_t, const char*, const spv_position_t&, const char*) {});
    optimizer.RegisterPass(spvtools::CreateInlineExhaustivePass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
        .RegisterPass(spvtools::CreateLocalSingleBlockLoadStoreElimPass())
        .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    std::vector<std::uint32_t> live;
    return optimizer.Run(words.data(), words.size(), &live, options) ? live : words;
}

} // namespace

text::Program program_of(const std::shared_ptr<const ShaderSource>& stage) {
    return decoded_words(spirv_of(*stage), stage);
}

text::Program live_program_of(const std::shared_ptr<const ShaderSource>& stage) {
    return decoded_words(without_dead_code(spirv_of(*stage)), stage);
}

std::string line_name(const ShaderSource& stage, std::uint32_t line) {
    if (line == 0 || line > stage.origins.size())
        return std::filesystem::path(stage.files.front()).filename().string();
    const ShaderSource::Origin& origin = stage.origins[line - 1];
    return fmt::format("{}:{}", std::filesystem::path(stage.files[origin.file]).filename().string(), origin.line);
}

} // namespace lockstep
