#include "crosscheck/text/glsl_module.hpp"

#include <charconv>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <spirv-tools/optimizer.hpp>

#include "crosscheck/text/condition_lines.hpp"
#include "crosscheck/text/old_glsl.hpp"
#include "crosscheck/text/open_constants.hpp"
#include "gpu/child_process.hpp"
#include "gpu/glslang_tables.hpp"
#include "gpu/shader_log.hpp"
#include "gpu/shader_words.hpp"
#include "gpu/spirv_module.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

EShLanguage language(Stage stage) {
    switch (stage) {
    case Stage::vertex:
        return EShLangVertex;
    case Stage::geometry:
        return EShLangGeometry;
    case Stage::fragment:
        return EShLangFragment;
    case Stage::compute:
        break;
    }
    return EShLangCompute;
}

/// A way of reading a text: the rules that it is for, and the version that takes its own's place; 0: none.
struct Reading {
    glslang::EShClient client = glslang::EShClientOpenGL;
    int version = 0;
    bool is_es = false, is_old = false; ///< old: written before `in` and `out`
};

/// Its own dialect first. What was written for versions without SPIR-V means the same in the first that has it, unless
/// it asks which one compiles it.
std::vector<Reading> readings_of(const std::string& text) {
    constexpr int desktop = 460, es = 310, first_with_in = 130, first_without_old = 420;
    const GlslVersion said = version_in(text);
    const bool is_es = said.profile == "es";
    const int version = said.number == 0 ? desktop : said.number; // of a text that does not say
    const int newer = is_es ? es : desktop;
    // From 1.30 to 4.10 compatibility has both.
    const bool may_be_old = said.number == 0 || (!is_es && said.number < first_without_old);
    const bool is_old = (said.number != 0 && said.number < first_with_in) || (may_be_old && says_old_glsl(text));
    std::vector<Reading> all;
    for (const glslang::EShClient client : {glslang::EShClientOpenGL, glslang::EShClientVulkan}) {
        all.push_back({client, 0, is_es});
        if ((version < newer || is_old) && !says(text, "__VERSION__"))
            all.push_back({client, newer, is_es, is_old});
    }
    return all;
}

/// A module as bytes, or the compiler's log.
struct Compiled {
    std::string bytes, log;
    bool is_linkers = false; ///< the log
};

constexpr int default_version = 460;

EShMessages messages_of(const Reading& as) {
    return static_cast<EShMessages>(EShMsgSpvRules | EShMsgDebugInfo | EShMsgRelaxedErrors |
                                    (as.client == glslang::EShClientVulkan ? EShMsgVulkanRules : EShMsgDefault));
}

std::string words_before(const std::string& text, const ShaderSource& stage, const Reading& as) {
    return as.is_old ? words_of_old_glsl(text, stage.stage) : std::string();
}

/// `text` and `before` outlive it.
void set_up(glslang::TShader& shader, const char* const& text, const std::string& before, EShLanguage in,
            const Reading& as) {
    shader.setStrings(&text, 1);
    if (!before.empty())
        shader.setPreamble(before.c_str());
    set_glslang_target(shader, in, as.client);
    if (as.version != 0)
        shader.setOverrideVersion(as.version);
    shader.setAutoMapBindings(true);
    shader.setAutoMapLocations(true);
}

Compiled compiled(const ShaderSource& stage, const std::string& as_text, const Reading& as) {
    const EShLanguage in = language(stage.stage);
    const EShMessages messages = messages_of(as);
    const std::string before = words_before(as_text, stage, as);
    glslang::TShader shader(in);
    const char* const text = as_text.c_str();
    set_up(shader, text, before, in, as);
    if (!shader.parse(GetDefaultResources(), default_version, false, messages))
        return {{}, shader.getInfoLog()};
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages) || !program.mapIO())
        return {{}, program.getInfoLog(), true};
    std::vector<std::uint32_t> words;
    glslang::SpvOptions options;
    options.generateDebugInfo = true;
    options.disableOptimizer = true;
    glslang::GlslangToSpv(*program.getIntermediate(in), words, &options);
    std::string bytes(words.size() * sizeof(words[0]), '\0');
    std::memcpy(bytes.data(), words.data(), bytes.size());
    return {std::move(bytes), {}};
}

