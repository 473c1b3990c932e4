#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat4x4.hpp>

#include "gpu/probe/judge.hpp"
#include "gpu/program.hpp"

namespace lockstep::probing {

/// An attribute's values, `components` floats a vertex.
struct Attribute {
    std::string_view name;
    int components = 1;
    const float* values = nullptr;
};

/// A program without fragments: attributes in, captured outputs back, one vertex (a point) an element.
class VertexStage {
  public:
    /// `name`.vert, with `name`.geom if `geometry`.
    VertexStage(const std::string& name, const ShaderDefines& defines, std::vector<Capture> outputs,
                bool geometry = false);

    [[nodiscard]] const Program& program() const { return program_; }

    /// The values of `output`, all its components; attributes not given are (0, 0, 0, 1). Throws Error if GL wrote
    /// less than `count` vertices.
    [[nodiscard]] Floats run(std::size_t count, const std::vector<Attribute>& attributes,
                             std::string_view output) const;

  private:
    std::vector<Capture> outputs_;
    Program program_;
};

} // namespace lockstep::probing
