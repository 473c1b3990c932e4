#include "gpu/mesh_buffer.hpp"

#include <fmt/format.h>

#include "gpu/check.hpp"

namespace lockstep {
namespace {

template <class Element> void fill(GLuint buffer, const std::vector<Element>& elements) {
    gl::BindBuffer(GL_COPY_WRITE_BUFFER, buffer);
    gl::BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(elements.size() * sizeof(Element)), elements.data(),
                   GL_STATIC_DRAW);
}

} // namespace

MeshBuffer::MeshBuffer(const Mesh& mesh)
    : vertex_count_(static_cast<GLsizei>(mesh.positions.size())),
      index_count_(static_cast<GLsizei>(mesh.indices.size())) {
    fill(positions_.id(), mesh.positions);
    fill(indices_.id(), mesh.indices);
    check_gl(fmt::format("buffer of {} triangles", mesh.triangle_count()));
}

GlVertexArray mesh_vertex_array(const MeshBuffer& mesh, const Program& program) {
    GlVertexArray array;
    gl::BindVertexArray(array.id());
    gl::BindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh.indices());
    gl::BindBuffer(GL_ARRAY_BUFFER, mesh.positions());
    if (const GLint location = program.attribute("a_Position", GL_FLOAT_VEC3); location >= 0) {
        gl::EnableVertexAttribArray(static_cast<GLuint>(location));
        gl::VertexAttribPointer(static_cast<GLuint>(location), 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    }
    gl::BindVertexArray(0);
    return array;
}

} // namespace lockstep
