#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/cli/system_verbs.hpp"
#include "crosscheck/collision/report/frame_images.hpp"
#include "crosscheck/collision/report/octree_overlay.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/files/png.hpp"
#include "crosscheck/report/overlay.hpp"
#include "crosscheck/report/progress.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "gpu/collision/simulation.hpp"
#include "gpu/context.hpp"
#include "reference/collision/render_pass.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

enum class Side { cpu, gpu };

struct RenderRequest {
    RunOptions run;
    int frame = 0;
    Side side = Side::cpu;
    std::filesystem::path output;
    std::string profile = "strict";
    bool octree = false;
};

/// What a side's run comes to.
struct Rendered {
    ColorImage picture;
    Particles particles;
};

Rendered render_cpu(const Scene& scene, const RenderRequest& options) {
    const Profile profile = named_profile(options.profile);
    ReferenceSimulation reference(scene, profile);
    Progress progress("render", options.frame + 1, true);
    for (int frame = 0; frame <= options.frame; ++frame) {
        reference.step(frame_params(scene, frame));
        progress.show(frame + 1);
    }
    return {render_pass(reference.particles(), scene.obstacles, frame_params(scene, options.frame), profile),
            reference.particles()};
}

Rendered render_gpu(const Scene& scene, const RenderRequest& options) {
    static_cast<void>(shaders_to_run(options.run, scene, true));
    const Context context(parse_context_request(options.run.gl));
    GpuSimulation gpu(scene, options.run.shaders);
    Progress progress("render", options.frame + 1, true);
    for (int frame = 0; frame <= options.frame; ++frame) {
        gpu.step(frame_params(scene, frame));
        progress.show(frame + 1);
    }
    Particles particles;
    gpu.read(particles);
    return {render_on_gpu(particles, scene, frame_params(scene, options.frame), options.run.shaders), particles};
}

/// Of names without a suffix nothing is expected.
void check_suffix(const std::filesystem::path& output) {
    std::string suffix = output.extension().string();
    std::ranges::transform(suffix, suffix.begin(), [](unsigned char c) { return std::tolower(c); });
    constexpr std::array<std::string_view, 13> others{".jpg", ".jpeg", ".bmp", ".gif",  ".tga", ".tif", ".tiff",
                                                      ".ppm", ".webp", ".exr", ".avif", ".svg", ".hdr"};
    if (std::ranges::find(others, suffix) != others.end())
        throw Error(fmt::format("--output {}: a picture is written as PNG; right is a name that ends in .png",
                                output.string()));
}

int run(const RenderRequest& options) {
    check_suffix(options.output);
    check_scene_exists(options.run.scene);
    const RegisteredSystem* system = system_of(options.run);
    if (system != nullptr && options.octree)
        throw Error("render: --octree goes with scenes of system collision");
    if (system != nullptr)
        return render_system(*system, options.run,
                             {options.frame, options.side == Side::gpu, options.profile, options.output});
    const Scene scene = load(options.run);
    OutputFiles files;
    protect_inputs(options.run, files);
    files.expect(options.output);
    Rendered rendered = options.side == Side::cpu ? render_cpu(scene, options) : render_gpu(scene, options);
    if (options.octree) {
        const FrameParams params = frame_params(scene, options.frame);
        draw_overlay(rendered.picture, params.render_projection * params.render_view,
                     octree_overlay(rendered.particles.position, params.constants.octree_size));
    }
    files.write(options.output, png(rendered.picture));
    files.commit();
    return status_agree;
}

} // namespace

Verb render_command() {
    auto options = std::make_shared<RenderRequest>();
    Verb verb{"render", "run one side to a frame and write its picture"};
    add_scene_options(verb, options->run);
    add_gl_options(verb, options->run);
    verb.add(integer_option("--frame", "F", {0, most_frames}, options->frame, "the frame to picture, counted from 0"));
    verb.add(required(path_option("-o,--output", "FILE", options->output, "PNG file to write")));
    verb.add(choice_option<Side>("--side", options->side, {{"cpu", Side::cpu}, {"gpu", Side::gpu}},
                                 "cpu: the reference, needs no GL; gpu: the shaders"));
    add_profile_option(verb, options->profile);
    verb.add(flag("--octree", options->octree,
                  "draw the octree's nodes that hold a particle, whichever search the scene makes; octree_size is the "
                  "side of its root"));
    verb.footer = "Example: lockstep render data/scenes/lattice.json --frame 120 -o lattice.png --side cpu";
    verb.run = [options](const Call& call) {
        const bool cpu = options->side == Side::cpu;
        for (const std::string_view name : {"--gl", "--shaders", "--profile"})
            if (call.has(name) && cpu != (name == "--profile"))
                throw Error(fmt::format("render: {} goes with --side {}", name, cpu ? "gpu" : "cpu"));
        return run(*options);
    };
    return verb;
}

} // namespace lockstep
