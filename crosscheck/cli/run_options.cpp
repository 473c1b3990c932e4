#include "crosscheck/cli/run_options.hpp"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

#include "crosscheck/cli/systems.hpp"
#include "crosscheck/command/judging_options.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/files/shell_words.hpp"
#include "crosscheck/files/threads.hpp"
#include "crosscheck/judge/registered_system.hpp"
#include "crosscheck/scene/run_text.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/data_folder.hpp"
#include "gpu/stages_run.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {

namespace {

/// A scene that is there, in `folder`, whose name is near.
std::filesystem::path near_scene(const std::filesystem::path& folder, const std::filesystem::path& scene) {
    std::error_code error;
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, error))
        if (entry.path().extension() == ".json" && entry.exists(error))
            names.push_back(entry.path().stem().string());
    const std::string name = nearest_name(scene.stem().string(), names);
    return name.empty() ? "" : folder / (name + ".json");
}

} // namespace

void check_scene_exists(const std::filesystem::path& scene) {
    std::error_code error;
    if (std::filesystem::status(scene, error).type() != std::filesystem::file_type::not_found)
        return;
    std::filesystem::path meant = near_scene(scene.parent_path(), scene);
    if (meant.empty())
        meant = near_scene(std::filesystem::proximate(shipped_scene("lattice").parent_path(), error), scene);
    const std::string leads = std::filesystem::is_symlink(std::filesystem::symlink_status(scene, error))
                                  ? fmt::format(": a link to {}", std::filesystem::read_symlink(scene, error).string())
                                  : std::string();
    throw Error(fmt::format("{}{}: cannot be read: {}{}", scene.string(), leads, std::strerror(ENOENT),
                            meant.empty() ? "" : fmt::format("; did you mean {}?", meant.string())));
}

void add_scene_options(Verb& verb, RunOptions& options, SceneArgument scene) {
    verb.add(path_option("scene", "SCENE", options.scene, "scene file, data/scenes/*.json"));
    verb.options.back().required = scene == SceneArgument::required;
    verb.add(integer_option("--particles", "N", {1, most_particles}, options.particles,
                            "number of particles instead of the scene's"));
    add_settings_options(verb, options);
}

void add_settings_options(Verb& verb, RunOptions& options) {
    verb.add(word_option("--preset", {"listing", "paper", "corrected", "exact"}, options.preset,
                         "instead of the scene's preset; listing is of system collision alone"));
    verb.add(settings_option("--set", "NAME=VALUE", options.set,
                             "change one switch, or in system collision a constant; may be repeated"));
    add_threads_option(verb, options);
}

void add_threads_option(Verb& verb, RunOptions& options) {
    verb.add(integer_option("--threads", "N", {0, most_threads}, options.threads,
                            "threads of the reference, 0: one a core"));
}

void add_gl_options(Verb& verb, RunOptions& options) {
    verb.add(text_option("--gl", "auto|osmesa|egl|egl-device:N", options.gl, "which GL to open"));
    verb.add(path_option("--shaders", "DIR", options.shaders, "take shader files from here first"));
    verb.add(flag("--allow-unused", options.allow_unused, "let shaders that do not run here lie beside those that do"));
    add_werror_option(verb);
}

void add_reference_option(Verb& verb, RunOptions& options) {
    verb.add(path_option("--reference", "DIR", options.reference,
                         "compute and vertex shaders that are the reference of their passes, instead of the twins"));
}

void add_profile_option(Verb& verb, std::string& profile) {
    verb.add(word_option("--profile", {"strict", "llvmpipe", "nvidia"}, profile,
                         "strict, llvmpipe or nvidia: the reference's order of sums"));
}

void add_trace_option(Verb& verb, std::filesystem::path& trace) {
    verb.add(
        path_option("--trace", "FILE", trace, "instead of a scene: a recorded run (lockstep record); needs no GL"));
}

