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
#include "reference/model/error.hpp"
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

/// Of each pass of the floor.
std::vector<PassTimes> time_floor(const System& system, GlSystem& gpu, std::size_t passes, int warm_up, int frames) {
    std::vector<PassTimes> times(passes);
    gpu.upload(system.start.view());
    gpu.time_steps(true);
    for (int frame = 0; frame < warm_up + frames; ++frame)
        for (std::size_t p = 0; p < passes; ++p) {
            gpu.step(p, frame);
            if (frame < warm_up)
                continue;
            times[p].gl.push_back(gpu.seconds().wall);
            times[p].timer.push_back(gpu.seconds().timer);
        }
    return times;
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

Floor floor_of(const SystemScene& scene) {
    Floor floor = scene.floor ? scene.floor() : Floor{};
    if (floor.passes.empty())
        throw Error(fmt::format("bench: --floor: system {} has none with these switches", scene.system.schema.system));
    return floor;
}

void print_floor(const SystemScene& scene, const Floor& floor, const RunOptions& run, std::size_t count, int warm_up) {
    GlSystem gpu(scene.system.schema, floor.passes, run.shaders, scene.arithmetic);
    const std::vector<PassTimes> times = time_floor(scene.system, gpu, floor.passes.size(), warm_up, run.frames);
    fmt::print("{:>9} floor: {}\n", count, floor.meaning);
    for (std::size_t p = 0; p < times.size(); ++p)
        print_row(count, floor.passes[p].name, times[p], "");
}

} // namespace

int bench_system(const RegisteredSystem& system, const RunOptions& run, const SystemBench& asked) {
    if (asked.floor) { // says that there is none before the table begins
        RunOptions first = run;
        first.particles = asked.counts.front();
        static_cast<void>(floor_of(read_scene(system, first).scene));
    }
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
        const Floor floor = asked.floor ? floor_of(read.scene) : Floor{};
        GlSystemSide side = side_of(gl, read.scene, one);
        Times times;
        times.passes.resize(twins.passes.size());
        time_gl(twins, side, asked.warm_up, run.frames, times);
        CheckReport report;
        if (!asked.gl_only) {
            time_reference(twins, side.describe().profile, asked.warm_up, run.frames, times);
            report = time_check(twins, side, asked, run.frames, times);
        }
        for (std::size_t p = 0; p < twins.passes.size(); ++p)
            if (!times.passes[p].gl.empty() || !times.passes[p].reference.empty())
                print_row(count, twins.passes[p]->name(), times.passes[p], "");
        const std::string checked = asked.gl_only ? std::string()
                                                  : fmt::format(" {:>10} {:>9}  {} {}", milliseconds(times.check),
                                                                ratio(times.check, times.frame.gl),
                                                                hash_text(report.gpu_hash), verdict_words(report));
        print_row(count, "frame", times.frame, checked);
        if (asked.floor)
            print_floor(read.scene, floor, one, count, asked.warm_up);
        std::fflush(stdout);
        if (!asked.gl_only && !passes(report, asked.rules))
            status = status_differ;
    }
    return status;
}

} // namespace lockstep
