#include <algorithm>
#include <cstdio>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/system_run.hpp"
#include "crosscheck/cli/system_verbs.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/judge/stopwatch.hpp"
#include "crosscheck/judge/system_check.hpp"
#include "crosscheck/judge/system_run.hpp"
#include "crosscheck/report/report.hpp"
#include "crosscheck/report/statistics.hpp"
#include "gpu/copy_time.hpp"
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

/// The picture of the last frame's state, drawn as often as frames are timed.
PassTimes time_drawing(const Gl& gl, const SystemScene& scene, const GlSystemSide& side, const RunOptions& run,
                       int warm_up) {
    SystemState state = scene.system.start;
    side.read(state);
    const SystemPicture picture = scene.picture(state, warm_up + run.frames - 1);
    PassTimes times;
    if (picture.how.indices.empty())
        return times;
    GlSystemSide drawn = side_of(gl, picture, scene, run);
    drawn.upload(picture.system.start.view());
    drawn.time_steps(true);
    for (int k = 0; k < 1 + run.frames; ++k) {
        static_cast<void>(drawn.picture(0, 0, picture.how));
        if (k == 0)
            continue;
        times.gl.push_back(drawn.seconds().wall);
        times.timer.push_back(drawn.seconds().timer);
    }
    return times;
}

/// A row a buffer: all of it, copied.
void print_copies(const SystemState& state, std::size_t count, int frames) {
    constexpr std::size_t least_bytes = 1U << 16U;
    for (std::uint8_t r = 0; r < state.schema().resources.size(); ++r) {
        const Resource& resource = state.schema().resources[r];
        const std::size_t bytes = item_bytes(resource) * state.extent(r).count();
        if (resource.dimensions > 1 || bytes < least_bytes)
            continue;
        PassTimes times;
        for (int k = 0; k < frames; ++k)
            times.timer.push_back(copy_seconds(bytes));
        print_row(count, "copy_of_" + resource.name, times, fmt::format(" {} bytes", bytes));
    }
}

void print_floor(const SystemScene& scene, const RunOptions& run, std::size_t count, int warm_up) {
    const Floor floor = scene.floor ? scene.floor() : Floor{};
    if (!floor.passes.empty()) {
        GlSystem gpu(scene.system.schema, floor.passes, run.shaders, scene.arithmetic);
        const std::vector<PassTimes> times = time_floor(scene.system, gpu, floor.passes.size(), warm_up, run.frames);
        fmt::print("{:>9} floor: {}\n", count, floor.meaning);
        for (std::size_t p = 0; p < times.size(); ++p)
            print_row(count, floor.passes[p].name, times[p], "");
    }
    print_copies(scene.system.start, count, run.frames);
}

} // namespace

int bench_system(const RegisteredSystem& system, const RunOptions& given, const SystemBench& asked) {
    const RunOptions run = with_folders(system, given);
    const Gl gl = open_gl(run);
    fmt::print("{}\n{} after {}, median ms; GL: the shaders alone, to glFinish\n\n{:>9} {:<18} {:>10} {:>10} "
               "{:>10} {:>8} {:>10} {:>9}  {:<16} {}\n",
               gl.name(), counted(static_cast<std::size_t>(run.frames), "frame"), asked.warm_up, "items", "pass", "GL",
               "GL timer", "reference", "GL/ref", "check", "check/GL", "hash", "verdict");
    int status = status_agree;
    // A check file has its counts in its state.
    std::vector<std::optional<std::size_t>> counts(asked.counts.begin(), asked.counts.end());
    if (system.folders != nullptr)
        counts = {std::nullopt};
    for (const std::optional<std::size_t>& given_count : counts) {
        RunOptions one = run;
        one.particles = given_count;
        ReadScene read = read_scene(system, one);
        const std::size_t count = given_count.value_or(read.scene.system.start.extent(0).count());
        if (!one.reference.empty())
            static_cast<void>(take_references({read.scene.system, read.scene.passes, read.scene.arithmetic},
                                              references_of(read.scene, one), one.reference, one.shaders));
        const System& twins = read.scene.system;
        static_cast<void>(shaders_of(read.scene, one));
        GlSystemSide side = side_of(gl, read.scene, one);
        Times times;
        times.passes.resize(twins.passes.size());
        time_gl(twins, side, asked.warm_up, run.frames, times);
        CheckReport report;
        if (!asked.gl_only) {
            time_reference(twins, side.describe().profile, asked.warm_up, run.frames, times);
            report = time_check(twins, side, asked, run.frames, times);
            ask_power(report, asked.rules.power_at_least);
        }
        for (std::size_t p = 0; p < twins.passes.size(); ++p)
            if (!times.passes[p].gl.empty() || !times.passes[p].reference.empty())
                print_row(count, twins.passes[p]->name(), times.passes[p], "");
        const std::string checked = asked.gl_only ? std::string()
                                                  : fmt::format(" {:>10} {:>9}  {} {}", milliseconds(times.check),
                                                                ratio(times.check, times.frame.gl),
                                                                hash_text(report.gpu_hash), verdict_words(report));
        print_row(count, "frame", times.frame, checked);
        if (read.scene.picture) {
            const PassTimes drawing = time_drawing(gl, read.scene, side, one, asked.warm_up);
            if (!drawing.gl.empty())
                print_row(count, "drawing", drawing, "");
        }
        if (asked.floor)
            print_floor(read.scene, one, count, asked.warm_up);
        std::fflush(stdout);
        if (!asked.gl_only && !passes(report, asked.rules))
            status = status_differ;
    }
    return status;
}

} // namespace lockstep
