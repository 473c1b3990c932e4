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
template <class Element> void upload(StorageBuffer& buffer, std::string block, std::string item,
                                     std::span<const Element> elements, std::size_t spare, GLenum usage) {
    const Element none{};
    buffer.allocate({std::move(block), std::move(item), std::max<std::size_t>(1, elements.size()), sizeof(Element), {}},
                    spare, elements.empty() ? &none : elements.data(), usage);
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
      ends_with_last_(lengths_asked(program_, Binding::order + 1)), octree_(scene.constants.octree_size),
      obstacles_(taking_part(scene)) {
    upload_node_texture(node_texture_.id());
    upload(obstacle_vertices_, "ObstacleVertices", "position", std::span<const glm::vec3>(obstacles_), group_,
           GL_STATIC_DRAW);
    check_gl("octree_pass");
}

void OctreePass::check_ends(const ParticleBuffer& from, const ParticleBuffer& to) const {
    check_margin(program_, to.range("After"));
    check_margin(program_, from.range("Before"));
    for (const StorageBuffer* const buffer : {&nodes_, &indices_, &order_, &obstacle_vertices_})
        check_margin(program_, buffer->range());
}

void OctreePass::refresh(const ParticleBuffer& particles) {
    particles.read(read_back_);
    octree_.refresh(read_back_.position, obstacles_);
    upload(nodes_, "Nodes", "node", octree_.nodes(), group_, GL_STREAM_DRAW);
    upload(indices_, "Indices", "number", octree_.indices(), group_, GL_STREAM_DRAW);
    upload(order_, "Order", "number", octree_.order(), group_, GL_STREAM_DRAW);
    check_gl("octree_pass, refresh");
}

void OctreePass::run(const FrameParams& params, const ParticleBuffer& from, ParticleBuffer& to) {
    program_.set("u_ParticleCount", static_cast<unsigned>(from.size()));
    set_step_uniforms(program_, params);
    program_.set_unit("u_NodeTexture", 0, GL_UNSIGNED_INT_SAMPLER_2D);
    program_.check_interface();
    gl::ActiveTexture(GL_TEXTURE0);
    gl::BindTexture(GL_TEXTURE_2D, node_texture_.id());
    from.range("").bind(Binding::before, ends_with_last_[Binding::before]);
    to.range("").bind(Binding::after, ends_with_last_[Binding::after]);
    nodes_.range().bind(Binding::nodes, ends_with_last_[Binding::nodes]);
    indices_.range().bind(Binding::indices, ends_with_last_[Binding::indices]);
    obstacle_vertices_.range().bind(Binding::obstacle_vertices, ends_with_last_[Binding::obstacle_vertices]);
    order_.range().bind(Binding::order, ends_with_last_[Binding::order]);
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
