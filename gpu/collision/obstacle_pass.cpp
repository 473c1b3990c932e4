#include "gpu/collision/obstacle_pass.hpp"

#include <array>

#include "gpu/check.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/collision/step_uniforms.hpp"
#include "gpu/shader_source.hpp"

namespace lockstep {
namespace {

std::optional<Program> link_obstacles(const Switches& switches, const std::filesystem::path& shaders) {
    if (switches.obstacles_in_cdt == ObstaclesInCdt::off)
        return {};
    const char* name = switches.obstacles_in_cdt == ObstaclesInCdt::triangles ? "obstacle_pass" : "obstacle_vertices";
    const std::array stages{Stage::vertex, Stage::geometry, Stage::fragment};
    return Program(name, load_stages(collision_shaders(shaders), name, stages, switch_defines(switches)));
}

} // namespace

ObstaclePass::ObstaclePass(const Switches& switches, const std::filesystem::path& shaders)
    : kind_(switches.obstacles_in_cdt), program_(link_obstacles(switches, shaders)) {}

void ObstaclePass::run(const MeshBuffer& obstacles, const FrameParams& params) {
    if (!program_ || obstacles.vertex_count() == 0)
        return;
    program_->set("u_ProjView", params.collision_proj_view);
    program_->set("u_ClientWidth", params.width);
    program_->set("u_ClientHeight", params.height);
    set_collision_code(*program_, params);
    gl::Enable(GL_DEPTH_TEST);
    gl::DepthFunc(GL_LESS);
    const GlVertexArray vertices = mesh_vertex_array(obstacles, *program_);
    program_->check_interface();
    gl::BindVertexArray(vertices.id());
    if (kind_ == ObstaclesInCdt::triangles)
        gl::DrawElements(GL_TRIANGLES, obstacles.index_count(), GL_UNSIGNED_INT, nullptr);
    else
        gl::DrawArrays(GL_POINTS, 0, obstacles.vertex_count());
    gl::BindVertexArray(0);
    check_gl(program_->name());
}

} // namespace lockstep
