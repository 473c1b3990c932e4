#include <algorithm>
#include <cstdio>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/system_run.hpp"
#include "crosscheck/cli/system_verbs.hpp"
#include "crosscheck/judge/stopwatch.hpp"
#include "crosscheck/judge/system_check.hpp"
#include "crosscheck/report/report.hpp"
#include "crosscheck/report/statistics.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep {
namespace {

/// Seconds of each frame that something ran in.
struct PassTimes {
    std::vector<double> gl, timer, reference;
};

/// What one side's frames took, warm-up left out: of each pass, and of all of a frame.
struct Times {
    std::vector<PassTimes> passes;
    PassTimes frame;
    std::vector<double> check;
};

void time_gl(const System& system, GlSystemSide& gpu, int warm_up, int frames, Times& times) {
    gpu.upload(system.start.view());
    gpu.time_steps(true);
    for (int frame = 0; frame < warm_up + frames; ++frame) {
        double wall = 0.0, timer = 0.0;
        for (std::size_t p = 0; p < system.passes.size(); ++p) {
            if (!system.passes[p]->runs(frame))
                continue;
            gpu.step(p, frame);
            if (system.passes[p]->continues() || frame < warm_up)
                continue;
            times.passes[p].gl.push_back(gpu.seconds().wall);
            times.passes[p].timer.push_back(gpu.seconds().timer);
            wall += gpu.seconds().wall;
            timer += gpu.seconds().timer;
        }
        if (frame < warm_up)
            continue;
        times.frame.gl.push_back(wall);
        times.frame.timer.push_back(timer);
    }
    gpu.time_steps(false);
}

void time_reference(const System& system, const Profile& profile, int warm_up, int frames, Times& times) {
    ReferenceRun reference(system, profile);
    for (int frame = 0; frame < warm_up + frames; ++frame) {
        double all = 0.0;
        for (std::size_t p = 0; p < system.passes.size(); ++p) {
            if (!system.passes[p]->runs(frame))
                continue;
            double seconds = 0.0;
            {
                const Stopwatch watch(seconds);
                reference.step_pass(p, frame);
            }
            all += seconds;
            if (frame >= warm_up)
                times.passes[p].reference.push_back(seconds);
        }
        if (frame >= warm_up)
            times.frame.reference.push_back(all);
    }
}

CheckReport time_check(const System& system, GlSystemSide& gpu, const SystemBench& asked, int frames, Times& times) {
    CheckOptions options;
    options.frames = asked.warm_up + frames;
    options.repeated_frames = 0;
    options.known = known_operations(asked.legal, gpu.describe().profile);
    double seconds = 0.0;
    std::optional<Stopwatch> watch(std::in_place, seconds);
    options.on_frame = [&](int done) {
        watch.reset();
        if (done > asked.warm_up)
            times.check.push_back(seconds);
        seconds = 0.0;
        watch.emplace(seconds);
    };
    return check(system, gpu, options);
}

std::string milliseconds(const std::vector<double>& seconds) {
    return seconds.empty() ? "-" : fmt::format("{:.3f}", median(seconds) * 1e3);
}

std::string ratio(const std::vector<double>& a, const std::vector<double>& b) {
    return a.empty() || b.empty() ? "-" : fmt::format("{:.2f}x", median(a) / median(b));
}

void print_row(std::size_t count, std::string_view pass, const PassTimes& times, const std::string& rest) {
    fmt::print("{:>9} {:<18} {:>10} {:>10} {:>10} {:>8}{}\n", count, pass, milliseconds(times.gl),
               milliseconds(times.timer), milliseconds(times.reference), ratio(times.gl, times.reference), rest);
}

} // namespace

int bench_system(const RegisteredSystem& system, const RunOptions& run, const SystemBench& asked) {
    const Gl gl = open_gl(run);
    fmt::print("{}\n{} frames after {}, median ms; GL: the shaders alone, to glFinish\n\n{:>9} {:<18} {:>10} {:>10} "
               "{:>10} {:>8} {:>10} {:>9}  {:<16} {}\n",
               gl.name(), run.frames, asked.warm_up, "items", "pass", "GL", "GL timer", "reference", "GL/ref", "check",
               "check/GL", "hash", "verdict");
    int status = status_agree;
    for (const std::size_t count : asked.counts) {
        RunOptions one = run;
        one.particles = count;
        const ReadScene read = read_scene(system, one);
        const System& twins = read.scene.system;
        static_cast<void>(shaders_of(read.scene, one));
        GlSystemSide side = side_of(gl, read.scene, one);
        Times times;
        times.passes.resize(twins.passes.size());
        time_gl(twins, side, asked.warm_up, run.frames, times);
        time_reference(twins, side.describe().profile, asked.warm_up, run.frames, times);
        const CheckReport report = time_check(twins, side, asked, run.frames, times);
        for (std::size_t p = 0; p < twins.passes.size(); ++p)
            if (!times.passes[p].reference.empty())
                print_row(count, twins.passes[p]->name(), times.passes[p], "");
        print_row(count, "frame", times.frame,
                  fmt::format(" {:>10} {:>9}  {} {}", milliseconds(times.check), ratio(times.check, times.frame.gl),
                              hash_text(report.gpu_hash), verdict_words(report)));
        std::fflush(stdout);
        if (!passes(report, asked.rules))
            status = status_differ;
    }
    return status;
}

} // namespace lockstep