/// The line of the text to which a compiler came; 0: none.
std::size_t error_line(const Compiled& one) {
    constexpr std::string_view begin = "ERROR: 0:";
    const std::size_t at = one.log.find(begin);
    std::size_t line = one.is_linkers ? std::string::npos : 0;
    if (at != std::string::npos && !one.is_linkers)
        std::from_chars(one.log.data() + at + begin.size(), one.log.data() + one.log.size(), line);
    return line;
}

/// As bytes, with operands of constant expressions as far as the compiler then takes the text; empty: there are none.
std::string compiled_open(const ShaderSource& stage, const Reading& as) {
    constexpr int most_tries = 16;
    const EShLanguage in = language(stage.stage);
    if (as.is_old) // what stands before it would be part of what is compiled again
        return {};
    glslang::TShader shader(in);
    const char* const text = stage.text.c_str();
    set_up(shader, text, {}, in, as);
    std::string plain;
    glslang::TShader::ForbidIncluder none;
    if (!shader.preprocess(GetDefaultResources(), default_version, ENoProfile, false, false, messages_of(as), &plain,
                           none))
        return {};
    std::set<std::size_t> but; // lines where a constant is asked for
    for (int tries = 0; tries < most_tries; ++tries) {
        const std::optional<std::string> open = with_open_constants(plain, as.is_es, but);
        if (!open)
            return {};
        Compiled made = compiled(stage, *open, as);
        if (!made.bytes.empty())
            return made.bytes;
        if (made.is_linkers || !but.insert(error_line(made)).second)
            return {};
    }
    return {};
}

/// As bytes, by the first reading that the text allows. Of an error in all of them, the one that comes last in the
/// text.
std::string compiled(const ShaderSource& stage, ConstantExpressions constants) {
    Compiled furthest;
    for (const Reading& as : readings_of(stage.text)) {
        Compiled made = compiled(stage, stage.text, as);
        if (!made.bytes.empty()) {
            std::string open = constants == ConstantExpressions::open ? compiled_open(stage, as) : std::string();
            return open.empty() ? made.bytes : open;
        }
        if (furthest.log.empty() || error_line(made) > error_line(furthest))
            furthest = std::move(made);
    }
    throw Error(furthest.is_linkers ? fmt::format("shader {}: {}", stage.files.front(), first_link_error(furthest.log))
                                    : fmt::format("shader {}", first_compile_error(furthest.log, stage)));
}

/// Makes the tables of the text's own version, and of the one that takes its place where it has no SPIR-V.
void prepare_for(const std::string& text) {
    GlslVersion version = version_in(text);
    if (version.number == 0)
        version.number = default_version;
    const int first_with_spirv = version.profile == "es" ? 310 : 330;
    const bool is_older = version.number < first_with_spirv;
    prepare_glslang(glslang::EShClientOpenGL, version);
    for (const Reading& as : readings_of(text))
        if (is_older && as.client == glslang::EShClientOpenGL && as.version != 0) {
            version.number = as.version;
            prepare_glslang(as.client, version);
        }
}

} // namespace

std::vector<std::uint32_t> spirv_of(const ShaderSource& stage, ConstantExpressions constants) {
    if (stage.module != nullptr)
        return stage.module->words;
    static std::mutex mutex; // glslang's pools are a thread's own, its tables are not
    const std::scoped_lock lock(mutex);
    prepare_for(stage.text);
    // It follows expressions by recursion, as deep as they are long.
    constexpr ChildRules compiler{"glslang", 20, true};
    const std::string bytes = in_child_if_possible(compiler, [&] { return compiled(stage, constants); });
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