void check_scene_or_trace(const Call& call, const RunOptions& options, const std::filesystem::path& trace) {
    if (options.scene.empty() && trace.empty())
        throw Error(fmt::format("{}: a scene or --trace FILE is needed", call.verb.name));
    if (trace.empty())
        return;
    if (const RegisteredSystem* system = system_of(options);
        !options.scene.empty() && (system == nullptr || system->folders == nullptr))
        throw Error(fmt::format("{}: a scene does not go with --trace, which brings its own", call.verb.name));
    for (const char* name : {"--particles", "--preset", "--set", "--gl", "--shaders", "--allow-unused", "--images",
                             "--render", "--no-render", "--werror-shaders", "--cover-at-least"})
        if (call.has(name))
            throw Error(
                fmt::format("{}: {} goes with a scene that is run here, not with --trace", call.verb.name, name));
}

struct SceneDocument::Read {
    std::filesystem::path file;
    nlohmann::json document;
};

std::shared_ptr<SceneDocument::Read> SceneDocument::nothing_read() { return std::make_shared<Read>(); }

const nlohmann::json& SceneDocument::of(const std::filesystem::path& file) const {
    if (read_->file != file) {
        read_->document = read_json(file);
        read_->file = file;
    }
    return read_->document;
}

const RegisteredSystem* system_of(const RunOptions& options) {
    std::error_code error;
    if (options.scene.empty() || !std::filesystem::exists(options.scene, error))
        return nullptr; // load() says so
    return system_of_scene(JsonValue(options.document.of(options.scene), options.scene.string()));
}

void expect_twins(const RunOptions& options) {
    if (!options.reference.empty())
        throw Error(fmt::format("--reference {}: the passes of system {} keep their twins", options.reference.string(),
                                default_system));
}

Scene load(const RunOptions& options) {
    check_scene_exists(options.scene);
    if (const RegisteredSystem* system = system_of(options))
        throw Error(fmt::format(
            "{}: is a scene of system {}, which bench, capsule, check, debug, explain, hash, record and render "
            "run; right here is one of system {}",
            options.scene.string(), name_of(*system), default_system));
    expect_twins(options);
    start_threads(options.threads);
    return read_scene(options.document.of(options.scene), options.scene,
                      {options.particles, options.preset, options.set});
}

void protect_inputs(const RunOptions& options, OutputFiles& files) {
    if (!options.scene.empty()) // else a recording's
        for (const std::filesystem::path& file : scene_files(options.document.of(options.scene), options.scene))
            files.protect(file);
    files.protect(options.shaders);
    files.protect(options.reference);
}

ShaderUse shaders_to_run(const RunOptions& options, const Scene& scene, bool rendered) {
    const ShaderUse whole = shader_use(scene, options.shaders, true);
    ShaderUse use = shader_use(scene, options.shaders, rendered);
    use.unused = whole.unused; // what draws the picture is not misspelt
    check_shader_use(use, options.shaders, options.allow_unused);
    add_compiled(use, whole);
    return use;
}

std::string command_line(const std::string& verb, const RunOptions& options, int frames) {
    return command_line(verb, options, fmt::format("--frames {}", frames));
}

std::string command_line(const std::string& verb, const RunOptions& options, const std::string& place) {
    std::string line =
        fmt::format("lockstep {} {}{}{}", verb, shell_path(options.scene), place.empty() ? "" : " ", place);
    if (options.particles)
        line += fmt::format(" --particles {}", *options.particles);
    if (options.preset)
        line += fmt::format(" --preset {}", shell_word(*options.preset));
    for (const std::string& change : options.set)
        line += fmt::format(" --set {}", shell_word(change));
    if (options.threads > 0)
        line += fmt::format(" --threads {}", options.threads);
    if (options.gl != "auto")
        line += fmt::format(" --gl {}", options.gl);
    if (!options.shaders.empty() && !options.shaders_by_scene)
        line += fmt::format(" --shaders {}", shell_path(options.shaders));
    if (options.allow_unused && !options.shaders_by_scene)
        line += " --allow-unused";
    if (!options.reference.empty() && !options.reference_by_scene)
        line += fmt::format(" --reference {}", shell_path(options.reference));
    return line + werror_option_text();
}

std::string settings_text(const RunOptions& options, const Scene& scene) {
    std::string text = options.preset ? fmt::format("preset {}", *options.preset) : "the scene's";
    for (const std::string& change : options.set)
        text += ", " + change;
    return fmt::format("{} ({})", text, switches_text(scene));
}

} // namespace lockstep
