#pragma once
/// lockstep in a test of one's own, whatever the test framework (docs/unit_tests.md):
///
///     const lockstep::Gl gl;                                        // false where there is none
///     const auto scene = lockstep::load_scene("streams.json", {.particles = 2000});
///     lockstep::UserShaders gpu(gl, scene, "my_shaders");           // or an engine derived from lockstep::GpuSide
///     const auto result = lockstep::match_reference(gpu, scene, {.frames = 120});
///     if (!result.passed())
///         std::cerr << result.text();
///
/// Errors that keep a test from running (a file, a shader that does not compile) are thrown: lockstep::Error.
#ifdef __FAST_MATH__
#error "lockstep compares bits: compile what includes its headers without -ffast-math"
#endif

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/judge/legal.hpp"
#include "crosscheck/report/power_text.hpp"
#include "crosscheck/report/report.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "gpu/collision/gpu_side.hpp"
#include "gpu/context.hpp"
#include "gpu/data_folder.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

struct ProbeResult;

/// A GL to test on: a context without a window, current from now on, and its driver measured (half a second on
/// llvmpipe). A test program needs one, for as long as its UserShaders live.
class Gl {
  public:
    /// `context`: auto, osmesa, egl or egl-device:N; empty: $LOCKSTEP_GL, else auto. Where that context cannot be had
    /// this is false and missing() tells why. Throws Error for a name that is none of these, and for a driver that
    /// cannot be measured (GLSL without `precise`).
    explicit Gl(std::string_view context = "");

    explicit operator bool() const { return context_.has_value(); }

    /// Why there is none, one line; empty if there is.
    [[nodiscard]] const std::string& missing() const { return missing_; }

    /// Renderer, version and context, one line.
    [[nodiscard]] std::string name() const;

    /// How the driver computes what GL leaves open, in passes of `shaders`.
    [[nodiscard]] Profile profile(const std::filesystem::path& shaders = {}) const;

    /// The same where a stage says `precise` of nothing; `said_elsewhere`: another one does.
    [[nodiscard]] Profile profile_without_precise(bool said_elsewhere = false) const;

    /// The context's name as asked for.
    [[nodiscard]] const std::string& asked() const { return asked_; }

  private:
    std::string asked_;
    std::optional<Context> context_;
    std::string missing_;
    std::shared_ptr<const ProbeResult> probed_;
    Profile profile_;
};

class GpuSimulation;

/// Whether shaders that do not run in the scene may lie in a folder beside those that do.
enum class UnusedShaders { refused, allowed };

/// The passes on GL, with shaders of one's own.
class UserShaders : public GpuSide {
  public:
    /// `folder`: any of the stages collision_pass.vert, .geom, .frag and of the other passes, and files they include;
    /// lockstep's own for the rest (docs/own_shader.md). Throws Error for what the compiler says, with
    /// file and line, for names that do not fit, for a folder of which nothing runs, and where `gl` is missing. `gl`
    /// outlives this.
    UserShaders(const Gl& gl, const Scene& scene, const std::filesystem::path& folder,
                UnusedShaders unused = UnusedShaders::refused);
    ~UserShaders() override;

    [[nodiscard]] SideDescription describe() const override;
    void upload(const Particles& particles, const CollisionImage& cdt) override;
    void step(const FrameParams& params) override;
    void begin_step(const FrameParams& params) override;
    void read(Particles& particles) const override;
    void read(CollisionImage& cdt) const override;
    [[nodiscard]] bool repeats() const override;
    void lay_canary() override;
    void find_canary(const Particles& particles, const CollisionImage& cdt, int frame) const override;
    void repeat_step(const FrameParams& params) override;
    [[nodiscard]] bool holds(const Particles& particles) const override;

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  private:
    const Gl& gl_;
    std::filesystem::path folder_;
    UnusedShaders unused_;
    ShaderUse use_;
    std::vector<ShaderWarning> warnings_;
    std::unique_ptr<GpuSimulation> simulation_;
};

/// How a side is held against the reference; as the options of `lockstep check`.
struct MatchOptions {
    int frames = 60; ///< from the scene's start
    CheckMode mode = CheckMode::resync;
    Legal legal = Legal::measured;
    bool allow_undefined = false; ///< pass what rests on what GL leaves open
    bool require_hits = false;    ///< fail a run in which nothing collided
    double power_at_least = 0.0;  ///< fail a run that would have shown a smaller share of the mistakes with names
    /// Draw the last frame on both sides, too, and judge it; for UserShaders alone.
    bool render = false;
    /// The command that repeats it where `lockstep check` cannot, for an engine or a scene made in code; empty: this
    /// program's own command line.
    std::string repeat = {};
};

/// What match_reference found.
class MatchResult {
  public:
    MatchResult(CheckReport report, RunDescription run, bool passed);

    /// Every bit agrees, or what differs is legal; in free mode every bit.
    [[nodiscard]] bool passed() const { return passed_; }

    /// The report of `lockstep check` (docs/report_lines.md), at most 60 lines, the last the command that
    /// repeats it where something differs. Lines that are longer than `width` columns are folded; 0: none is.
    [[nodiscard]] std::string text(std::size_t width = 0) const;

    /// The report's line `verdict`: "DIVERGENT from frame 3 on: 1 particle states in 8 frames, which no legal run
    /// explains".
    [[nodiscard]] std::string verdict() const;

    /// The same report as text() for a test that failed: verdict, cause, first difference and the command that repeats
    /// it stand first.
    [[nodiscard]] std::string failure(std::size_t width = 0) const;

    [[nodiscard]] const CheckReport& report() const { return report_; }

    /// Renderer, profile and the rest of a report's heading.
    [[nodiscard]] const RunDescription& run() const { return run_; }

  private:
    CheckReport report_;
    RunDescription run_;
    bool passed_;
};

/// Runs `gpu` and the reference from the scene's start and compares every bit of every particle and texel after every
/// frame. Throws Error when that would prove nothing: a GL error, output that was not written, no frame.
MatchResult match_reference(GpuSide& gpu, const Scene& scene, const MatchOptions& options = {});

/// A command line that runs this program again from the folder it runs in, with these arguments.
std::string this_program(const std::vector<std::string>& arguments);

#ifdef LOCKSTEP_PACKAGE_DATA
inline const bool package_data_known = use_package_data(LOCKSTEP_PACKAGE_DATA);
#endif

} // namespace lockstep
