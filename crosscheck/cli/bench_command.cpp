#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/rule_by_text.hpp"
#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/cli/system_verbs.hpp"
#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/command/judging_options.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/judge/stopwatch.hpp"
#include "crosscheck/report/progress.hpp"
#include "crosscheck/report/report.hpp"
#include "crosscheck/report/statistics.hpp"
#include "crosscheck/report/verdict_text.hpp"
#include "crosscheck/scene/profile_text.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "crosscheck/scene/scene_constants.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "gpu/collision/render_pass.hpp"
#include "gpu/collision/simulation.hpp"
#include "gpu/context.hpp"
#include "gpu/pass_timer.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep {
namespace {

struct BenchRequest {
    RunOptions run;
    std::vector<std::size_t> counts{50000, 100000, 150000, 200000};
    std::vector<int> radii{1, 4};
    int warm_up = 3;
    Legal legal = Legal::by_text;
    PassRules rules;
    bool gl_only = false, floor = false, no_render = false;
};

/// GPU time of a pass by itself, and of all frames' picture: medians, seconds.
using PassSeconds = std::vector<std::pair<std::string, double>>;

/// Seconds a frame, medians over the run.
struct Timing {
    double gl = 0.0;        ///< GL frames alone, without any check, to glFinish
    double timer = 0.0;     ///< the same by the GPU's own clock (GL_TIME_ELAPSED)
    double check = 0.0;     ///< the whole of a checked frame
    double reference = 0.0; ///< the reference's share of it
    double render = 0.0;    ///< the picture of the last frame, by the GPU's own clock
    PassSeconds passes;
    CheckReport report;
};

/// GL frames from the scene's start, without any check.
void time_alone(GpuSimulation& gpu, const Scene& scene, int frames, std::vector<double>& wall,
                std::vector<double>& timer) {
    gpu.upload(scene.start, empty_cdt(scene));
    for (int frame = 0; frame < frames; ++frame) {
        const FrameParams params = frame_params(scene, frame);
        const double start = now();
        gpu.step(params);
        wall.push_back(now() - start);
        timer.push_back(gpu.frame_seconds());
    }
}

/// Frames as they come, each pass between timestamps.
PassSeconds time_passes(GpuSimulation& gpu, const Scene& scene, int frames) {
    gpu.upload(scene.start, empty_cdt(scene));
    PassSeconds passes;
    std::vector<std::vector<double>> seconds;
    for (int frame = 0; frame < frames; ++frame) {
        const FrameParams params = frame_params(scene, frame);
        gpu.step(params);
        passes = gpu.pass_seconds(params);
        seconds.resize(passes.size());
        for (std::size_t p = 0; p < passes.size(); ++p)
            seconds[p].push_back(passes[p].second);
    }
    for (std::size_t p = 0; p < passes.size(); ++p)
        passes[p].second = median(seconds[p]);
    return passes;
}

double time_rendering(const GpuSimulation& gpu, const Scene& scene, const BenchRequest& options) {
    RenderPass pass(scene.switches, options.run.shaders, scene.render_width, scene.render_height);
    const FrameParams params = frame_params(scene, options.run.frames - 1);
    const GlQuery timer;
    std::vector<double> seconds;
    for (int frame = 0; frame < options.warm_up + options.run.frames; ++frame) {
        {
            const RunningTimer timing(timer);
            pass.run(gpu.particle_buffer(), gpu.obstacle_buffer(), params);
        }
        gl::Finish();
        if (frame >= options.warm_up)
            seconds.push_back(seconds_of(timer));
    }
    return median(seconds);
}

/// The count that takes `budget` seconds, on the line through the two measured ones nearest to it; nothing where that
/// does not rise.
std::optional<double> count_within(double budget, std::span<const std::size_t> counts,
                                   std::span<const double> seconds) {
    if (counts.size() < 2)
        return {};
    std::size_t upper = 1;
    while (upper + 1 < counts.size() && seconds[upper] < budget)
        ++upper;
    const auto x0 = static_cast<double>(counts[upper - 1]), x1 = static_cast<double>(counts[upper]);
    const double slope = (seconds[upper] - seconds[upper - 1]) / (x1 - x0);
    if (!(slope > 0.0))
        return {};
    return std::max(0.0, x0 + (budget - seconds[upper - 1]) / slope);
}

/// "particles in 16.7 ms: 1,200,000, with rendering 700,000; in 6.9 ms: ..."
std::string within_frames(std::span<const std::size_t> counts, std::span<const double> state,
                          std::span<const double> rendered) {
    std::string text;
    for (const auto& [words, budget] : {std::pair{"16.7 ms", 1.0 / 60.0}, {"6.9 ms", 1.0 / 144.0}}) {
        const auto alone = count_within(budget, counts, state), with = count_within(budget, counts, rendered);
        if (!alone || !with)
            return {};
        text += fmt::format("{} in {}: {}, with rendering {}", text.empty() ? "particles" : ";", words,
                            grouped(static_cast<std::uint64_t>(*alone)), grouped(static_cast<std::uint64_t>(*with)));
        if (*alone > static_cast<double>(counts.back()) || *with > static_cast<double>(counts.back()))
            text += " (beyond what was measured)";
    }
    return text;
}

/// The GL frames alone run before and after the checked ones, so that a machine that warms up or slows down shows on
/// both sides of the ratio.
Timing time_run(const Scene& scene, const Profile& profile, const BenchRequest& options) {
    GpuSimulation gpu(scene, options.run.shaders);
    std::vector<double> alone, timer, checked, reference, ignored;
    time_alone(gpu, scene, options.warm_up, ignored, ignored);
    time_alone(gpu, scene, options.run.frames, alone, timer);
    Timing timing;
    const auto finish = [&] {
        timing.passes = time_passes(gpu, scene, options.run.frames);
        if (!options.no_render)
            timing.render = time_rendering(gpu, scene, options);
        timing.gl = median(alone);
        timing.timer = median(timer);
        return timing;
    };
    if (options.gl_only)
        return finish();
    double last = 0.0;
    CheckOptions check_options;
    check_options.frames = options.run.frames;
    check_options.repeated_frames = 0;
    const ShaderUse shaders = shaders_to_run(options.run, scene);
    check_options.known =
        known_operations(rule_by_text(options.legal, scene, shaders, options.run.shaders, false).legal, profile);
    Progress progress(fmt::format("bench {}", scene.start.size()), options.run.frames, true);
    check_options.on_frame = [&](int done) {
        checked.push_back(now() - last);
        progress.show(done);
        last = now();
    };
    last = now();
    timing.report = check(scene, profile, gpu, check_options);
    ask_power(timing.report, options.rules.power_at_least);
    ask_hits(timing.report, options.rules);
    for (const FrameTimes& times : timing.report.times)
        reference.push_back(times.reference);
    time_alone(gpu, scene, options.run.frames, alone, timer);
    timing.check = median(checked);
    timing.reference = median(reference);
    return finish();
}

std::size_t peak_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

int run(const BenchRequest& options) {
    check_scene_exists(options.run.scene);
    if (const RegisteredSystem* system = system_of(options.run))
        return bench_system(
            *system, options.run,
            {options.counts, options.warm_up, options.legal, options.rules, options.gl_only, options.floor});
    static_cast<void>(
        shaders_to_run(options.run, load(options.run))); // says what is wrong with the scene before the table begins
    const Context context(parse_context_request(options.run.gl));
    const Profile profile = options.gl_only ? Profile() : measured_profile(context, options.run.shaders);
    fmt::print("{}\n{} each, median ms a frame; {}\n\n", summary(context.describe()),
               counted(static_cast<std::size_t>(options.run.frames), "frame"),
               options.gl_only ? "GL alone, nothing checked" : fmt::format("profile {}", describe(profile)));
    if (options.gl_only)
        fmt::print("{:>6} {:>9} {:>9} {:>9}\n", "radius", "particles", "GL", "GL timer");
    else
        fmt::print("{:>6} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8}  {:<16} {}\n", "radius", "particles", "GL",
                   "GL timer", "reference", "check", "GL/ref", "check/GL", "hash", "verdict");
    int status = status_agree;
    std::size_t largest = 0;
    for (const int radius : options.radii) {
        std::vector<double> gl, reference, timer, rendered;
        for (const std::size_t count : options.counts) {
            RunOptions run = options.run;
            run.particles = count;
            run.set.push_back(fmt::format("texel_collide_range={}", radius));
            const Timing t = time_run(load(run), profile, options);
            if (options.gl_only)
                fmt::print("{:>6} {:>9} {:>9.3f} {:>9.3f}\n", radius, count, t.gl * 1e3, t.timer * 1e3);
            else
                fmt::print("{:>6} {:>9} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f} {:>7.2f}x {:>7.2f}x  {} {}\n", radius,
                           count, t.gl * 1e3, t.timer * 1e3, t.reference * 1e3, t.check * 1e3, t.gl / t.reference,
                           t.check / t.gl, hash_text(t.report.gpu_hash), verdict_words(t.report));
            fmt::print("{:>16} GL timer of each pass:", "");
            for (const auto& [pass, seconds] : t.passes)
                fmt::print(" {} {:.3f},", pass, seconds * 1e3);
            if (options.no_render)
                fmt::print(" nothing rendered\n");
            else
                fmt::print(" rendering apart {:.3f}\n", t.render * 1e3);
            std::fflush(stdout);
            if (!options.gl_only && !passes(t.report, options.rules))
                status = status_differ;
            gl.push_back(t.gl);
            timer.push_back(t.timer);
            rendered.push_back(t.timer + t.render);
            reference.push_back(t.reference);
            largest = std::max(largest, count);
        }
        if (options.counts.size() > 1 && options.gl_only)
            fmt::print("       time ~ particles^{:.2f} (GL)\n", fitted_exponent(options.counts, gl));
        else if (options.counts.size() > 1)
            fmt::print("       time ~ particles^{:.2f} (GL), ^{:.2f} (reference)\n",
                       fitted_exponent(options.counts, gl), fitted_exponent(options.counts, reference));
        if (const std::string line = within_frames(options.counts, timer, rendered);
            !line.empty() && !options.no_render)
            fmt::print("       {}, by the GL timer\n", line);
    }
    fmt::print("peak memory {:.0f} MiB, {:.0f} bytes a particle at {}\n", static_cast<double>(peak_bytes()) / 1048576.0,
               static_cast<double>(peak_bytes()) / static_cast<double>(largest), counted(largest, "particle"));
    return status;
}

/// Throws Error where an option was given that the others, or the scene's system, leave without effect.
void check_bench_options(const Call& call, const BenchRequest& options) {
    if (call.has("--particles") && call.has("--counts"))
        throw Error("bench: --particles N and --counts N mean the same; right is one of them");
    if (options.gl_only)
        for (const std::string_view name : {"--legal", "--allow-undefined", "--require-hits", "--power-at-least"})
            if (call.has(name))
                throw Error(fmt::format("bench: {} does not go with --gl-only, which judges nothing", name));
    const bool is_registered = system_of(options.run) != nullptr;
    for (const std::string_view name : {"--radius", "--no-render", "--require-hits"})
        if (call.has(name) && is_registered)
            throw Error(fmt::format("bench: {} goes with scenes of system collision", name));
    if (options.floor && !is_registered)
        throw Error("bench: --floor does not go with scenes of system collision");
}

} // namespace

