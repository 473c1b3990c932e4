#pragma once
#include <filesystem>
#include <optional>

#include "gpu/mesh_buffer.hpp"
#include "gpu/program.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// Draws the obstacles into a CDT on GL: shaders/collision/obstacle_pass.* or obstacle_vertices.*, as switch
/// obstacles_in_cdt says. Twin of reference/collision/obstacle_pass.hpp.
class ObstaclePass {
  public:
    /// `shaders` is looked into before the shipped folder; may be empty.
    ObstaclePass(const Switches& switches, const std::filesystem::path& shaders);

    /// Draws into the bound framebuffer on top of what it holds; the viewport is the whole image.
    void run(const MeshBuffer& obstacles, const FrameParams& params);

  private:
    ObstaclesInCdt kind_;
    std::optional<Program> program_; ///< none: obstacles are off
};

} // namespace lockstep
