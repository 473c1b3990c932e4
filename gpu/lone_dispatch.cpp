#include "gpu/lone_dispatch.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <span>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "gpu/object.hpp"
#include "gpu/program_linking.hpp"
#include "gpu/shader_object.hpp"
#include "gpu/state_image.hpp"
#include "gpu/uniform_words.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

class LinkedStage {
  public:
    explicit LinkedStage(const ShaderSource& stage) : id_(gl::CreateProgram()) {
        try {
            const ShaderObject shader(stage);
            gl::AttachShader(id_, shader.id());
            if (!lockstep::link(id_, {}))
                throw Error(fmt::format("shader {}", link_failure(id_, std::span(&stage, 1), {})));
        } catch (...) {
            gl::DeleteProgram(id_);
            throw;
        }
    }
    LinkedStage(const LinkedStage&) = delete;
    LinkedStage& operator=(const LinkedStage&) = delete;
    ~LinkedStage() { gl::DeleteProgram(id_); }
    [[nodiscard]] GLuint id() const { return id_; }

  private:
    GLuint id_;
};

GLint limit(GLenum name) {
    GLint value = 0;
    gl::GetIntegerv(name, &value);
    return value;
}

/// Gives each block a binding of its own. Throws Error where there are too few.
void bind_blocks(GLuint program, const LoneDispatch& dispatch, const std::vector<GlBuffer>& buffers) {
    std::map<bool, GLuint> bound;
    for (const LoneDispatch::Block& block : dispatch.blocks) {
        const GLenum interface = block.is_storage ? GL_SHADER_STORAGE_BLOCK : GL_UNIFORM_BLOCK;
        const GLuint index = gl::GetProgramResourceIndex(program, interface, block.name.c_str());
        if (index == GL_INVALID_INDEX) {
            if (block.name.starts_with("gl_") || // that of glslang's reading as GLSL for Vulkan
                gl::GetProgramResourceIndex(program, GL_UNIFORM, block.name.c_str()) != GL_INVALID_INDEX)
                throw Error(fmt::format("{}: an atomic counter is not given to GL", block.name));
            continue;
        }
        const GLuint point = bound[block.is_storage]++;
        const GLint most =
            limit(block.is_storage ? GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS : GL_MAX_UNIFORM_BUFFER_BINDINGS);
        if (point >= static_cast<GLuint>(most))
            throw Error(fmt::format("block {}: this GL binds {} at most", block.name, most));
        if (block.is_storage)
            gl::ShaderStorageBlockBinding(program, index, point);
        else
            gl::UniformBlockBinding(program, index, point);
        gl::BindBufferBase(block.is_storage ? GL_SHADER_STORAGE_BUFFER : GL_UNIFORM_BUFFER, point,
                           buffers[block.buffer].id());
    }
}

/// The program is in use. `words`: of all elements; matrices by columns.
void set_uniform(GLuint program, const LoneDispatch::Uniform& uniform) {
    const GLuint index = gl::GetProgramResourceIndex(program, GL_UNIFORM, uniform.name.c_str());
    const GLint location = gl::GetUniformLocation(program, uniform.name.c_str());
    if (index == GL_INVALID_INDEX || location < 0 || uniform.words.empty())
        return;
    const GLenum asked = GL_TYPE;
    GLint type = 0;
    gl::GetProgramResourceiv(program, GL_UNIFORM, index, 1, &asked, 1, nullptr, &type);
    if (!set_uniform_words(location, static_cast<GLenum>(type), uniform.words))
        throw Error(fmt::format("uniform {}: values of its type are not given to GL", uniform.name));
}

} // namespace

void run_alone(LoneDispatch& dispatch, const ShaderSource& stage) {
    if (gl::DispatchCompute == nullptr || gl::BindImageTexture == nullptr || gl::ShaderStorageBlockBinding == nullptr)
        throw Error("this GL has no compute shaders; they need GL 4.3");
    const LinkedStage program(stage);
    gl::UseProgram(program.id());
    std::vector<GlBuffer> buffers(dispatch.buffers.size());
    for (std::size_t b = 0; b < buffers.size(); ++b) {
        gl::BindBuffer(GL_COPY_WRITE_BUFFER, buffers[b].id());
        gl::BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(dispatch.buffers[b].size() * sizeof(GLuint)),
                       dispatch.buffers[b].data(), GL_DYNAMIC_COPY);
    }
    bind_blocks(program.id(), dispatch, buffers);
    for (const LoneDispatch::Uniform& uniform : dispatch.uniforms)
        set_uniform(program.id(), uniform);
    std::vector<std::unique_ptr<StateImage>> images;
    for (std::size_t i = 0; i < dispatch.images.size(); ++i) {
        const Resource& about = dispatch.texels.schema().resources[i];
        images.push_back(std::make_unique<StateImage>(about, dispatch.texels.extent(static_cast<std::uint8_t>(i))));
        images.back()->upload(std::as_const(dispatch.texels)[static_cast<std::uint8_t>(i)]);
    }
    GLint units = 0;
    for (std::size_t i = 0; i < images.size(); ++i) {
        const GLint location = gl::GetUniformLocation(program.id(), dispatch.images[i].name.c_str());
        if (location < 0)
            continue;
        const GLint most = limit(dispatch.images[i].is_storage ? GL_MAX_IMAGE_UNITS : GL_MAX_TEXTURE_IMAGE_UNITS);
        if (units >= most)
            throw Error(fmt::format("{}: this GL binds {} images at most", dispatch.images[i].name, most));
        gl::Uniform1i(location, units);
        if (dispatch.images[i].is_storage) {
            gl::BindImageTexture(static_cast<GLuint>(units), images[i]->id(), 0, GL_TRUE, 0, GL_READ_WRITE,
                                 images[i]->format().layout.internal);
        } else {
            gl::ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(units));
            gl::BindTexture(images[i]->target(), images[i]->id());
        }
        ++units;
    }
    gl::ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(std::max(units - 1, 0)));
    gl::DispatchCompute(dispatch.groups[0], dispatch.groups[1], dispatch.groups[2]);
    gl::MemoryBarrier(GL_ALL_BARRIER_BITS);
    for (std::size_t b = 0; b < buffers.size(); ++b) {
        gl::BindBuffer(GL_COPY_READ_BUFFER, buffers[b].id());
        gl::GetBufferSubData(GL_COPY_READ_BUFFER, 0,
                             static_cast<GLsizeiptr>(dispatch.buffers[b].size() * sizeof(GLuint)),
                             dispatch.buffers[b].data());
    }
    for (std::size_t i = 0; i < images.size(); ++i)
        images[i]->read(dispatch.texels[static_cast<std::uint8_t>(i)]);
    gl::UseProgram(0);
    check_gl("the dispatch of " + stage.files.front());
}

} // namespace lockstep
