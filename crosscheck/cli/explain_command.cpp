#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/rule_by_text.hpp"
#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/cli/system_verbs.hpp"
#include "crosscheck/collision/judge/frame_run.hpp"
#include "crosscheck/collision/record/trace_side.hpp"
#include "crosscheck/collision/report/explain_text.hpp"
#include "crosscheck/collision/report/frame_images.hpp"
#include "crosscheck/collision/report/named_items.hpp"
#include "crosscheck/collision/report/pixel_text.hpp"
#include "crosscheck/command/judging_options.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/threads.hpp"
#include "crosscheck/package/item_verbs.hpp"
#include "crosscheck/report/colour.hpp"
#include "crosscheck/report/progress.hpp"
#include "crosscheck/report/shader_diff.hpp"
#include "crosscheck/scene/fragment_stages.hpp"
#include "crosscheck/scene/profile_text.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "gpu/context.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

struct ExplainRequest {
    RunOptions run;
    int frame = 0;
    std::filesystem::path trace; ///< instead of a scene and GL
    std::optional<std::string> particle, texel, pixel, item;
    std::string pass;
    Legal legal = Legal::by_text;
    bool hexadecimal = false;
};

std::size_t item_of(const ExplainRequest& options, const Scene& scene) {
    if (options.pixel)
        return pixel_named(*options.pixel, scene);
    return options.particle ? particle_named(*options.particle, scene) : texel_named(*options.texel, scene);
}

std::string text_of(const ExplainRequest& options, FrameRun& frames, std::size_t item, NumberFormat format) {
    if (options.texel)
        return explain_texel(frames, item, format);
    if (!options.pixel)
        return explain_particle(frames, item, format);
    return pixel_text(judged_picture(frames, options.run.shaders).table(item), format);
}

void tell(const ExplainRequest& options, FrameRun& frames, const std::string& file, const std::string& settings,
          const std::string& renderer) {
    const Scene& scene = frames.scene();
    const std::size_t item = item_of(options, scene);
    {
        Progress progress("explain", options.frame, true);
        frames.go_to(options.frame, [&](int done) { progress.show(done); });
    }
    const NumberFormat format = options.hexadecimal ? NumberFormat::hexadecimal : NumberFormat::decimal;
    fmt::print("{}\n", run_heading(scene.name, file, settings, renderer, frames.profile()));
    fmt::print("{}", colored(plain_text(text_of(options, frames, item, format))));
}

void explain_scene(const ExplainRequest& options) {
    const Scene scene = load(options.run);
    const ShaderUse shaders = shaders_to_run(options.run, scene, options.pixel.has_value());
    item_of(options, scene);
    const Context context(parse_context_request(options.run.gl));
    const Profile profile = measured_profile(context, scene, options.run.shaders);
    const Legal legal =
        rule_by_text(options.legal, scene, shaders, options.run.shaders, options.pixel.has_value()).legal;
    FrameRun frames(scene, profile, known_operations(legal, profile), options.run.shaders);
    tell(options, frames, options.run.scene.string(), settings_text(options.run, scene), summary(context.describe()));
    fmt::print("{}", plain_text(shader_diff_text(shaders)));
}

void explain_trace(const ExplainRequest& options) {
    expect_twins(options.run);
    start_threads(options.run.threads);
    TraceReader trace(options.trace);
    const TraceInfo& info = trace.info();
    item_of(options, info.scene);
    if (options.frame >= info.frames)
        throw Error(fmt::format("--frame {}: {} holds frames 0 to {}", options.frame, info.file, info.frames - 1));
    TraceSide recorded(trace);
    FrameRun frames(info.scene, followed_profile(info), known_operations(info, options.legal), recorded);
    tell(options, frames, info.file, info.settings.empty() ? "untold" : info.settings,
         fmt::format("recorded: {}", info.renderer.empty() ? "untold" : info.renderer));
}

int run(const ExplainRequest& options, const Call& call) {
    if (options.pixel && !options.trace.empty())
        throw Error(
            "explain: --pixel needs a scene, since a recording holds no picture; --particle and --texel go with one");
    if (const RegisteredSystem* system =
            options.trace.empty() ? system_of(options.run) : system_of_recording(options.trace)) {
        if (!options.item || options.particle || options.texel || options.pixel)
            throw Error(fmt::format("explain: a scene of system {} needs --item I", name_of(*system)));
        check_scene_or_trace(call, options.run, options.trace);
        return explain_system(*system, options.run,
                              {options.frame, options.pass, *options.item, options.legal, options.hexadecimal},
                              options.trace);
    }
    if (options.item || !options.pass.empty())
        throw Error(fmt::format("explain: --item and --pass do not go with a scene of system {}; --particle, --texel "
                                "and --pixel do",
                                default_system));
    const int given =
        int{options.particle.has_value()} + int{options.texel.has_value()} + int{options.pixel.has_value()};
    if (given > 1)
        throw Error("explain: --particle, --texel and --pixel do not go together; right is one of them");
    if (given == 0)
        throw Error("explain: one of --particle I, --texel X,Y and --pixel X,Y is needed");
    check_scene_or_trace(call, options.run, options.trace);
    if (options.trace.empty())
        explain_scene(options);
    else
        explain_trace(options);
    return status_agree;
}

} // namespace

Verb explain_command() {
    auto options = std::make_shared<ExplainRequest>();
    Verb verb{"explain", "both sides of one particle, texel or pixel in one frame, step by step"};
    add_scene_options(verb, options->run, SceneArgument::optional);
    add_gl_options(verb, options->run);
    add_reference_option(verb, options->run);
    add_trace_option(verb, options->trace);
    verb.add(frame_option(options->frame));
    verb.add(text_option("--particle", "I", options->particle, "the particle"));
    verb.add(
        text_option("--texel", "X,Y", options->texel, "the texel of the CDT, column and row from the bottom left"));
    verb.add(text_option("--pixel", "X,Y", options->pixel,
                         "the pixel of the rendered frame, column and row from the bottom left"));
    verb.add(text_option("--item", "I|X,Y", options->item,
                         "the item, in a scene of another system; in an image its column and row"));
    verb.add(text_option("--pass", "NAME", options->pass,
                         "the pass that makes the item; without it the first that runs in the frame"));
    add_legal_option(verb, options->legal);
    verb.add(hex_option(options->hexadecimal));
    verb.footer = "Exit status: 0 printed, 2 could not run.\n"
                  "Example: lockstep explain data/scenes/lattice.json --frame 30 --particle 17";
    verb.run = [options](const Call& call) { return run(*options, call); };
    return verb;
}

} // namespace lockstep
