#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <glslang/Public/ShaderLang.h>

#include "gpu/shader_source.hpp"

namespace lockstep {

EShLanguage glslang_language(Stage stage);

/// A way of reading a text: the rules that it is for, and the version that takes its own's place; 0: none.
struct GlslReading {
    glslang::EShClient client = glslang::EShClientOpenGL;
    int version = 0;
    bool is_es = false, is_old = false; ///< old: written before `in` and `out`
};

/// Its own dialect first. What was written for versions without SPIR-V means the same in the first that has it, unless
/// it asks which one compiles it.
std::vector<GlslReading> glsl_readings(const std::string& text);

/// Of a text that does not say its version.
inline constexpr int default_glsl_version = 460;

/// How glslang reads a text.
EShMessages glslang_messages(const GlslReading& as);

/// `text` and `before` outlive it.
void set_up(glslang::TShader& shader, const char* const& text, const std::string& before, EShLanguage in,
            const GlslReading& as);

/// A SPIR-V module as bytes, or the compiler's log.
struct CompiledGlsl {
    std::string bytes, log;
    bool is_linkers = false; ///< the log
    /// The line of the text to which the compiler came; 0: none.
    [[nodiscard]] std::size_t error_line() const;
};

/// `text` in a stage's place, with names and lines.
CompiledGlsl compile_glsl(const ShaderSource& stage, const std::string& text, const GlslReading& as);

/// By the first reading that the stage's text allows, and which. Throws Error `shader FILE:LINE: ...` with the error
/// that comes last in the text, of all readings.
std::pair<std::string, GlslReading> compile_any_dialect(const ShaderSource& stage);

/// What `compile` makes of a stage, in a fenced child process, without the reading. Tables that an earlier child has
/// made for a reading are made here before the next (prepare_glslang).
std::string in_glslang_child(const ShaderSource& stage,
                             const std::function<std::pair<std::string, GlslReading>()>& compile);

} // namespace lockstep
