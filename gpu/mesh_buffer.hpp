#pragma once
#include "gpu/object.hpp"
#include "gpu/program.hpp"
#include "reference/model/mesh.hpp"

namespace lockstep {

/// A mesh in GL memory: positions as three floats, indices as 32-bit integers.
class MeshBuffer {
  public:
    /// Throws Error if GL has not the memory.
    explicit MeshBuffer(const Mesh& mesh);

    [[nodiscard]] GLsizei vertex_count() const { return vertex_count_; }
    [[nodiscard]] GLsizei index_count() const { return index_count_; }
    [[nodiscard]] GLuint positions() const { return positions_.id(); }
    [[nodiscard]] GLuint indices() const { return indices_.id(); }

  private:
    GlBuffer positions_;
    GlBuffer indices_;
    GLsizei vertex_count_;
    GLsizei index_count_;
};

/// Feeds a_Position of `program` and the indices from `mesh`. Throws Error if the attribute has a wrong type.
GlVertexArray mesh_vertex_array(const MeshBuffer& mesh, const Program& program);

} // namespace lockstep
