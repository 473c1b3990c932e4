#include "gpu/taken_branches.hpp"

#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>

#include "gpu/child_process.hpp"
#include "gpu/shader_words.hpp"

namespace lockstep {
namespace {

/// Whether conditions may ask for what only the driver knows: its extensions, and lines as it counts them. GL_ES is not
/// of it: shaders are GLSL's.
bool asks_driver(std::string_view text) {
    std::string_view before;
    for (ShaderWords words(text); words.next(); before = words.token()) {
        const std::string_view word = words.token();
        if ((word.starts_with("GL_") && word != "GL_ES" && before != "extension") || word == "__LINE__" ||
            word == "__FILE__")
            return true;
    }
    return false;
}

std::string mark_of(std::size_t file) { return fmt::format("lockstep_file_{}_begins", file); }

/// The stage's text with a word of its own where a file begins.
std::string with_marks(const ShaderSource& stage, std::vector<bool>& has_lines) {
    std::istringstream lines(stage.text);
    std::string text;
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line); ++number) {
        if (number < stage.origins.size())
            if (const auto file = static_cast<std::size_t>(stage.origins[number].file); !has_lines[file]) {
                has_lines[file] = true;
                text += file == 0 ? "" : mark_of(file) + '\n';
            }
        text += line + '\n';
    }
    return text;
}

/// Nothing: glslang refuses it.
std::optional<std::string> preprocessed(const std::string& text, const char* preamble) {
    constexpr int default_version = 460, client_version = 100;
    glslang::TShader shader(EShLangVertex); // conditions know no stage
    const char* const one = text.c_str();
    shader.setStrings(&one, 1);
    shader.setPreamble(preamble);
    // Drivers go on behind a backslash in versions, too, in which glslang does not.
    if (!says(text, "es") && !says(text, "__VERSION__"))
        shader.setOverrideVersion(default_version);
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangVertex, glslang::EShClientOpenGL, client_version);
    glslang::TShader::ForbidIncluder none;
    std::string made;
    if (!shader.preprocess(GetDefaultResources(), default_version, ENoProfile, false, false, EShMsgOnlyPreprocessor,
                           &made, none))
        return {};
    return made;
}

} // namespace

std::vector<bool> taken_files(const ShaderSource& stage) {
    std::vector<bool> all(stage.files.size(), true);
    if (stage.files.size() < 2 || stage.module != nullptr || asks_driver(stage.text))
        return all;
    std::vector<bool> has_lines(stage.files.size());
    const std::string text = with_marks(stage, has_lines);
    std::string made;
    try { // it follows brackets by recursion
        made = in_child_if_possible({"glslang", 20, true}, [&] {
            if (!glslang::InitializeProcess())
                return std::string();
            const auto plain = preprocessed(text, "");
            const auto traced = plain ? preprocessed(text, "#define LOCKSTEP_TRACE 1\n") : plain;
            return traced ? *plain + *traced : std::string();
        });
    } catch (const Error&) { // then nothing is known
    }
    for (std::size_t file = 1; file < all.size() && !made.empty(); ++file)
        all[file] = !has_lines[file] || made.find(mark_of(file)) != std::string::npos;
    return all;
}

} // namespace lockstep
