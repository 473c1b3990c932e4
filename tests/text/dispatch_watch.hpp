#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "crosscheck/text/glsl_module.hpp"
#include "gpu/gl.hpp"
#include "reference/text/dispatch.hpp"

namespace lockstep::test {

/// Runs the text of each compute shader that is dispatched, whichever host does it: what GL has bound before the
/// dispatch is read back, and what the text makes of it is held against what the dispatch left. While it lives, GL's
/// entry points go through it; one at a time.
class DispatchWatch {
  public:
    struct Row {
        std::size_t dispatches = 0, words = 0, changed = 0, differing = 0, findings = 0;
    };
    explicit DispatchWatch(Profile profile) : profile_(std::move(profile)) {
        instance() = this;
        real_source_ = gl::ShaderSource;
        real_attach_ = gl::AttachShader;
        real_dispatch_ = gl::DispatchCompute;
        gl::ShaderSource = [](GLuint shader, GLsizei count, const GLchar* const* text, const GLint* lengths) {
            if (count == 1 && lengths == nullptr)
                instance()->texts_[shader] = text[0];
            instance()->real_source_(shader, count, text, lengths);
        };
        gl::AttachShader = [](GLuint program, GLuint shader) {
            instance()->programs_[program] = instance()->texts_[shader];
            instance()->real_attach_(program, shader);
        };
        gl::DispatchCompute = [](GLuint x, GLuint y, GLuint z) { instance()->dispatch({x, y, z}); };
    }
    ~DispatchWatch() {
        gl::ShaderSource = real_source_;
        gl::AttachShader = real_attach_;
        gl::DispatchCompute = real_dispatch_;
        instance() = nullptr;
    }
    DispatchWatch(const DispatchWatch&) = delete;
    DispatchWatch& operator=(const DispatchWatch&) = delete;

    /// By what the shader's first comment says.
    [[nodiscard]] const std::map<std::string, Row>& rows() const { return rows_; }

  private:
    using Words = std::vector<std::uint32_t>;
    static DispatchWatch*& instance() {
        static DispatchWatch* one = nullptr;
        return one;
    }

