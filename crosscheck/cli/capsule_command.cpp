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
#include "crosscheck/collision/record/capsule_json.hpp"
#include "crosscheck/collision/record/pixel_capsule_json.hpp"
#include "crosscheck/collision/record/trace_side.hpp"
#include "crosscheck/collision/report/frame_images.hpp"
#include "crosscheck/collision/report/named_items.hpp"
#include "crosscheck/command/judging_options.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/threads.hpp"
#include "crosscheck/report/colour.hpp"
#include "crosscheck/report/progress.hpp"
#include "crosscheck/scene/fragment_stages.hpp"
#include "gpu/context.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

struct CapsuleRequest {
    RunOptions run;
    std::filesystem::path trace, output, capsule;
    int frame = 0;
    std::optional<std::string> particle, pixel, item;
    std::string pass;
    Legal legal = Legal::by_text;
    bool hexadecimal = false;
};

int status_of(const Capsule& capsule) {
    const CapsuleVerdict verdict = judge(capsule);
    return verdict.differs && verdict.verdict.kind >= DifferenceClass::undefined ? status_differ : status_agree;
}

int status_of(const PixelCapsule& capsule) {
    return table_of(capsule).kind.value_or(DifferenceClass::rounding) >= DifferenceClass::undefined ? status_differ
                                                                                                    : status_agree;
}

std::string verdict_of(const Capsule& capsule) {
    const CapsuleVerdict verdict = judge(capsule);
    return verdict.differs ? std::string(class_names[static_cast<std::size_t>(verdict.verdict.kind)])
                           : "every bit agrees";
}

std::string verdict_of(const PixelCapsule& capsule) {
    const std::optional<DifferenceClass> kind = table_of(capsule).kind;
    return kind ? std::string(class_names[static_cast<std::size_t>(*kind)]) : "every bit agrees";
}

/// What is written, and in words what it holds.
struct CutCapsule {
    std::string file, words;
};

CutCapsule cut_from(FrameRun& run, const CapsuleRequest& options, const std::string& renderer,
                    const std::string& settings) {
    const std::size_t particle = particle_named(*options.particle, run.scene());
    {
        Progress progress("capsule cut", options.frame, true);
        run.go_to(options.frame, [&](int done) { progress.show(done); });
    }
    const Capsule capsule =
        cut_capsule(run.judged(), {run.scene(), renderer, settings, options.frame, particle, run.capture(particle)});
    return {capsule_file(capsule),
            fmt::format("particle {} of frame {}: {}", particle, options.frame, verdict_of(capsule))};
}

CutCapsule cut_live(const CapsuleRequest& options) {
    const Scene scene = load(options.run);
    const ShaderUse shaders = shaders_to_run(options.run, scene, options.pixel.has_value());
    const Legal legal =
        rule_by_text(options.legal, scene, shaders, options.run.shaders, options.pixel.has_value()).legal;
    const std::size_t pixel = options.pixel ? pixel_named(*options.pixel, scene) : 0;
    const Context context(parse_context_request(options.run.gl));
    const Profile profile = measured_profile(context, scene, options.run.shaders);
    FrameRun run(scene, profile, known_operations(legal, profile), options.run.shaders);
    const std::string renderer = summary(context.describe()), settings = settings_text(options.run, scene);
    if (!options.pixel)
        return cut_from(run, options, renderer, settings);
    run.go_to(options.frame);
    const PixelCapsule capsule =
        cut_pixel_capsule(judged_picture(run, options.run.shaders), {scene, renderer, settings, pixel});
    return {capsule_file(capsule),
            fmt::format("pixel ({}) of frame {}: {}", *options.pixel, options.frame, verdict_of(capsule))};
}

CutCapsule cut_recorded(const CapsuleRequest& options) {
    if (options.pixel)
        throw Error("capsule cut: --pixel needs a scene, since a recording holds no picture; --particle goes with one");
    start_threads(options.run.threads);
    TraceReader trace(options.trace);
    const TraceInfo& info = trace.info();
    if (options.frame >= info.frames)
        throw Error(fmt::format("--frame {}: {} holds frames 0 to {}", options.frame, info.file, info.frames - 1));
    TraceSide recorded(trace);
    FrameRun run(info.scene, followed_profile(info), known_operations(info, options.legal), recorded);
    return cut_from(run, options, fmt::format("recorded: {}", info.renderer), info.settings);
}