Verb bench_command() {
    auto options = std::make_shared<BenchRequest>();
    Verb verb{"bench", "time GL frames, reference and check in one run, with the state hash"};
    add_scene_options(verb, options->run);
    add_gl_options(verb, options->run);
    options->run.frames = 30;
    verb.add(integer_option("--frames", "N", {1, 1'000'000}, options->run.frames, "frames a measurement"));
    verb.add(integers_option("--counts", "N,...", {1, most_particles}, options->counts, "particle counts"));
    verb.add(integer_option("--warm-up", "N", {0, 10'000}, options->warm_up, "frames run before the measured ones"));
    verb.add(
        integers_option("--radius", "R,...", {0, widest_neighbourhood}, options->radii, "neighbourhood radii, texels"));
    verb.add(flag("--gl-only", options->gl_only, "time GL alone: neither reference nor check, and so no verdict"));
    verb.add(flag("--floor", options->floor,
                  "also time what bounds the passes: a copy of each buffer, and for system lights as many atomics"));
    verb.add(flag("--no-render", options->no_render, "leave out the time of the picture"));
    add_legal_option(verb, options->legal);
    add_pass_options(verb, options->rules);
    verb.footer = "Exit status: as lockstep check's, 1 where a row does not pass.\n"
                  "Example: lockstep bench data/scenes/lattice.json --counts 50000,200000 --radius 1";
    verb.run = [options](const Call& call) {
        check_bench_options(call, *options);
        if (options->run.particles)
            options->counts = {*options->run.particles};
        return run(*options);
    };
    return verb;
}

} // namespace lockstep
