#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/cli/systems.hpp"
#include "crosscheck/judge/registered_system.hpp"
#include "crosscheck/package/text_passes.hpp"
#include "crosscheck/record/system_recording.hpp"
#include "gpu/shader_use.hpp"
#include "lockstep/system.hpp"

/// What the verbs on a scene of a registered system begin with.
namespace lockstep {

/// A scene, of a file or of a recording.
struct ReadScene {
    std::string file;
    nlohmann::json document;
    nlohmann::json options; ///< what is changed in it, and the files that it names
    SystemScene scene;
    std::vector<std::filesystem::path> places; ///< of those files

    /// What it and a run of it are read from is no output.
    void protect(const RunOptions& run, OutputFiles& files) const;
};

/// The same with the folders that the scene names where the command line names none; other shaders may lie there.
RunOptions with_folders(const RegisteredSystem& system, RunOptions run);

/// Reads the scene and sets the thread count.
ReadScene read_scene(const RegisteredSystem& system, const RunOptions& run);

/// What SystemRecording says of a scene, with `file` for messages.
ReadScene recorded_scene(const RegisteredSystem& system, const nlohmann::json& scene, const nlohmann::json& options,
                         const std::string& name, const std::string& file);

/// How much of a frame's picture runs: nothing, what its vertex stage computes, or all of it.
enum class DrawnStages : std::uint8_t { none, vertex, all };

/// Whose shaders will run. Throws Error like check_shader_use.
ShaderUse shaders_of(const SystemScene& scene, const RunOptions& run, DrawnStages drawn = DrawnStages::all);

/// The shaders of run.reference. Throws Error where none of them is of a pass of the scene, or one is no reference.
ShaderUse references_of(const SystemScene& scene, const RunOptions& run);

/// Throws Error where the GL that was asked for is not there.
Gl open_gl(const RunOptions& run);

/// What a frame draws, with the texts of shaders that were given.
struct DrawnSystem {
    SystemPicture picture;
    OwnTexts own_texts;

    [[nodiscard]] ShadedSystem shaded(ArithmeticSwitch arithmetic) {
        return {picture.system, picture.passes, arithmetic};
    }
};

/// What a verb looks into: a scene that runs here, or a recording of one.
class SystemInput {
  public:
    /// Reads it, with the shaders. `trace`: the recording, instead of run.scene; may be empty.
    SystemInput(const RegisteredSystem& system, const RunOptions& run, std::filesystem::path trace,
                DrawnStages drawn = DrawnStages::none);
    SystemInput(const SystemInput&) = delete;
    SystemInput& operator=(const SystemInput&) = delete;

    [[nodiscard]] const ReadScene& read() const { return read_; }
    [[nodiscard]] const SystemScene& scene() const { return read_.scene; }
    [[nodiscard]] const System& system() const { return read_.scene.system; }
    [[nodiscard]] bool is_recorded() const { return recording_ != nullptr; }

    /// Of the shaders that were given; empty: none were.
    [[nodiscard]] const OwnTexts& own_texts() const { return own_texts_; }
    /// Of the references that were given; empty: none were.
    [[nodiscard]] const OwnTexts& reference_texts() const { return references_.texts; }
    [[nodiscard]] ShadedSystem shaded() { return {read_.scene.system, scene().passes, scene().arithmetic}; }
    [[nodiscard]] const std::optional<ShaderUse>& shaders() const { return shaders_; } ///< of a scene that runs here
    /// Of a scene that has a picture.
    [[nodiscard]] DrawnSystem drawn(const SystemState& state, int frame) const;

    /// What it reads is no output.
    void protect(OutputFiles& files) const;
    /// Opens GL, or the recorded states. Throws Error where neither can be.
    SystemSide& open();
    [[nodiscard]] int recorded_frames() const { return recording_->frames(); }
    [[nodiscard]] SystemRecording* recording() { return recording_.get(); } ///< null: it runs here
    [[nodiscard]] const Gl& gl() const { return *gl_; }                     ///< of a scene that runs here

    /// Whose shaders ran, what they are told to have been, and warnings.
    void describe(RunDescription& about) const;
    /// SystemScene::left_open.
    [[nodiscard]] std::vector<std::string> left_open(const Profile& profile) const;
    /// A command line that runs the verb on it again.
    [[nodiscard]] std::string command(const std::string& verb, const std::string& words) const;

  private:
    OwnTexts take_texts(const ShadedSystem& of, References& references) const;

    const RunOptions& run_;
    DrawnStages drawn_;
    std::filesystem::path trace_;
    std::unique_ptr<SystemRecording> recording_;
    ReadScene read_;
    std::optional<ShaderUse> shaders_;
    OwnTexts own_texts_;
    std::optional<ShaderUse> reference_use_;
    References references_; ///< of passes that have another than their twin
    std::optional<Gl> gl_;
    std::unique_ptr<SystemSide> side_;
};

/// `gl` and `scene` outlive it.
GlSystemSide side_of(const Gl& gl, const SystemScene& scene, const RunOptions& run);

GlSystemSide side_of(const Gl& gl, const SystemPicture& picture, const SystemScene& scene, const RunOptions& run);

// Pictures of a frame's state, which the scene has.
ColorImage reference_picture(const SystemScene& scene, const SystemState& state, int frame, const Profile& profile);
ColorImage gpu_picture(const Gl& gl, const SystemScene& scene, const SystemState& state, int frame,
                       const RunOptions& run);

} // namespace lockstep