int cut(const CapsuleRequest& options, const Call& call) {
    check_scene_or_trace(call, options.run, options.trace);
    if (const RegisteredSystem* system =
            options.trace.empty() ? system_of(options.run) : system_of_recording(options.trace)) {
        if (!options.item || options.particle || options.pixel)
            throw Error(fmt::format("capsule cut: a scene of system {} needs --item I", name_of(*system)));
        return cut_system(*system, options.run, {options.frame, options.pass, *options.item, options.legal, false},
                          options.trace, options.output);
    }
    if (options.particle.has_value() == options.pixel.has_value() || options.item || !options.pass.empty())
        throw Error(fmt::format(
            "capsule cut: a scene of system {} needs --particle I or --pixel X,Y, and takes no --item or --pass",
            default_system));
    OutputFiles files;
    protect_inputs(options.run, files);
    files.protect(options.trace);
    files.expect(options.output);
    const CutCapsule capsule = options.trace.empty() ? cut_live(options) : cut_recorded(options);
    files.write(options.output, capsule.file);
    files.commit();
    fmt::print("{}holds     {}\n", files.written_text(), plain_line(capsule.words));
    return status_agree;
}

int show(const CapsuleRequest& options) {
    if (const std::optional<int> status = show_system(options.capsule, options.hexadecimal))
        return *status;
    const NumberFormat format = options.hexadecimal ? NumberFormat::hexadecimal : NumberFormat::decimal;
    const auto show_this = [&](const auto& capsule) {
        fmt::print("{}", colored(plain_text(capsule_text(capsule, format))));
        return status_of(capsule);
    };
    const nlohmann::json document = read_json(options.capsule);
    const JsonValue value(document, options.capsule.string());
    return is_pixel_capsule(value) ? show_this(read_pixel_capsule(value)) : show_this(read_capsule(value));
}

} // namespace

Verb capsule_command() {
    auto options = std::make_shared<CapsuleRequest>();
    Verb cut_verb{"cut", "cut one out of a run, live or recorded"};
    add_scene_options(cut_verb, options->run, SceneArgument::optional);
    add_gl_options(cut_verb, options->run);
    add_trace_option(cut_verb, options->trace);
    cut_verb.add(frame_option(options->frame));
    cut_verb.add(text_option("--particle", "I", options->particle, "the particle"));
    cut_verb.add(text_option("--pixel", "X,Y", options->pixel, "or the pixel of the rendered frame"));
    cut_verb.add(text_option("--item", "I|X,Y", options->item,
                             "the item, in a scene of another system; in an image its column and row"));
    cut_verb.add(text_option("--pass", "NAME", options->pass,
                             "the pass that makes the item; without it the first that runs in the frame"));
    cut_verb.add(required(path_option("-o,--output", "FILE", options->output, "the capsule, JSON, at most 100 kB")));
    add_legal_option(cut_verb, options->legal);
    cut_verb.footer = "Exit status: 0 written, 2 could not run.\n"
                      "Example: lockstep capsule cut data/scenes/lattice.json --frame 30 --particle 17 -o 17.json";
    cut_verb.run = [options](const Call& call) { return cut(*options, call); };

    Verb show_verb{"show", "judge one again, and print its step table; needs no GL"};
    show_verb.add(required(path_option("capsule", "FILE", options->capsule, "what `capsule cut` wrote")));
    show_verb.add(hex_option(options->hexadecimal));
    show_verb.footer = "Exit status: 0 it agrees or is legal, 1 it is not, 2 could not run.\n"
                       "Example: lockstep capsule show 17.json";
    show_verb.run = [options](const Call&) { return show(*options); };

    Verb verb{"capsule", "one particle's step, or a pixel, as a small file that repeats its verdict anywhere"};
    verb.footer = "Example: lockstep capsule cut data/scenes/lattice.json --frame 30 --particle 17 -o 17.json\n"
                  "then, anywhere: lockstep capsule show 17.json";
    verb.verbs = {cut_verb, show_verb};
    return verb;
}

} // namespace lockstep