    static Words block_words(GLuint program, const std::string& name) {
        const GLuint index = gl::GetProgramResourceIndex(program, GL_SHADER_STORAGE_BLOCK, name.c_str());
        if (index == GL_INVALID_INDEX) // not active
            return Words(1);
        const GLenum property = GL_BUFFER_BINDING;
        GLint binding = 0, buffer = 0, start = 0, size = 0;
        gl::GetProgramResourceiv(program, GL_SHADER_STORAGE_BLOCK, index, 1, &property, 1, nullptr, &binding);
        const auto point = static_cast<GLuint>(binding);
        gl::GetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, point, &buffer);
        gl::GetIntegeri_v(GL_SHADER_STORAGE_BUFFER_START, point, &start);
        gl::GetIntegeri_v(GL_SHADER_STORAGE_BUFFER_SIZE, point, &size);
        gl::BindBuffer(GL_COPY_READ_BUFFER, static_cast<GLuint>(buffer));
        if (size == 0)
            gl::GetBufferParameteriv(GL_COPY_READ_BUFFER, GL_BUFFER_SIZE, &size);
        Words words(static_cast<std::size_t>(size) / sizeof(std::uint32_t));
        gl::GetBufferSubData(GL_COPY_READ_BUFFER, start, static_cast<GLsizeiptr>(words.size() * sizeof words[0]),
                             words.data());
        gl::BindBuffer(GL_COPY_READ_BUFFER, 0);
        return words;
    }
    static Words uniform_words(GLuint program, const text::PlainUniform& uniform) {
        Words words(uniform.cells);
        const GLint location = gl::GetUniformLocation(program, uniform.name.c_str());
        if (location >= 0 && uniform.is_real)
            gl::GetUniformfv(program, location, reinterpret_cast<GLfloat*>(words.data()));
        else if (location >= 0)
            gl::GetUniformiv(program, location, reinterpret_cast<GLint*>(words.data()));
        return words;
    }
    /// Of a sampler of a 2D texture.
    static std::pair<text::TexelMemory, Words> texture_words(GLuint program, const text::ImageUniform& image) {
        text::TexelMemory memory;
        memory.name = image.name;
        GLint unit = 0, before = 0, width = 0, height = 0;
        if (const GLint location = gl::GetUniformLocation(program, image.name.c_str()); location >= 0)
            gl::GetUniformiv(program, location, &unit);
        gl::GetIntegerv(GL_ACTIVE_TEXTURE, &before);
        gl::ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        gl::GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
        gl::GetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &height);
        memory.size = {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), 1};
        Words words(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * memory.components);
        gl::GetTexImage(GL_TEXTURE_2D, 0, image.is_real ? GL_RGBA : GL_RGBA_INTEGER,
                        image.is_real ? GL_FLOAT : GL_UNSIGNED_INT, words.data());
        gl::ActiveTexture(static_cast<GLenum>(before));
        return {memory, words};
    }

    const text::Program& program_of(const std::string& text) {
        std::unique_ptr<text::Program>& known = decoded_[text];
        if (known == nullptr) {
            auto source = std::make_shared<ShaderSource>();
            source->stage = Stage::compute;
            source->text = text;
            source->files = {"dispatched.comp"};
            known = std::make_unique<text::Program>(text::decoded(text::read_module(
                spirv_of(*source), [](std::uint32_t line) { return "line " + std::to_string(line); })));
        }
        return *known;
    }
    static std::string name_of(const std::string& text) {
        const std::size_t at = text.find("\n// "), end = text.find('\n', at + 1);
        return at == std::string::npos ? "?" : text.substr(at + 4, end - at - 4);
    }

    void dispatch(std::array<std::uint32_t, 3> groups) {
        GLint current = 0;
        gl::GetIntegerv(GL_CURRENT_PROGRAM, &current);
        const auto id = static_cast<GLuint>(current);
        const std::string& text = programs_[id];
        const text::Program& program = program_of(text);
        std::vector<Words> words;
        std::vector<std::pair<text::TexelMemory, Words>> textures;
        text::Bindings bindings;
        for (const text::Block& block : program.blocks)
            words.push_back(block_words(id, block.name));
        const std::vector<Words> before = words;
        for (const text::ImageUniform& image : program.images)
            textures.push_back(texture_words(id, image));
        for (Words& one : words)
            bindings.blocks.emplace_back(one);
        for (auto& [memory, texels] : textures) {
            memory.words = texels;
            bindings.images.push_back(memory);
        }
        for (const text::PlainUniform& uniform : program.uniforms)
            bindings.uniforms.push_back(uniform_words(id, uniform));
        real_dispatch_(groups[0], groups[1], groups[2]);
        gl::MemoryBarrier(GL_ALL_BARRIER_BITS);
        text::Findings findings;
        text::run_dispatch(program, {.groups = groups}, bindings, profile_, findings);
        Row& row = rows_[name_of(text)];
        ++row.dispatches;
        row.findings += findings.all().size();
        for (std::size_t b = 0; b < words.size(); ++b) {
            const Words after = block_words(id, program.blocks[b].name);
            row.words += after.size();
            for (std::size_t w = 0; w < after.size(); ++w) {
                row.changed += after[w] != before[b][w] ? 1 : 0;
                row.differing += after[w] != words[b][w] ? 1 : 0;
            }
        }
    }

    Profile profile_;
    decltype(gl::ShaderSource) real_source_;
    decltype(gl::AttachShader) real_attach_;
    decltype(gl::DispatchCompute) real_dispatch_;
    std::map<GLuint, std::string> texts_, programs_;
    std::map<std::string, std::unique_ptr<text::Program>> decoded_;
    std::map<std::string, Row> rows_;
};

} // namespace lockstep::test
