#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "crosscheck/text/glsl_module.hpp"
#include "gpu/gl.hpp"
#include "reference/text/memory.hpp"

namespace lockstep::test {

using Words = std::vector<std::uint32_t>;

/// The texts of GL's programs, whichever host makes them. While it lives, GL's entry points go through it; one at a
/// time.
class GlPrograms {
  public:
    using Texts = std::map<GLenum, std::string>; ///< by stage
    GlPrograms() {
        instance() = this;
        real_create_ = gl::CreateShader;
        real_source_ = gl::ShaderSource;
        real_attach_ = gl::AttachShader;
        gl::CreateShader = [](GLenum type) {
            const GLuint shader = instance()->real_create_(type);
            instance()->types_[shader] = type;
            return shader;
        };
        gl::ShaderSource = [](GLuint shader, GLsizei count, const GLchar* const* text, const GLint* lengths) {
            if (count == 1 && lengths == nullptr)
                instance()->texts_[shader] = text[0];
            instance()->real_source_(shader, count, text, lengths);
        };
        gl::AttachShader = [](GLuint program, GLuint shader) {
            instance()->programs_[program][instance()->types_[shader]] = instance()->texts_[shader];
            instance()->real_attach_(program, shader);
        };
    }
    ~GlPrograms() {
        gl::CreateShader = real_create_;
        gl::ShaderSource = real_source_;
        gl::AttachShader = real_attach_;
        instance() = nullptr;
    }
    GlPrograms(const GlPrograms&) = delete;
    GlPrograms& operator=(const GlPrograms&) = delete;

    /// Of the program in use.
    [[nodiscard]] const Texts& current() { return programs_[current_program()]; }
    [[nodiscard]] static GLuint current_program() {
        GLint current = 0;
        gl::GetIntegerv(GL_CURRENT_PROGRAM, &current);
        return static_cast<GLuint>(current);
    }
    /// Throws Error for what is not interpreted.
    const text::Program& decoded(Stage stage, const std::string& text) {
        std::unique_ptr<text::Program>& known = decoded_[text];
        if (known == nullptr) {
            auto source = std::make_shared<ShaderSource>();
            source->stage = stage;
            source->text = text;
            source->files = {"shader"};
            known = std::make_unique<text::Program>(text::decoded(text::read_module(
                spirv_of(*source), [](std::uint32_t line) { return "line " + std::to_string(line); })));
        }
        return *known;
    }
    /// What the text's first comment says, with a number behind that of a second text that says it.
    std::string name_of(const std::string& text) {
        const std::size_t at = text.find("\n// "), end = text.find('\n', at + 1);
        const std::string said = at == std::string::npos ? "?" : text.substr(at + 4, end - at - 4);
        std::vector<std::string>& known = named_[said];
        const auto place = std::find(known.begin(), known.end(), text);
        const std::ptrdiff_t number = place - known.begin() + 1;
        if (place == known.end())
            known.push_back(text);
        return number == 1 ? said : said + " (" + std::to_string(number) + ")";
    }

  private:
    static GlPrograms*& instance() {
        static GlPrograms* one = nullptr;
        return one;
    }
    decltype(gl::CreateShader) real_create_;
    decltype(gl::ShaderSource) real_source_;
    decltype(gl::AttachShader) real_attach_;
    std::map<GLuint, GLenum> types_;
    std::map<GLuint, std::string> texts_;
    std::map<GLuint, Texts> programs_;
    std::map<std::string, std::vector<std::string>> named_;
    std::map<std::string, std::unique_ptr<text::Program>> decoded_;
};

/// What GL has bound to the names of a stage: words of blocks and images, values of uniforms.
class BoundWords {
  public:
    BoundWords(GLuint program, const text::Program& stage) {
        for (const text::Block& block : stage.blocks)
            blocks.push_back(block_words(program, block.name));
        for (const text::ImageUniform& image : stage.images)
            textures_.push_back(texture_words(program, image));
        for (const text::PlainUniform& uniform : stage.uniforms)
            uniforms_.push_back(uniform_words(program, uniform));
    }
    [[nodiscard]] text::Bindings bindings() {
        text::Bindings all;
        for (Words& one : blocks)
            all.blocks.emplace_back(one);
        for (auto& [memory, texels] : textures_) {
            memory.words = texels;
            all.images.push_back(memory);
        }
        all.uniforms = uniforms_;
        return all;
    }
    std::vector<Words> blocks;

    /// Of a storage block; one word where it is not active.
    static Words block_words(GLuint program, const std::string& name) {
        const GLuint index = gl::GetProgramResourceIndex(program, GL_SHADER_STORAGE_BLOCK, name.c_str());
        if (index == GL_INVALID_INDEX)
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

  private:
    static Words uniform_words(GLuint program, const text::PlainUniform& uniform) {
        Words words(uniform.cells);
        const GLint location = gl::GetUniformLocation(program, uniform.name.c_str());
        if (location >= 0 && uniform.is_real)
            gl::GetUniformfv(program, location, reinterpret_cast<GLfloat*>(words.data()));
        else if (location >= 0)
            gl::GetUniformiv(program, location, reinterpret_cast<GLint*>(words.data()));
        return words;
    }
    /// Of a sampler of a 2D or 3D texture.
    static std::pair<text::TexelMemory, Words> texture_words(GLuint program, const text::ImageUniform& image) {
        text::TexelMemory memory;
        memory.name = image.name;
        const GLenum target = image.shape.dimensions == spv::Dim3D ? GL_TEXTURE_3D : GL_TEXTURE_2D;
        GLint unit = 0, before = 0;
        std::array<GLint, 3> size{1, 1, 1};
        if (const GLint location = gl::GetUniformLocation(program, image.name.c_str()); location >= 0)
            gl::GetUniformiv(program, location, &unit);
        gl::GetIntegerv(GL_ACTIVE_TEXTURE, &before);
        gl::ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        gl::GetTexLevelParameteriv(target, 0, GL_TEXTURE_WIDTH, &size[0]);
        gl::GetTexLevelParameteriv(target, 0, GL_TEXTURE_HEIGHT, &size[1]);
        gl::GetTexLevelParameteriv(target, 0, GL_TEXTURE_DEPTH, &size[2]);
        std::size_t texels = 1;
        for (std::size_t axis = 0; axis < size.size(); ++axis) {
            memory.size[axis] = static_cast<std::uint32_t>(size[axis]);
            texels *= memory.size[axis];
        }
        Words words(texels * memory.components);
        gl::GetTexImage(target, 0, image.is_real ? GL_RGBA : GL_RGBA_INTEGER,
                        image.is_real ? GL_FLOAT : GL_UNSIGNED_INT, words.data());
        gl::ActiveTexture(static_cast<GLenum>(before));
        return {memory, words};
    }

    std::vector<std::pair<text::TexelMemory, Words>> textures_;
    std::vector<Words> uniforms_;
};

} // namespace lockstep::test
