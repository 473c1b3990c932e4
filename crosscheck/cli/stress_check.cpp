#include "crosscheck/cli/stress_check.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/part_file.hpp"
#include "crosscheck/cli/rule_by_text.hpp"
#include "crosscheck/cli/stress_report.hpp"
#include "crosscheck/command/judging_options.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/run_inputs.hpp"
#include "crosscheck/files/signals.hpp"
#include "crosscheck/report/places.hpp"
#include "crosscheck/report/report.hpp"
#include "crosscheck/report/shader_notes.hpp"
#include "crosscheck/scene/fragment_stages.hpp"
#include "crosscheck/scene/profile_json.hpp"
#include "crosscheck/scene/profile_text.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "crosscheck/scene/run_text.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/collision/simulation.hpp"
#include "gpu/context.hpp"
#include "gpu/data_folder.hpp"
#include "gpu/stages_run.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

std::vector<std::filesystem::path> stress_scenes() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(shipped_scene("stress/crowd").parent_path()))
        if (entry.path().extension() == ".json")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// One scene, read with the shaders that it runs.
struct ReadStress {
    RunOptions run;
    Scene scene;
    ShaderUse shaders;
};

/// All scenes: each part of a run rests on what all of them read, and is joined with parts that read the same.
std::vector<ReadStress> read_scenes(const RunOptions& options) {
    std::vector<ReadStress> all;
    for (const std::filesystem::path& file : stress_scenes()) {
        RunOptions run = options;
        run.scene = file;
        Scene scene = load(run);
        ShaderUse shaders = shaders_to_run(run, scene);
        all.push_back({std::move(run), std::move(scene), std::move(shaders)});
    }
    return all;
}

StressScene run_scene(const StressOptions& options, const ReadStress& read, const Profile& measured,
                      const std::string& context) {
    const auto& [run, scene, shaders] = read;
    forget_shaders_run();
    compile_unrendered(scene, run.shaders);
    const Profile profile = with_written_codes(measured, scene, run.shaders);
    std::vector<ShaderWarning> warnings;
    const ShaderWarnings collected(warnings);
    GpuSimulation gpu(scene, run.shaders);
    CheckOptions check_options;
    check_options.frames = run.frames;
    RuleByText rule = rule_by_text(options.legal, scene, shaders, run.shaders, false);
    check_options.known = known_operations(rule.legal, profile);
    check_options.stop = &interrupted;
    CheckReport report = check(scene, profile, gpu, check_options);
    const PassRules rules{options.rules.allow_undefined, options.rules.require_hits};
    ask_hits(report, rules);
    note_unset_variables(report, warnings);
    RunDescription about;
    about.scene = fmt::format("{} ({})", scene.name, plain_line(run.scene.string()));
    about.context = context;
    about.profile = describe(profile);
    about.settings = settings_text(run, scene);
    about.mode = "resync";
    about.notes = conversion_notes(profile, scene.switches);
    std::ranges::move(rule.notes, std::back_inserter(about.notes));
    note_what_ran(about.shaders.emplace(shaders));
    for (std::string& note : warning_notes(warnings))
        about.notes.push_back(std::move(note));
    about.timed = false;
    const int frames = report.first_frame ? *report.first_frame + 1 : report.frames;
    about.repeat = command_line("check", run, frames) + legal_option_text(rule.legal) + pass_options_text(rules);
    if (report.verdicts && report.verdicts->first)
        about.explain = command_line("explain", run,
                                     place_arguments(report.verdicts->first->place, collision_schema(), scene.width)) +
                        legal_option_text(rule.legal);
    const bool pass = passes(report, rules);
    return {0,
            run.scene.stem().string(),
            report.particles,
            report.power,
            verdict_words(report),
            pass,
            pass ? std::string() : report_text(report, about),
            report_json(report, about)};
}

} // namespace

int check_stress(const StressOptions& options) {
    const std::vector<ReadStress> scenes = read_scenes(options.run);
    OutputFiles files;
    files.protect(options.run.shaders);
    if (!options.json.empty())
        files.expect(options.json);
    if (options.shard.part > scenes.size())
        throw Error(fmt::format("{}: {} scenes make {} parts at most, and none may be empty", options.shard.asked,
                                scenes.size(), scenes.size()));
    const Context context(parse_context_request(options.run.gl));
    const Profile profile = measured_profile(context, options.run.shaders);
    const std::string renderer = summary(context.describe());
    const auto say = [&](const std::string& text) {
        if (!options.quiet)
            fmt::print("{}", text);
        std::fflush(stdout);
    };
    StressReport report;
    report.of = scenes.size();
    report.asked = fmt::format("{}{}{} on {}", command_line("check", options.run, options.run.frames),
                               legal_option_text(options.legal), pass_options_text(options.rules), renderer);
    report.profile = profile_json(profile).dump();
    report.inputs = input_digests();
    report.power_at_least = options.rules.power_at_least;
    report.part_by = options.shard.asked;
    {
        const InterruptHandler handler;
        bool failed = false;
        for (std::size_t index = 0; index < scenes.size(); ++index) {
            if (!options.shard.has(index))
                continue;
            StressScene& scene = report.scenes.emplace_back(run_scene(options, scenes[index], profile, renderer));
            scene.index = index;
            if (report.scenes.size() == 1)
                say(stress_head());
            say(stress_line(scene, !scene.passes && !failed && !interrupted));
            if (interrupted)
                return status_interrupted;
            failed = failed || !scene.passes;
        }
    }
    say(stress_end(report, options.power));
    if (!options.json.empty()) {
        const nlohmann::json json = stress_json(report);
        files.write(options.json,
                    options.shard.is_asked() ? part_file_text(json, stress_part_file_json(report)) : json_text(json));
    }
    files.commit();
    return report.passes() ? status_agree : status_differ;
}

} // namespace lockstep
