#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/collision/judge/frame_run.hpp"
#include "crosscheck/collision/report/pixel_text.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/report/report.hpp"

namespace lockstep {

/// The rendered frame of a state, by the render pass of the current context.
ColorImage render_on_gpu(const Particles& particles, const Scene& scene, const FrameParams& params,
                         const std::filesystem::path& shaders);

/// The state after frame `frame`, rendered by the GPU and judged; `earlier`: that of the frame before, null where it is
/// not known. Needs the current context.
RenderVerdict judge_rendered(const Particles& particles, const Particles* earlier, const Scene& scene, int frame,
                             const Profile& profile, const KnownOperations& known,
                             const std::filesystem::path& shaders);

/// The frame that a run stands at, drawn by the GPU. Needs the run's context.
JudgedPicture judged_picture(const FrameRun& run, const std::filesystem::path& shaders);

/// Pictures of one frame of a check: the first that differs, or else the last.
class FrameImages {
  public:
    /// Of the files that `write` leaves.
    static constexpr std::array<std::string_view, 6> names{"cdt_reference.png",  "cdt_gpu.png",
                                                           "cdt_difference.png", "frame_reference.png",
                                                           "frame_gpu.png",      "frame_difference.png"};

    void keep(const ComparedFrame& frame);

    /// The frame that pictures are of; below 0: none was kept.
    [[nodiscard]] int frame() const { return frame_; }

    /// That frame as each side renders its own particles, and their difference, PNG. Needs the current context.
    [[nodiscard]] std::array<std::string, 3> rendered(const Scene& scene, const Profile& profile,
                                                      const std::filesystem::path& shaders) const;

    /// Both CDTs and their difference, and the same of the frame as each side renders its own particles. Needs the
    /// current context.
    void write(OutputFiles& files, const std::filesystem::path& directory, const Scene& scene, const Profile& profile,
               const std::filesystem::path& shaders) const;

  private:
    int frame_ = -1;
    bool differs_ = false;
    Particles reference_, gpu_;
    CollisionImage reference_cdt_, gpu_cdt_;
};

} // namespace lockstep
