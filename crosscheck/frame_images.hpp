#pragma once
#include <filesystem>

#include "crosscheck/check.hpp"
#include "crosscheck/output_files.hpp"

namespace lockstep {

/// The rendered frame of a state, by the render pass of the current context.
ColorImage render_on_gpu(const Particles& particles, const Scene& scene, const FrameParams& params,
                         const std::filesystem::path& shaders);

/// Pictures of one frame of a check: the first that differs, or else the last.
class FrameImages {
  public:
    void keep(const ComparedFrame& frame);

    /// Writes DIR/cdt_{reference,gpu,difference}.png and DIR/frame_{reference,gpu,difference}.png, the last three as
    /// each side renders its own particles. Needs the current context.
    void write(OutputFiles& files, const std::filesystem::path& directory, const Scene& scene, const Profile& profile,
               const std::filesystem::path& shaders) const;

  private:
    int frame_ = -1;
    bool differs_ = false;
    Particles reference_, gpu_;
    CollisionImage reference_cdt_, gpu_cdt_;
};

} // namespace lockstep
