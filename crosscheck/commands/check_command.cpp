#include <atomic>
#include <csignal>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/atomic_file.hpp"
#include "crosscheck/check.hpp"
#include "crosscheck/commands/commands.hpp"
#include "crosscheck/commands/run_options.hpp"
#include "crosscheck/frame_images.hpp"
#include "crosscheck/hash_file.hpp"
#include "crosscheck/profiles.hpp"
#include "crosscheck/progress.hpp"
#include "crosscheck/report.hpp"
#include "gpu/context.hpp"
#include "gpu/simulation.hpp"

namespace lockstep {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

struct Options {
    RunOptions run;
    CheckMode mode = CheckMode::resync;
    std::filesystem::path json, images, hashes;
    bool quiet = false;
};

int run(const Options& options) {
    const Scene scene = load(options.run);
    if (!options.images.empty())
        make_output_directory(options.images);
    const Context context(parse_context_request(options.run.gl));
    const Profile profile = measured_profile(context);
    GpuSimulation gpu(scene, options.run.shaders);

    Progress progress("check", options.run.frames, !options.quiet);
    HashFile hashes;
    FrameImages images;
    CheckOptions check_options;
    check_options.mode = options.mode;
    check_options.frames = options.run.frames;
    check_options.on_frame = [&](int done) { progress.show(done); };
    check_options.stop = &interrupted;
    if (!options.hashes.empty() || !options.images.empty())
        check_options.on_state = [&](const ComparedFrame& frame) {
            if (!options.hashes.empty())
                hashes.add(frame);
            if (!options.images.empty())
                images.keep(frame);
        };
    std::signal(SIGINT, [](int) { interrupted = true; });
    CheckReport report;
    try {
        report = check(scene, profile, gpu, check_options);
    } catch (...) {
        std::signal(SIGINT, SIG_DFL);
        throw;
    }
    std::signal(SIGINT, SIG_DFL);

    const int repeat_frames = report.first_frame ? *report.first_frame + 1 : report.frames;
    std::string repeat = command_line("check", options.run, repeat_frames);
    if (options.mode == CheckMode::free)
        repeat += " --mode free";
    const RunDescription description{fmt::format("{} ({})", scene.name, options.run.scene.string()),
                                     summary(context.describe()),
                                     describe(profile),
                                     settings_text(options.run, scene),
                                     options.mode == CheckMode::resync ? "resync" : "free",
                                     scene.width,
                                     repeat};
    if (!options.json.empty())
        write_text_file(options.json, report_json(report, description).dump(2) + "\n");
    if (!options.hashes.empty())
        hashes.write(options.hashes);
    if (!options.images.empty())
        images.write(options.images, scene, profile, options.run.shaders);
    if (!options.quiet)
        fmt::print("{}", report_text(report, description));
    return report.verdict == Verdict::agree ? status_agree : status_differ;
}

} // namespace

void add_check_command(CLI::App& app, int& status) {
    auto options = std::make_shared<Options>();
    CLI::App* verb = app.add_subcommand("check", "run both sides and compare every bit of every frame");
    add_scene_options(*verb, options->run);
    add_gl_options(*verb, options->run);
    verb->add_option("--frames", options->run.frames, "frames to compare")
        ->check(CLI::Range(1, 100'000'000))
        ->type_name("N");
    verb->add_option("--mode", options->mode, "resync: each frame's step alone; free: both run on by themselves")
        ->transform(CLI::CheckedTransformer(
            std::map<std::string, CheckMode>{{"resync", CheckMode::resync}, {"free", CheckMode::free}}))
        ->type_name("resync|free");
    verb->add_option("--json", options->json, "write the report as JSON")->type_name("FILE");
    verb->add_option("--hashes", options->hashes, "write both sides' state hash of every frame")->type_name("FILE");
    verb->add_option("--images", options->images,
                     "write CDT and rendered frame of both sides, and their difference, as PNG")
        ->type_name("DIR");
    verb->add_flag("--quiet", options->quiet, "no report, only the exit status");
    verb->footer("Exit status: 0 agree, 1 differ, 2 could not run.\n"
                 "Example: lockstep check data/scenes/lattice.json --frames 100 --preset paper");
    verb->callback([options, &status] { status = run(*options); });
}

} // namespace lockstep
