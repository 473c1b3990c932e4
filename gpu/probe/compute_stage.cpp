#include "gpu/probe/compute_stage.hpp"

#include <array>

#include "gpu/check.hpp"
#include "gpu/object.hpp"

namespace lockstep::probing {
namespace {

constexpr std::size_t group_size = 64; // local_size_x of the shaders

Program link_compute_stage(const std::string& name) {
    const std::array stages{Stage::compute};
    return {name, load_stages(shader_folders(), name, stages)};
}

/// Floats in a storage buffer, bound while this lives.
class BoundFloats {
  public:
    BoundFloats(GLuint binding, const Floats& floats) : binding_(binding), size_(floats.size()) {
        gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_, buffer_.id());
        gl::BufferData(GL_SHADER_STORAGE_BUFFER, bytes(), floats.data(), GL_STREAM_READ);
    }
    ~BoundFloats() { gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_, 0); }
    BoundFloats(const BoundFloats&) = delete;
    BoundFloats& operator=(const BoundFloats&) = delete;

    [[nodiscard]] Floats read() const {
        Floats floats(size_);
        gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding_, buffer_.id());
        gl::GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, bytes(), floats.data());
        return floats;
    }

  private:
    [[nodiscard]] GLsizeiptr bytes() const { return static_cast<GLsizeiptr>(size_ * sizeof(float)); }

    GLuint binding_;
    std::size_t size_;
    GlBuffer buffer_;
};

} // namespace

ComputeStage::ComputeStage(const std::string& name) : program_(link_compute_stage(name)) {}

Floats ComputeStage::run(const Floats& given, std::size_t results, std::size_t invocations) const {
    const BoundFloats from(0, given), to(1, Floats(results));
    dispatch(invocations);
    return to.read();
}

Floats ComputeStage::run(const Floats& values, std::size_t invocations) const {
    const BoundFloats buffer(0, values);
    dispatch(invocations);
    return buffer.read();
}

void ComputeStage::dispatch(std::size_t invocations) const {
    program_.use();
    gl::DispatchCompute(static_cast<GLuint>(invocations / group_size), 1, 1);
    gl::MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    check_gl(program_.name());
}

} // namespace lockstep::probing
