#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gpu/collision/collision_pass.hpp"
#include "gpu/collision/collision_trace.hpp"
#include "gpu/collision/compute_collision_pass.hpp"
#include "gpu/collision/compute_trace.hpp"
#include "gpu/collision/depth_pass.hpp"
#include "gpu/collision/gpu_side.hpp"
#include "gpu/collision/layered_collision_pass.hpp"
#include "gpu/collision/obstacle_pass.hpp"
#include "gpu/collision/octree_pass.hpp"
#include "gpu/mesh_buffer.hpp"
#include "gpu/pass_timer.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// The GPU side of a run in the current context: whole frames, one after the other, particles and CDT in two copies
/// each that swap roles. Twin of reference/collision/simulation.hpp.
class GpuSimulation final : public GpuSide {
  public:
    /// `shaders`: a folder looked into before the shipped one, or empty.
    GpuSimulation(const Scene& scene, const std::filesystem::path& shaders);

    void upload(const Particles& particles, const CollisionImage& cdt) override;

    /// One frame: clear, obstacles, collision pass, or with remedies the layered one; with search = octree the octree's
    /// two passes and a CDT that stays empty; with search = depth the depth pass and a CDT of obstacles' depth. Returns
    /// when the GPU is done.
    void step(const FrameParams& params) override;
    void begin_step(const FrameParams& params) override;

    [[nodiscard]] bool repeats() const override { return true; }
    void repeat_step(const FrameParams& params) override;

    /// What the last frame's step of a particle computed on its way, from the buffers that frame read. Compiles the
    /// trace build at the first call, and then throws Error for what is wrong with it. Needs search = cdt or depth. A
    /// compute shader without a trace build tells the state alone.
    [[nodiscard]] StepCapture trace(const FrameParams& params, std::size_t particle);

    /// GPU time of the last frame by a timer query, seconds, without the octree's refresh, which is the CPU's; 0 where
    /// the context has none.
    [[nodiscard]] double frame_seconds() const { return frame_seconds_; }

    /// The last frame once more, from the same state: GPU time of each of its passes by timestamps, seconds, in order,
    /// the clearing of the CDT before them. Empty where the context has none.
    std::vector<std::pair<std::string, double>> pass_seconds(const FrameParams& params);

    /// What the last frame left, for a pass that draws it.
    [[nodiscard]] const ParticleBuffer& particle_buffer() const { return particles_[current_]; }
    [[nodiscard]] const MeshBuffer& obstacle_buffer() const { return obstacles_; }

    void read(Particles& particles) const override;
    void read(CollisionImage& cdt) const override;
    [[nodiscard]] bool holds(const Particles& particles) const override;

    void lay_canary() override;
    void find_canary(const Particles& particles, const CollisionImage& cdt, int frame) const override;

  private:
    /// The pass with remedies and the CDTs it reads and draws.
    struct Layered {
        LayeredCollisionPass pass;
        std::array<LayeredTexture, 2> cdts;
    };
    static std::optional<Layered> layered(const Scene& scene, const std::filesystem::path& shaders);

    void begin_frame(const FrameParams& params, std::size_t from, std::size_t to);
    void end_frame(const FrameParams& params, std::size_t from, std::size_t to);
    void run_passes(const FrameParams& params, std::size_t from, std::size_t to);
    void run_layered(const FrameParams& params, std::size_t from, std::size_t to);
    void verify_written() const;

    Switches switches_;
    std::filesystem::path shaders_;
    MeshBuffer obstacles_;
    ObstaclePass obstacle_pass_;
    std::optional<CollisionPass> collision_pass_;      ///< the listing's, step = transform_feedback
    std::optional<ComputeCollisionPass> compute_pass_; ///< step = compute: takes the place of collision_pass_
    std::optional<OctreePass> octree_pass_;            ///< search = octree: takes the place of these
    std::optional<DepthPass> depth_pass_;              ///< search = depth: likewise
    std::array<ParticleBuffer, 2> particles_;
    std::array<CollisionTexture, 2> cdts_;
    std::optional<CollisionTrace> trace_;
    std::optional<ComputeTrace> compute_trace_;
    std::optional<Layered> layered_; ///< with remedies, in the place of collision_pass_ and cdts_
    GlQuery timer_;
    PassTimer pass_timer_;
    double frame_seconds_ = 0.0;
    bool begun_ = false;      ///< the next step's commands were given
    std::size_t current_ = 0; ///< which of the two the next frame starts from
};

} // namespace lockstep
