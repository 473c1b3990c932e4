#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat4x4.hpp>

#include "gpu/object.hpp"
#include "gpu/probe/judge.hpp"
#include "gpu/program.hpp"

namespace lockstep::probing {

/// An attribute's values, `components` floats a vertex. Null: all 1.
struct Attribute {
    std::string_view name;
    int components = 1;
    const float* values = nullptr;
};

/// A program without fragments: attributes in, captured outputs back, one vertex (a point) an element.
class VertexStage {
  public:
    /// `name`.vert, with `name`.geom if `geometry`.
    VertexStage(const std::string& name, const ShaderDefines& defines, std::vector<Attribute> attributes,
                std::vector<Capture> outputs, bool geometry = false);

    [[nodiscard]] const Program& program() const { return program_; }

    /// The values of `output`, all its components, with those attributes changed that `given` names. Throws Error if
    /// GL wrote less than `count` vertices.
    [[nodiscard]] Floats run(std::size_t count, const std::vector<Attribute>& given, std::string_view output) const;

  private:
    std::vector<Attribute> attributes_; ///< all are fed in every run: a driver may compile for each set anew
    std::vector<Capture> outputs_;
    Program program_;
    GlTexture target_; ///< nothing is drawn; without a window GL still asks for a framebuffer
    GlFramebuffer framebuffer_;
};

} // namespace lockstep::probing
