#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/judging_options.hpp"
#include "crosscheck/cli/option_values.hpp"
#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/threads.hpp"
#include "crosscheck/judge/frame_run.hpp"
#include "crosscheck/record/capsule_json.hpp"
#include "crosscheck/record/trace_side.hpp"
#include "crosscheck/report/places.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "gpu/context.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

struct Options {
    RunOptions run;
    std::filesystem::path trace, output, capsule;
    int frame = 0;
    std::string particle;
    Legal legal = Legal::measured;
    bool hexadecimal = false;
};

int status_of(const Capsule& capsule) {
    const CapsuleVerdict verdict = judge(capsule);
    return verdict.differs && verdict.verdict.kind >= DifferenceClass::undefined ? status_differ : status_agree;
}

Capsule cut_from(FrameRun& run, const Options& options, const std::string& renderer, const std::string& settings) {
    const std::size_t particle = particle_named(options.particle, run.scene());
    run.go_to(options.frame);
    return cut_capsule(run.judged(), {run.scene(), renderer, settings, options.frame, particle, run.capture(particle)});
}

Capsule cut_live(const Options& options) {
    const Scene scene = load(options.run);
    static_cast<void>(shaders_to_run(options.run, scene));
    const Context context(parse_context_request(options.run.gl));
    const Profile profile = measured_profile(context, options.run.shaders);
    FrameRun run(scene, profile, known_operations(options.legal, profile), options.run.shaders);
    return cut_from(run, options, summary(context.describe()), settings_text(options.run, scene));
}

Capsule cut_recorded(const Options& options) {
    start_threads(options.run.threads);
    TraceReader trace(options.trace);
    const TraceInfo& info = trace.info();
    if (options.frame >= info.frames)
        throw Error(fmt::format("--frame {}: {} holds frames 0 to {}", options.frame, info.file, info.frames - 1));
    TraceSide recorded(trace);
    FrameRun run(info.scene, followed_profile(info), known_operations(info, options.legal), recorded);
    return cut_from(run, options, fmt::format("recorded: {}", info.renderer), info.settings);
}

int cut(const Options& options, const CLI::App& verb) {
    check_scene_or_trace(verb, options.run, options.trace);
    OutputFiles files;
    protect_inputs(options.run, files);
    files.protect(options.trace);
    files.expect(options.output);
    const Capsule capsule = options.trace.empty() ? cut_live(options) : cut_recorded(options);
    files.write(options.output, capsule_file(capsule));
    files.commit();
    return status_of(capsule);
}

int show(const Options& options) {
    const Capsule capsule = load_capsule(options.capsule);
    fmt::print("{}", plain_text(capsule_text(capsule,
                                             options.hexadecimal ? NumberFormat::hexadecimal : NumberFormat::decimal)));
    return status_of(capsule);
}

} // namespace

void add_capsule_command(CLI::App& app, int& status) {
    auto options = std::make_shared<Options>();
    CLI::App* verb =
        app.add_subcommand("capsule", "one particle's step as a small file that repeats its verdict anywhere");
    verb->require_subcommand(1);
    verb->footer("Example: lockstep capsule cut data/scenes/lattice.json --frame 30 --particle 17 -o 17.json\n"
                 "then, anywhere: lockstep capsule show 17.json");

    CLI::App* cut_verb = verb->add_subcommand("cut", "cut one out of a run, live or recorded");
    add_scene_options(*cut_verb, options->run);
    add_gl_options(*cut_verb, options->run);
    add_trace_option(*cut_verb, options->trace);
    cut_verb->add_option("--frame", options->frame, "the frame, counted from 0")
        ->required()
        ->check(integer(0, most_frames))
        ->type_name("F");
    cut_verb->add_option("--particle", options->particle, "the particle")->required()->type_name("I");
    cut_verb->add_option("-o,--output", options->output, "the capsule, JSON, at most 100 kB")
        ->required()
        ->type_name("FILE");
    add_legal_option(*cut_verb, options->legal);
    cut_verb->footer("Exit status: 0 the particle agrees or is legal, 1 it is not, 2 could not run.\n"
                     "Example: lockstep capsule cut data/scenes/lattice.json --frame 30 --particle 17 -o 17.json");
    cut_verb->callback([options, cut_verb, &status] { status = cut(*options, *cut_verb); });

    CLI::App* show_verb = verb->add_subcommand("show", "judge one again, and print its step table; needs no GL");
    show_verb->add_option("capsule", options->capsule, "what `capsule cut` wrote")->required()->type_name("FILE");
    show_verb->add_flag("--hex", options->hexadecimal, "hexadecimal floats instead of decimal ones");
    show_verb->footer("Exit status: 0 the particle agrees or is legal, 1 it is not, 2 could not run.\n"
                      "Example: lockstep capsule show 17.json");
    show_verb->callback([options, &status] { status = show(*options); });
}

} // namespace lockstep
