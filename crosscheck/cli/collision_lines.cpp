#include "crosscheck/cli/collision_lines.hpp"

#include <functional>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/collision/judge/frame_run.hpp"
#include "crosscheck/collision/report/frame_images.hpp"
#include "crosscheck/report/places.hpp"
#include "crosscheck/text/stage_lines.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// Stages that the user's folder has otherwise than they are shipped.
std::vector<StagePair> own_stages(const Scene& scene, const std::filesystem::path& shaders, bool rendered) {
    std::vector<StagePair> pairs;
    for (const PassStages& pass : collision_stages(scene, rendered)) {
        const StageInput& input = pass.inputs.front();
        const auto load = [&](const std::filesystem::path& user) {
            return load_stages(collision_shaders(user), pass.name, pass.stages, input.defines, input.texts);
        };
        std::vector<ShaderSource> own = load(shaders), shipped = load({});
        for (ShaderSource& one : own)
            for (ShaderSource& reference : shipped)
                if (reference.stage == one.stage && reference.text != one.text)
                    pairs.push_back({std::make_shared<const ShaderSource>(std::move(one)),
                                     std::make_shared<const ShaderSource>(std::move(reference))});
    }
    return pairs;
}

} // namespace

std::vector<std::string> lines_without_counterpart(const Scene& scene, const std::filesystem::path& shaders,
                                                   const Profile& profile, const KnownOperations& known,
                                                   const CheckReport& report, bool rendered) {
    if (report.verdict != Verdict::divergent || shaders.empty())
        return {};
    const bool in_picture = report.state_verdict.has_value();
    const std::vector<WitnessLine> lines =
        lines_of_stages(own_stages(scene, shaders, rendered), [&](bool shipped, const std::function<void()>& look) {
            const std::filesystem::path folder = shipped ? std::filesystem::path() : shaders;
            FrameRun run(scene, profile, known, folder);
            if (in_picture) {
                run.go_to(report.first + report.frames - 1);
                look();
                judge_rendered(run.judged().gpu, nullptr, scene, run.frame(), profile, known, folder);
                return;
            }
            const int frame = frames_to_repeat(report) - 1;
            if (frame > 0)
                run.go_to(frame - 1);
            look();
            run.go_to(frame);
        });
    std::vector<std::string> notes;
    for (const WitnessLine& line : lines)
        notes.push_back("without a counterpart in the reference: " + line_of(line));
    return notes;
}

} // namespace lockstep
