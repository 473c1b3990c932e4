#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "crosscheck/command/verb.hpp"
#include "crosscheck/files/output_files.hpp"
#include "gpu/shader_use.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

struct RegisteredSystem;

/// A scene file, read when it is first asked for, and once: it may be a pipe. Copies share it.
class SceneDocument {
  public:
    /// Throws Error where it cannot be read.
    [[nodiscard]] const nlohmann::json& of(const std::filesystem::path& file) const;

  private:
    struct Read;
    std::shared_ptr<Read> read_ = nothing_read();
    static std::shared_ptr<Read> nothing_read();
};

/// The options that say what is run; every verb that runs a scene has them.
struct RunOptions {
    std::filesystem::path scene;
    std::optional<std::size_t> particles;
    std::optional<std::string> preset;
    std::vector<std::string> set;
    int frames = 60;
    int threads = 0; ///< 0: one a core
    std::string gl = "auto";
    std::filesystem::path shaders;                             ///< looked into first; empty: only the shipped shaders
    bool allow_unused = false;                                 ///< shaders may lie there that do not run
    std::filesystem::path reference;                           ///< shaders that take the place of twins; empty: none do
    bool shaders_by_scene = false, reference_by_scene = false; ///< the scene names them, not the command line
    SceneDocument document = {};
};

enum class SceneArgument { required, optional };

void add_scene_options(Verb& verb, RunOptions& options, SceneArgument scene = SceneArgument::required);
/// Of those the preset, switches and constants, and the threads.
void add_settings_options(Verb& verb, RunOptions& options);
void add_threads_option(Verb& verb, RunOptions& options);
void add_gl_options(Verb& verb, RunOptions& options);
/// Of the verbs that take a plain shader as a reference.
void add_reference_option(Verb& verb, RunOptions& options);
void add_profile_option(Verb& verb, std::string& profile);

/// --trace FILE instead of the scene, which is then optional. check_scene_or_trace throws Error unless one of both is
/// given, or when an option stands there that only a run on this machine's GL has.
void add_trace_option(Verb& verb, std::filesystem::path& trace);
void check_scene_or_trace(const Call& call, const RunOptions& options, const std::filesystem::path& trace);

/// Throws Error where no file is named so; says which is, beside it or among the scenes that come with lockstep.
void check_scene_exists(const std::filesystem::path& scene);

/// The registered system that the scene is of; null where it is the default one's. Throws Error where the scene cannot
/// be read, or is of no system, with the names there are.
const RegisteredSystem* system_of(const RunOptions& options);

/// Throws Error where references are given: the collision system's passes have none but their twins.
void expect_twins(const RunOptions& options);

/// Loads the scene and sets the thread count.
Scene load(const RunOptions& options);

/// What a run of these options reads is no output of it.
void protect_inputs(const RunOptions& options, OutputFiles& files);

/// Whose shaders will run. Throws Error like check_shader_use. `rendered`: the rendered frame is drawn, too.
ShaderUse shaders_to_run(const RunOptions& options, const Scene& scene, bool rendered = false);

/// The options as they would be typed again in a shell, with another frame count.
std::string command_line(const std::string& verb, const RunOptions& options, int frames);

/// The same with options of the verb's own ("--frame 3 --particle 7") instead.
std::string command_line(const std::string& verb, const RunOptions& options, const std::string& place);

/// "corrected, texel_collide_range=4"
std::string settings_text(const RunOptions& options, const Scene& scene);

} // namespace lockstep
