#pragma once
#include <string>

#include <glslang/Public/ShaderLang.h>

namespace lockstep {

/// The version, and the profile where it is said, of a text's #version; 0: it has none.
struct GlslVersion {
    int number = 0;
    std::string profile; ///< "es", "core", "compatibility", or empty
};
GlslVersion version_in(const std::string& text);

/// Makes glslang's tables of builtin names for a version in this process, once, so that child processes
/// (child_process.hpp) that compile texts of it need not: these take ten times as long as a text. Throws Error where
/// glslang does not start.
void prepare_glslang(glslang::EShClient client, const GlslVersion& version);

/// What `shader` is compiled for: SPIR-V of GL, or of Vulkan with GL's plain uniforms.
void set_glslang_target(glslang::TShader& shader, EShLanguage language, glslang::EShClient client);

} // namespace lockstep
