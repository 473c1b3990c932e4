#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/cli/system_verbs.hpp"
#include "crosscheck/collision/record/trace_writer.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/judge/compare.hpp"
#include "crosscheck/report/progress.hpp"
#include "crosscheck/report/verdict_text.hpp"
#include "crosscheck/scene/fragment_stages.hpp"
#include "crosscheck/scene/kept_probe.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "gpu/collision/simulation.hpp"
#include "gpu/context.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

struct RecordRequest {
    RunOptions run;
    std::filesystem::path output;
    bool cdt = false;
    int deflate = 1;
};

constexpr int repeated_frames = 2;

/// As `check` does with its first frames: every buffer really written, and the same bits from the same state.
void prove(GpuSimulation& gpu, const FrameParams& params, const Particles& particles, const CollisionImage& cdt,
           int frame) {
    gpu.find_canary(particles, cdt, frame);
    gpu.repeat_step(params);
    CollisionImage again;
    gpu.read(again);
    if (!gpu.holds(particles) || !compare(cdt, again).agree())
        throw Error(fmt::format("the GPU gave two answers to frame {}, so nothing was recorded; lockstep check "
                                "reports where they differ",
                                frame));
}

TraceInfo info_of(const RecordRequest& options, Scene scene, const Context& context, const ShaderUse& shaders) {
    const ProbeResult probed = kept_probe(context);
    TraceInfo info;
    info.profile = with_written_codes(measured_profile(probed, options.run.shaders), scene, options.run.shaders);
    info.renderer = summary(context.describe());
    info.settings = settings_text(options.run, scene);
    info.shaders = shaders_text(shaders);
    nlohmann::json measured = probed;
    measured.erase("seconds"); // that it took: the same run is the same file
    info.probe = measured.dump(1);
    info.has_cdt = options.cdt;
    info.scene = std::move(scene);
    return info;
}

int run(const RecordRequest& options) {
    Scene scene = load(options.run);
    const ShaderUse shaders = shaders_to_run(options.run, scene);
    OutputFiles files;
    protect_inputs(options.run, files);
    files.expect(options.output);
    const Context context(parse_context_request(options.run.gl));
    GpuSimulation gpu(scene, options.run.shaders);
    const TraceInfo info = info_of(options, std::move(scene), context, shaders);
    TraceWriter writer(options.output, info, options.deflate);
    Particles particles = info.scene.start;
    CollisionImage cdt = empty_cdt(info.scene);
    Progress progress("record", options.run.frames, true);
    for (int frame = 0; frame < options.run.frames; ++frame) {
        const FrameParams params = frame_params(info.scene, frame);
        const bool proved = frame < repeated_frames;
        if (proved)
            gpu.lay_canary();
        gpu.step(params);
        gpu.read(particles);
        if (proved || options.cdt)
            gpu.read(cdt);
        if (proved)
            prove(gpu, params, particles, cdt, frame);
        writer.add(particles, options.cdt ? &cdt : nullptr);
        progress.show(frame + 1);
    }
    writer.commit();
    fmt::print("{}: {} particles, {} frames{}, {} bytes; {}\n", plain_line(options.output.string()),
               grouped(info.scene.start.size()), options.run.frames, options.cdt ? " with the CDT" : "",
               grouped(std::filesystem::file_size(options.output)), plain_line(info.renderer));
    return status_agree;
}

} // namespace

Verb record_command() {
    auto options = std::make_shared<RecordRequest>();
    Verb verb{"record", "write the GPU's states of a run to a file that is checked elsewhere"};
    add_scene_options(verb, options->run);
    add_gl_options(verb, options->run);
    verb.add(required(path_option("-o,--output", "FILE", options->output, "the trace, H5MD")));
    verb.add(integer_option("--frames", "N", {1, most_frames}, options->run.frames, "frames to record"));
    verb.add(flag("--cdt", options->cdt, "with the CDT of every frame"));
    verb.add(integer_option("--deflate", "LEVEL", {0, 9}, options->deflate, "how hard to compress, 0 to 9"));
    verb.footer = "Example: lockstep record data/scenes/lattice.json --gl egl-device:0 -o run.h5\n"
                  "then, on another machine: lockstep check --trace run.h5";
    verb.run = [options](const Call& call) {
        if (const RegisteredSystem* system = system_of(options->run)) {
            if (call.has("--cdt"))
                throw Error(fmt::format("record: --cdt goes with scenes of system {}", default_system));
            return record_system(*system, options->run, options->output, options->deflate);
        }
        return run(*options);
    };
    return verb;
}

} // namespace lockstep
