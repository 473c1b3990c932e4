#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/rule_by_text.hpp"
#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/cli/system_verbs.hpp"
#include "crosscheck/collision/record/trace_side.hpp"
#include "crosscheck/collision/report/collision_debug_run.hpp"
#include "crosscheck/command/judging_options.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/threads.hpp"
#include "crosscheck/scene/fragment_stages.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "crosscheck/scene/scene_settings.hpp"
#include "gpu/context.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

struct DebugRequest {
    RunOptions run;
    std::filesystem::path trace; ///< instead of a scene and GL
    Legal legal = Legal::by_text;
    bool hexadecimal = false;
};

DebugSetup setup_of(const DebugRequest& options) {
    DebugSetup setup;
    setup.frames = options.run.frames;
    setup.format = number_format(options.hexadecimal);
    return setup;
}

int debug_scene(const DebugRequest& options) {
    const auto load_with = [&](const std::vector<std::string>& changes) {
        RunOptions changed = options.run;
        changed.set.insert(changed.set.end(), changes.begin(), changes.end());
        return load(changed);
    };
    const Scene scene = load_with({});
    const ShaderUse shaders = shaders_to_run(options.run, scene);
    const Legal legal = rule_by_text(options.legal, scene, shaders, options.run.shaders, false).legal;
    const Context context(parse_context_request(options.run.gl));
    const Profile profile = measured_profile(context, options.run.shaders);
    DebugSetup setup = setup_of(options);
    setup.heading = run_heading(scene.name, options.run.scene.string(), settings_text(options.run, scene),
                                summary(context.describe()), profile);
    setup.start = [&](const std::vector<std::string>& changes) {
        const Scene changed = load_with(changes);
        const Profile of_scene = with_written_codes(profile, changed, options.run.shaders);
        return std::make_unique<CollisionDebugRun>(
            std::make_unique<FrameRun>(changed, of_scene, known_operations(legal, of_scene), options.run.shaders));
    };
    return debug_run(std::move(setup));
}

int debug_trace(const DebugRequest& options) {
    expect_twins(options.run);
    start_threads(options.run.threads);
    TraceReader trace(options.trace);
    TraceSide recorded(trace);
    DebugSetup setup = setup_of(options);
    setup.recorded = trace.info().frames;
    setup.unchangeable = recorded_is_fixed;
    setup.heading = run_heading(trace.info().scene.name, trace.info().file, trace.info().settings,
                                "recorded: " + trace.info().renderer, followed_profile(trace.info()));
    setup.start = [&](const std::vector<std::string>&) {
        return std::make_unique<CollisionDebugRun>(
            std::make_unique<FrameRun>(trace.info().scene, followed_profile(trace.info()),
                                       known_operations(trace.info(), options.legal), recorded));
    };
    return debug_run(std::move(setup));
}

int run(const DebugRequest& options, const Call& call) {
    const RegisteredSystem* system =
        options.trace.empty() ? system_of(options.run) : system_of_recording(options.trace);
    check_scene_or_trace(call, options.run, options.trace);
    if (system != nullptr)
        return debug_system(*system, options.run, options.legal, setup_of(options), options.trace);
    return options.trace.empty() ? debug_scene(options) : debug_trace(options);
}

} // namespace

Verb debug_command() {
    auto options = std::make_shared<DebugRequest>();
    Verb verb{"debug", "walk through both sides by commands, typed or from a pipe"};
    add_scene_options(verb, options->run, SceneArgument::optional);
    add_gl_options(verb, options->run);
    add_reference_option(verb, options->run);
    add_trace_option(verb, options->trace);
    verb.add(integer_option("--frames", "N", {1, most_frames}, options->run.frames,
                            "how many frames `next` and `continue` look through"));
    add_legal_option(verb, options->legal);
    verb.add(hex_option(options->hexadecimal));
    verb.footer = "Commands: frame, particle, texel or pass, item; show, step, back,\n"
                  "next fetch|difference|divergence|nan, why, print, history, break, continue,\n"
                  "set NAME=VALUE, list divergent, source FILE, help, quit; # starts a comment.\n"
                  "Exit status: 0 reported, 2 could not run, or a command of a script could not be done.\n"
                  "Example: printf 'next difference\\nwhy\\n' | lockstep debug data/scenes/lattice.json --shaders mine";
    verb.run = [options](const Call& call) { return run(*options, call); };
    return verb;
}

} // namespace lockstep
