#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "crosscheck/collision/judge/absent_particles.hpp"
#include "crosscheck/collision/judge/verdict.hpp"
#include "gpu/collision/simulation.hpp"
#include "reference/collision/simulation.hpp"

namespace lockstep {

/// A run of both sides in resync that stops at the frame one wants to look into: the GPU runs there from the scene's
/// start, then the reference makes that frame's step from the GPU's state. In the current context.
class FrameRun {
  public:
    /// `known`: what legal outcomes are taken from. `shaders`: looked into first; may be empty.
    FrameRun(Scene scene, Profile profile, const KnownOperations& known, const std::filesystem::path& shaders);

    /// The same of frames computed elsewhere, of whose steps nothing is told in between. `gpu` has to outlive this.
    FrameRun(Scene scene, Profile profile, const KnownOperations& known, GpuSide& gpu);

    /// Runs to the end of frame `frame`, counted from 0; back ones from the scene's start again. `on_frame` is
    /// given how many frames are behind it.
    void go_to(int frame, const std::function<void(int)>& on_frame = {});

    [[nodiscard]] int frame() const { return frame_; }
    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] const Profile& profile() const { return profile_; }
    [[nodiscard]] JudgedFrame judged() const;

    /// Of this frame, made when first asked for.
    const FrameVerdicts& verdicts();
    const CollisionImage& redrawn();    ///< the CDT the reference draws of the GPU's particles
    const DepthImage& obstacle_depth(); ///< as cleared where there is none
    StepCapture capture(std::size_t particle);

  private:
    void step(int frame);

    Scene scene_;
    Profile profile_;
    KnownOperations known_;
    std::unique_ptr<GpuSimulation> simulation_; ///< null: gpu_ is another's
    GpuSide& gpu_;
    ReferenceSimulation reference_;
    FrameParams params_;
    int frame_ = -1;
    Particles before_, after_;
    AbsentParticles absent_; ///< of after_
    CollisionImage cdt_before_, cdt_after_;
    std::optional<FrameVerdicts> verdicts_;
    std::optional<CollisionImage> redrawn_;
    std::optional<DepthImage> obstacle_depth_;
};

} // namespace lockstep
