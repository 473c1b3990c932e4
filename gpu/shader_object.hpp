#pragma once
#include <span>

#include "gpu/gl.hpp"
#include "gpu/shader_source.hpp"
#include "gpu/spirv_module.hpp"

namespace lockstep {

/// Whether the current context takes SPIR-V modules (GL_ARB_gl_spirv).
bool takes_spirv();

/// A shader object, for as long as it takes to link it.
class ShaderObject {
  public:
    /// `captured`: of a module. Throws Error with the driver's first message where the stage does not compile.
    explicit ShaderObject(const ShaderSource& source, std::span<const SpirvModule::Variable> captured = {});
    ShaderObject(ShaderObject&& other) noexcept;
    ShaderObject& operator=(ShaderObject&&) = delete;
    ~ShaderObject();
    [[nodiscard]] GLuint id() const { return id_; }

  private:
    GLuint id_ = 0;
};

} // namespace lockstep
