#include "crosscheck/text/glsl_module.hpp"

#include <cstring>
#include <filesystem>
#include <mutex>

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include "crosscheck/text/condition_lines.hpp"
#include "gpu/child_process.hpp"
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

/// As bytes.
std::string compiled(const ShaderSource& stage) {
    constexpr int gl_version = 450;
    const EShLanguage in = language(stage.stage);
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgDebugInfo);
    glslang::TShader shader(in);
    const char* text = stage.text.c_str();
    shader.setStrings(&text, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, in, glslang::EShClientOpenGL, 100);
    shader.setEnvClient(glslang::EShClientOpenGL, glslang::EShTargetOpenGL_450);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    if (says(stage.text, "GL_ARB_gpu_shader5")) // whose words glslang knows from GLSL 4.00 on
        shader.setOverrideVersion(gl_version);
    shader.setAutoMapBindings(true);
    shader.setAutoMapLocations(true);
    if (!shader.parse(GetDefaultResources(), gl_version, false, messages))
        throw Error(fmt::format("shader {}", first_compile_error(shader.getInfoLog(), stage)));
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages) || !program.mapIO())
        throw Error(fmt::format("shader {}: {}", stage.files.front(), first_link_error(program.getInfoLog())));
    std::vector<std::uint32_t> words;
    glslang::SpvOptions options;
    options.generateDebugInfo = true;
    options.disableOptimizer = true;
    glslang::GlslangToSpv(*program.getIntermediate(in), words, &options);
    std::string bytes(words.size() * sizeof(words[0]), '\0');
    std::memcpy(bytes.data(), words.data(), bytes.size());
    return bytes;
}

} // namespace

std::vector<std::uint32_t> spirv_of(const ShaderSource& stage) {
    if (stage.module != nullptr)
        return stage.module->words;
    static const bool is_ready = glslang::InitializeProcess();
    static std::mutex mutex; // glslang's pools are a thread's own, its tables are not
    const std::scoped_lock lock(mutex);
    if (!is_ready)
        throw Error("glslang does not start");
    // It follows expressions by recursion, as deep as they are long.
    constexpr ChildRules compiler{"glslang", 20, true};
    const std::string bytes = in_child_if_possible(compiler, [&] { return compiled(stage); });
    std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return with_condition_lines(words, stage.text);
}

std::string line_name(const ShaderSource& stage, std::uint32_t line) {
    if (line == 0 || line > stage.origins.size())
        return std::filesystem::path(stage.files.front()).filename().string();
    const ShaderSource::Origin& origin = stage.origins[line - 1];
    return fmt::format("{}:{}", std::filesystem::path(stage.files[origin.file]).filename().string(), origin.line);
}

} // namespace lockstep
