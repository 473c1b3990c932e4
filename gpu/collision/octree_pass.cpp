#include "gpu/collision/octree_pass.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/collision/particle_groups.hpp"
#include "gpu/collision/step_uniforms.hpp"
#include "gpu/shader_source.hpp"
#include "gpu/texture.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// The bindings of the shader's buffers.
enum Binding : GLuint { before, after, nodes, indices, obstacle_vertices, order };

Program link(const Scene& scene, const std::filesystem::path& shaders) {
    if (!gl::offers(4, 3))
        throw Error(
            "octree_pass: search = octree needs compute shaders and storage buffers, GL 4.3; this context is of "
            "an earlier version");
    GLint64 largest = 0;
    gl::GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
    const auto needed = static_cast<GLint64>(scene.start.size() * particle_records().bytes());
    if (needed > largest)
        throw Error(fmt::format("octree_pass: {} particles need a storage buffer of {} bytes; this context allows {}",
                                scene.start.size(), needed, largest));
    const std::array stages{Stage::compute};
    return {"octree_pass",
            load_stages(collision_shaders(shaders), "octree_pass", stages, switch_defines(scene.switches))};
}

BoundStorage bind(const Program& program) {
    static const std::array<std::string, 6> ours{"Before", "After", "Nodes", "Indices", "ObstacleVertices", "Order"};
    return bind_storage(program, ours, ours.size(), {"Before", "After", &particle_records()});
}

std::vector<glm::vec3> taking_part(const Scene& scene) {
    return scene.switches.obstacles_in_cdt == ObstaclesInCdt::off ? std::vector<glm::vec3>{}
                                                                  : scene.obstacles.positions;
}

/// A buffer is never empty: binding one that is would be an error.
template <class Element> void upload(GLuint buffer, std::span<const Element> elements, GLenum usage) {
    gl::BindBuffer(GL_SHADER_STORAGE_BUFFER, buffer);
    gl::BufferData(GL_SHADER_STORAGE_BUFFER,
                   static_cast<GLsizeiptr>(std::max(elements.size_bytes(), sizeof(OctreeNode))), nullptr, usage);
    gl::BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(elements.size_bytes()), elements.data());
}

void upload_node_texture(GLuint texture) {
    const auto texels = Octree::node_texture();
    gl::ActiveTexture(GL_TEXTURE0);
    allocate_texture(texture, {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT}, 8, Octree::node_texture_rows,
                     texels.data());
}

} // namespace

OctreePass::OctreePass(const Scene& scene, const std::filesystem::path& shaders)
    : program_(link(scene, shaders)), bound_(bind(program_)), group_(group_size(program_, scene.start.size())),
      octree_(scene.constants.octree_size), obstacles_(taking_part(scene)) {
    upload_node_texture(node_texture_.id());
    upload(obstacle_vertices_.id(), std::span<const glm::vec3>(obstacles_), GL_STATIC_DRAW);
    check_gl("octree_pass");
}

void OctreePass::refresh(const ParticleBuffer& particles) {
    particles.read(read_back_);
    octree_.refresh(read_back_.position, obstacles_);
    upload(nodes_.id(), octree_.nodes(), GL_STREAM_DRAW);
    upload(indices_.id(), octree_.indices(), GL_STREAM_DRAW);
    upload(order_.id(), octree_.order(), GL_STREAM_DRAW);
    check_gl("octree_pass, refresh");
}

void OctreePass::run(const FrameParams& params, const ParticleBuffer& from, ParticleBuffer& to) {
    program_.set("u_ParticleCount", static_cast<unsigned>(from.size()));
    set_step_uniforms(program_, params);
    program_.set_unit("u_NodeTexture", 0, GL_UNSIGNED_INT_SAMPLER_2D);
    program_.check_interface();
    gl::ActiveTexture(GL_TEXTURE0);
    gl::BindTexture(GL_TEXTURE_2D, node_texture_.id());
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, Binding::before, from.id());
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, Binding::after, to.id());
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, Binding::nodes, nodes_.id());
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, Binding::indices, indices_.id());
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, Binding::obstacle_vertices, obstacle_vertices_.id());
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, Binding::order, order_.id());
    const RecordBuffer* const read[] = {&from};
    const RecordBuffer* const written[] = {&to};
    bound_.fill(read, written);
    dispatch_particles(program_, from.size(), group_);
    bound_.collect(written);
    gl::MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT |
                      GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    check_gl("octree_pass");
}

} // namespace lockstep
