#include "gpu/glsl_compiler.hpp"

#include <charconv>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include "gpu/child_process.hpp"
#include "gpu/glslang_tables.hpp"
#include "gpu/old_glsl.hpp"
#include "gpu/shader_log.hpp"
#include "gpu/shader_words.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

EShLanguage glslang_language(Stage stage) {
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

std::vector<GlslReading> glsl_readings(const std::string& text) {
    constexpr int desktop = 460, es = 310, first_with_in = 130, first_without_old = 420;
    const GlslVersion said = version_in(text);
    const bool is_es = said.profile == "es";
    const int version = said.number == 0 ? desktop : said.number; // of a text that does not say
    const int newer = is_es ? es : desktop;
    // From 1.30 to 4.10 compatibility has both.
    const bool may_be_old = said.number == 0 || (!is_es && said.number < first_without_old);
    const bool is_old = (said.number != 0 && said.number < first_with_in) || (may_be_old && says_old_glsl(text));
    std::vector<GlslReading> all;
    for (const glslang::EShClient client : {glslang::EShClientOpenGL, glslang::EShClientVulkan}) {
        all.push_back({client, 0, is_es});
        if ((version < newer || is_old) && !says(text, "__VERSION__"))
            all.push_back({client, newer, is_es, is_old});
    }
    return all;
}

EShMessages glslang_messages(const GlslReading& as) {
    return static_cast<EShMessages>(EShMsgSpvRules | EShMsgDebugInfo | EShMsgRelaxedErrors |
                                    (as.client == glslang::EShClientVulkan ? EShMsgVulkanRules : EShMsgDefault));
}

namespace {

std::string words_before(const std::string& text, const ShaderSource& stage, const GlslReading& as) {
    return as.is_old ? words_of_old_glsl(text, stage.stage) : std::string();
}

} // namespace

void set_up(glslang::TShader& shader, const char* const& text, const std::string& before, EShLanguage in,
            const GlslReading& as) {
    shader.setStrings(&text, 1);
    if (!before.empty())
        shader.setPreamble(before.c_str());
    set_glslang_target(shader, in, as.client);
    if (as.version != 0)
        shader.setOverrideVersion(as.version);
    shader.setAutoMapBindings(true);
    shader.setAutoMapLocations(true);
}

CompiledGlsl compile_glsl(const ShaderSource& stage, const std::string& as_text, const GlslReading& as) {
    const EShLanguage in = glslang_language(stage.stage);
    const EShMessages messages = glslang_messages(as);
    const std::string before = words_before(as_text, stage, as);
    glslang::TShader shader(in);
    const char* const text = as_text.c_str();
    set_up(shader, text, before, in, as);
    if (!shader.parse(GetDefaultResources(), default_glsl_version, false, messages))
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

std::size_t CompiledGlsl::error_line() const {
    constexpr std::string_view begin = "ERROR: 0:";
    const std::size_t at = log.find(begin);
    std::size_t line = is_linkers ? std::string::npos : 0;
    if (at != std::string::npos && !is_linkers)
        std::from_chars(log.data() + at + begin.size(), log.data() + log.size(), line);
    return line;
}

std::pair<std::string, GlslReading> compile_any_dialect(const ShaderSource& stage) {
    CompiledGlsl furthest;
    for (const GlslReading& as : glsl_readings(stage.text)) {
        CompiledGlsl made = compile_glsl(stage, stage.text, as);
        if (!made.bytes.empty())
            return {std::move(made.bytes), as};
        if (furthest.log.empty() || made.error_line() > furthest.error_line())
            furthest = std::move(made);
    }
    throw Error(furthest.is_linkers ? fmt::format("shader {}: {}", stage.files.front(), first_link_error(furthest.log))
                                    : fmt::format("shader {}", first_compile_error(furthest.log, stage)));
}

std::string in_glslang_child(const ShaderSource& stage,
                             const std::function<std::pair<std::string, GlslReading>()>& compile) {
    static std::mutex mutex; // glslang's pools are a thread's own, its tables are not
    static std::set<std::pair<glslang::EShClient, int>> taken;
    const std::scoped_lock lock(mutex);
    GlslVersion version = version_in(stage.text);
    if (version.number == 0)
        version.number = default_glsl_version;
    prepare_glslang(glslang::EShClientOpenGL, version);
    for (const GlslReading& as : glsl_readings(stage.text))
        if (as.version != 0 && taken.contains({as.client, as.version}))
            prepare_glslang(as.client, {as.version, version.profile});
    // It follows expressions by recursion, as deep as they are long.
    constexpr ChildRules compiler{"glslang", 20, true};
    std::string bytes = in_child_if_possible(compiler, [&] {
        auto [made, as] = compile();
        return fmt::format("{} {} {}", static_cast<int>(as.client), as.version, made);
    });
    int client = 0, number = 0;
    const char* const end = bytes.data() + bytes.size();
    const char* const behind = std::from_chars(bytes.data(), end, client).ptr + 1;
    bytes.erase(0, static_cast<std::size_t>(std::from_chars(behind, end, number).ptr + 1 - bytes.data()));
    taken.emplace(static_cast<glslang::EShClient>(client), number);
    return bytes;
}

} // namespace lockstep
