#include "crosscheck/cli/system_run.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/threads.hpp"
#include "crosscheck/judge/system_check.hpp"
#include "crosscheck/report/overlay.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

ReadScene read_scene(const RegisteredSystem& system, const RunOptions& run) {
    start_threads(run.threads);
    const nlohmann::json& document = run.document.of(run.scene);
    const std::string file = run.scene.string(), name = plain_line(run.scene.stem().string());
    SystemScene scene = system.load(JsonValue(document, file), name, {run.particles, run.preset, run.set});
    return {file, document, std::move(scene)};
}

ShaderUse shaders_of(const SystemScene& scene, const RunOptions& run) {
    std::vector<PassStages> stages;
    for (const GlPass& pass : scene.passes)
        if (!pass.continues && std::none_of(stages.begin(), stages.end(),
                                            [&](const PassStages& known) { return known.name == pass.name; }))
            stages.push_back(
                {pass.name, pass.draw ? std::vector{pass.stage, Stage::fragment} : std::vector{pass.stage}});
    if (scene.picture)
        for (const GlPass& pass : scene.picture(scene.system.start, 0).passes)
            stages.push_back({pass.name, {pass.stage, Stage::fragment}});
    ShaderUse use = shader_use(scene.system.schema.system, stages, run.shaders);
    check_shader_use(use, run.shaders, run.allow_unused);
    return use;
}

Gl open_gl(const RunOptions& run) {
    Gl gl(run.gl);
    if (!gl)
        throw Error(gl.missing());
    return gl;
}

GlSystemSide side_of(const Gl& gl, const SystemPicture& picture, const SystemScene& scene, const RunOptions& run) {
    return {gl, picture.system, picture.passes, run.shaders.string(), scene.arithmetic};
}

GlSystemSide side_of(const Gl& gl, const SystemScene& scene, const RunOptions& run) {
    return {gl, scene.system, scene.passes, run.shaders.string(), scene.arithmetic};
}

ColorImage reference_picture(const SystemScene& scene, const SystemState& state, int frame, const Profile& profile) {
    const SystemPicture picture = scene.picture(state, frame);
    ReferenceRun drawn(picture.system, profile);
    drawn.step(0);
    ColorImage image = picture.image(drawn.state().view());
    draw_overlay(image, picture.to_clip, picture.overlay);
    return image;
}

ColorImage gpu_picture(const Gl& gl, const SystemScene& scene, const SystemState& state, int frame,
                       const RunOptions& run) {
    const SystemPicture picture = scene.picture(state, frame);
    GlSystemSide drawn = side_of(gl, picture, scene, run);
    drawn.upload(picture.system.start.view());
    ColorImage image = drawn.picture(0, 0, picture.how);
    draw_overlay(image, picture.to_clip, picture.overlay);
    return image;
}

} // namespace lockstep
