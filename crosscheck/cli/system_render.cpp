#include <fmt/format.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/system_run.hpp"
#include "crosscheck/cli/system_verbs.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/files/png.hpp"
#include "crosscheck/judge/system_run.hpp"
#include "crosscheck/report/progress.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

ColorImage render_cpu(const SystemScene& scene, const SystemRender& asked) {
    const Profile profile = named_profile(asked.profile);
    ReferenceRun reference(scene.system, profile);
    Progress progress("render", asked.frame + 1, true);
    for (int frame = 0; frame <= asked.frame; ++frame) {
        reference.step(frame);
        progress.show(frame + 1);
    }
    return reference_picture(scene, reference.state(), asked.frame, profile);
}

ColorImage render_gpu(const SystemScene& scene, const RunOptions& run, const SystemRender& asked) {
    static_cast<void>(shaders_of(scene, run));
    const Gl gl = open_gl(run);
    GlSystemSide side = side_of(gl, scene, run);
    SystemState state = scene.system.start;
    side.upload(state.view());
    Progress progress("render", asked.frame + 1, true);
    for (int frame = 0; frame <= asked.frame; ++frame) {
        for (std::size_t p = 0; p < scene.system.passes.size(); ++p)
            side.step(p, frame);
        progress.show(frame + 1);
    }
    side.read(state);
    return gpu_picture(gl, scene, state, asked.frame, run);
}

} // namespace

int render_system(const RegisteredSystem& system, const RunOptions& given, const SystemRender& asked) {
    const RunOptions run = with_folders(system, given);
    const ReadScene read = read_scene(system, run);
    if (!read.scene.has_pictures())
        throw Error(fmt::format("render: scenes of system {} have no pictures", system.name));
    OutputFiles files;
    read.protect(run, files);
    files.expect(asked.output);
    files.write(asked.output, png(asked.gpu ? render_gpu(read.scene, run, asked) : render_cpu(read.scene, asked)));
    files.commit();
    return status_agree;
}

} // namespace lockstep
