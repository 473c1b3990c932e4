#include "gpu/preprocessor.hpp"

#include <glslang/Public/ResourceLimits.h>

#include "gpu/child_process.hpp"
#include "gpu/glslang_tables.hpp"
#include "gpu/shader_words.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr int newest = 460;

/// Drivers go on behind a backslash in versions, too, in which glslang does not.
GlslVersion version_for(const std::string& text) {
    GlslVersion version = version_in(text);
    if (version.number == 0 || (version.profile != "es" && !says(text, "__VERSION__")))
        version.number = newest;
    return version;
}

std::string made_of(const std::string& text, const std::string& preamble, const GlslVersion& version) {
    glslang::TShader shader(EShLangVertex); // conditions know no stage
    const char* const one = text.c_str();
    shader.setStrings(&one, 1);
    shader.setPreamble(preamble.c_str());
    shader.setOverrideVersion(version.number);
    set_glslang_target(shader, EShLangVertex, glslang::EShClientOpenGL);
    glslang::TShader::ForbidIncluder none;
    std::string made;
    if (!shader.preprocess(GetDefaultResources(), newest, ENoProfile, false, false, EShMsgOnlyPreprocessor, &made,
                           none))
        throw Error(shader.getInfoLog());
    return made;
}

} // namespace

std::optional<std::string> preprocessed(const std::string& text, const std::string& preamble) try {
    constexpr ChildRules compiler{"glslang", 20, true}; // it follows brackets by recursion
    const GlslVersion version = version_for(text);
    prepare_glslang(glslang::EShClientOpenGL, version);
    return in_child_if_possible(compiler, [&] { return made_of(text, preamble, version); });
} catch (const Error&) {
    return {};
}

} // namespace lockstep
