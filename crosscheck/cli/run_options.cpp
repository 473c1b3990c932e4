#include "crosscheck/cli/run_options.hpp"

#include <fmt/format.h>

#include "crosscheck/cli/option_values.hpp"
#include "crosscheck/files/shell_words.hpp"
#include "crosscheck/files/threads.hpp"
#include "crosscheck/scene/run_text.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

void add_scene_options(CLI::App& verb, RunOptions& options) {
    verb.add_option("scene", options.scene, "scene file, data/scenes/*.json")->required()->type_name("SCENE");
    verb.add_option("--particles", options.particles, "number of particles instead of the scene's")
        ->check(integer(1, most_particles))
        ->type_name("N");
    verb.add_option("--preset", options.preset, "instead of the scene's preset")->type_name("paper|corrected|exact");
    verb.add_option("--set", options.set, "change one switch or constant; may be repeated")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    add_threads_option(verb, options);
}

void add_threads_option(CLI::App& verb, RunOptions& options) {
    verb.add_option("--threads", options.threads, "threads of the reference, 0: one a core")
        ->check(integer(0, most_threads))
        ->type_name("N");
}

void add_gl_options(CLI::App& verb, RunOptions& options) {
    verb.add_option("--gl", options.gl, "which GL to open")->type_name("auto|osmesa|egl|egl-device:N");
    verb.add_option("--shaders", options.shaders, "take shader files from here first")->type_name("DIR");
    verb.add_flag("--allow-unused", options.allow_unused, "let shaders that do not run here lie beside those that do");
}

void add_trace_option(CLI::App& verb, std::filesystem::path& trace) {
    verb.get_option("scene")->required(false);
    verb.add_option("--trace", trace, "instead of a scene: a recorded run (lockstep record); needs no GL")
        ->type_name("FILE");
}

void check_scene_or_trace(const CLI::App& verb, const RunOptions& options, const std::filesystem::path& trace) {
    if (options.scene.empty() && trace.empty())
        throw Error(fmt::format("{}: a scene or --trace FILE is needed", verb.get_name()));
    if (trace.empty())
        return;
    if (!options.scene.empty())
        throw Error(fmt::format("{}: a scene does not go with --trace, which brings its own", verb.get_name()));
    for (const char* name :
         {"--particles", "--preset", "--set", "--gl", "--shaders", "--allow-unused", "--images", "--render"})
        if (const CLI::Option* option = verb.get_option_no_throw(name); option != nullptr && option->count() > 0)
            throw Error(
                fmt::format("{}: {} goes with a scene that is run here, not with --trace", verb.get_name(), name));
}

Scene load(const RunOptions& options) {
    start_threads(options.threads);
    return load_scene(options.scene, {options.particles, options.preset, options.set});
}

void protect_inputs(const RunOptions& options, OutputFiles& files) {
    std::error_code error;
    if (std::filesystem::is_regular_file(options.scene, error)) // a pipe cannot be read twice
        for (const std::filesystem::path& file : scene_files(options.scene))
            files.protect(file);
    files.protect(options.shaders);
}

ShaderUse shaders_to_run(const RunOptions& options, const Scene& scene, bool rendered) {
    ShaderUse use = shader_use(scene, options.shaders, rendered);
    check_shader_use(use, options.shaders, options.allow_unused);
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
    if (!options.shaders.empty())
        line += fmt::format(" --shaders {}", shell_path(options.shaders));
    if (options.allow_unused)
        line += " --allow-unused";
    return line;
}

std::string settings_text(const RunOptions& options, const Scene& scene) {
    std::string text = options.preset ? fmt::format("preset {}", *options.preset) : "the scene's";
    for (const std::string& change : options.set)
        text += ", " + change;
    return fmt::format("{} ({})", text, switches_text(scene));
}

} // namespace lockstep
