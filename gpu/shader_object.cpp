#include "gpu/shader_object.hpp"

#include <chrono>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "gpu/shader_log.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

GLenum gl_stage(Stage stage) {
    switch (stage) {
    case Stage::vertex:
        return GL_VERTEX_SHADER;
    case Stage::geometry:
        return GL_GEOMETRY_SHADER;
    case Stage::fragment:
        return GL_FRAGMENT_SHADER;
    case Stage::compute:
        break;
    }
    return GL_COMPUTE_SHADER;
}

[[noreturn]] void fail(const std::string& log, const ShaderSource& source) {
    if (source.module != nullptr)
        throw Error(
            fmt::format("shader {}: the driver refuses the module: {}", source.files.front(), first_link_error(log)));
    throw Error(fmt::format("shader {}", first_compile_error(log, source)));
}

std::string compile_log(GLuint shader) {
    GLint length = 0;
    gl::GetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    gl::GetShaderInfoLog(shader, length, nullptr, log.data());
    return log;
}

/// The log of a stage that compiled. Mesa's cache on disk keeps no log: a text that an earlier process compiled has an
/// empty one. The stage is then compiled once more, as a text that no process had before.
std::string log_despite_cache(const std::string& log, const ShaderSource& source) {
    if (is_of_probe(source.files.front()) || log.find_first_not_of(std::string_view(" \n\0", 3)) != std::string::npos)
        return log;
    static const std::string once =
        fmt::format("\n// {} {}\n", getpid(), std::chrono::steady_clock::now().time_since_epoch().count());
    const std::string text = source.text + once;
    const char* const words = text.c_str();
    const GLuint shader = gl::CreateShader(gl_stage(source.stage));
    gl::ShaderSource(shader, 1, &words, nullptr);
    gl::CompileShader(shader);
    std::string fresh = compile_log(shader);
    gl::DeleteShader(shader);
    return fresh;
}

} // namespace

bool takes_spirv() { return gl::ShaderBinary != nullptr && gl::SpecializeShader != nullptr; }

ShaderObject::ShaderObject(const ShaderSource& source, std::span<const SpirvModule::Variable> captured) {
    if (source.stage == Stage::compute && gl::DispatchCompute == nullptr)
        throw Error(fmt::format("shader {}: this GL has no compute shaders; they need GL 4.3", source.files.front()));
    id_ = gl::CreateShader(gl_stage(source.stage));
    if (source.module != nullptr) {
        const std::vector<std::uint32_t> words = capturing(*source.module, captured);
        gl::ShaderBinary(1, &id_, GL_SHADER_BINARY_FORMAT_SPIR_V, words.data(),
                         static_cast<GLsizei>(words.size() * sizeof words.front()));
        gl::SpecializeShader(id_, source.module->entry_point.c_str(), 0, nullptr, nullptr);
    } else {
        const char* text = source.text.c_str();
        gl::ShaderSource(id_, 1, &text, nullptr);
        gl::CompileShader(id_);
    }
    GLint compiled = GL_FALSE;
    gl::GetShaderiv(id_, GL_COMPILE_STATUS, &compiled);
    const std::string log = compile_log(id_);
    try {
        if (compiled != GL_TRUE)
            fail(log, source);
        note_shader_warnings(compile_warnings(source.module != nullptr ? log : log_despite_cache(log, source), source));
    } catch (...) {
        gl::DeleteShader(id_);
        throw;
    }
}

ShaderObject::ShaderObject(ShaderObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}

ShaderObject::~ShaderObject() { gl::DeleteShader(id_); }

} // namespace lockstep
