#include "crosscheck/cli/stress_check.hpp"

#include <algorithm>
#include <cstdio>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/signals.hpp"
#include "crosscheck/report/places.hpp"
#include "crosscheck/report/power_text.hpp"
#include "crosscheck/report/report.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "crosscheck/scene/run_text.hpp"
#include "gpu/collision/simulation.hpp"
#include "gpu/context.hpp"
#include "gpu/data_folder.hpp"
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

/// A scene's run.
struct Ran {
    CheckReport report;
    RunDescription run;
};

Ran run_scene(const StressOptions& options, const RunOptions& run, const Profile& profile, const std::string& context) {
    const Scene scene = load(run);
    const ShaderUse shaders = shaders_to_run(run, scene);
    GpuSimulation gpu(scene, run.shaders);
    CheckOptions check_options;
    check_options.frames = run.frames;
    check_options.known = known_operations(options.legal, profile);
    check_options.stop = &interrupted;
    CheckReport report = check(scene, profile, gpu, check_options);
    RunDescription about;
    about.scene = fmt::format("{} ({})", scene.name, plain_line(run.scene.string()));
    about.context = context;
    about.profile = describe(profile);
    about.settings = settings_text(run, scene);
    about.mode = "resync";
    about.notes = conversion_notes(profile, scene.switches);
    about.shaders = shaders;
    const int frames = report.first_frame ? *report.first_frame + 1 : report.frames;
    about.repeat = command_line("check", run, frames) + legal_option_text(options.legal) +
                   pass_options_text({options.rules.allow_undefined, options.rules.require_hits});
    if (report.verdicts && report.verdicts->first)
        about.explain = command_line("explain", run,
                                     place_arguments(report.verdicts->first->place, collision_schema(), scene.width)) +
                        legal_option_text(options.legal);
    return {std::move(report), std::move(about)};
}

/// A mistake shows where it shows in one of the runs; of the others the first says why not.
PowerSummary together(std::span<const Ran> runs) {
    PowerSummary all;
    for (const Ran& ran : runs)
        for (const PowerSummary::Mistake& mistake : ran.report.power.mistakes) {
            const auto known = std::find_if(all.mistakes.begin(), all.mistakes.end(),
                                            [&](const auto& m) { return m.name == mistake.name; });
            if (known == all.mistakes.end())
                all.mistakes.push_back(mistake);
            else if (mistake.first_frame && (!known->first_frame || *mistake.first_frame < *known->first_frame))
                *known = mistake;
        }
    for (const Ran& ran : runs)
        for (const PowerSummary::Situation& situation : ran.report.power.situations) {
            const auto known = std::find_if(all.situations.begin(), all.situations.end(),
                                            [&](const auto& s) { return s.name == situation.name; });
            if (known == all.situations.end())
                all.situations.push_back(situation);
            else
                known->count += situation.count;
        }
    return all;
}

} // namespace

int check_stress(const StressOptions& options) {
    OutputFiles files;
    files.protect(options.run.shaders);
    if (!options.json.empty())
        files.expect(options.json);
    const std::vector<std::filesystem::path> scenes = stress_scenes();
    const Context context(parse_context_request(options.run.gl));
    const Profile profile = measured_profile(context, options.run.shaders);
    const std::string renderer = summary(context.describe());
    const PassRules each{options.rules.allow_undefined, options.rules.require_hits};
    const auto say = [&](const std::string& text) {
        if (!options.quiet)
            fmt::print("{}", text);
        std::fflush(stdout);
    };
    std::vector<Ran> runs;
    std::size_t failed = 0;
    {
        const InterruptHandler handler;
        say(fmt::format("{:<16} {:>9}  {:<18} {}\n", "scene", "particles", "would have shown", "verdict"));
        for (const std::filesystem::path& file : scenes) {
            RunOptions run = options.run;
            run.scene = file;
            const Ran& ran = runs.emplace_back(run_scene(options, run, profile, renderer));
            const PowerSummary& power = ran.report.power;
            say(fmt::format("{:<16} {:>9}  {:<18} {}\n", file.stem().string(), ran.report.particles,
                            fmt::format("{} of {}", power.seen(), power.mistakes.size()), verdict_words(ran.report)));
            if (ran.report.partial())
                return status_interrupted;
            if (!passes(ran.report, each) && failed++ == 0)
                say("\n" + plain_text(report_text(ran.report, ran.run)) + "\n");
        }
    }
    const PowerSummary power = together(runs);
    const bool enough = power.share() >= options.rules.power_at_least;
    say(fmt::format("\ntogether  {}\n", power_line(power)));
    if (!enough)
        say(fmt::format("          {:.1f} %; asked for are {:.4g} %\n", 100.0 * power.share(),
                        100.0 * options.rules.power_at_least));
    say(failed == 0 ? fmt::format("verdict   all {} scenes pass\n", runs.size())
                    : fmt::format("verdict   {} of {} scenes do not pass\n", failed, runs.size()));
    if (options.power)
        say(power_text(power));
    if (!options.json.empty()) {
        nlohmann::json report{{"scenes", nlohmann::json::array()}, {"power", power_json(power)}};
        for (const Ran& ran : runs)
            report["scenes"].push_back(report_json(ran.report, ran.run));
        files.write(options.json, json_text(report));
    }
    files.commit();
    return failed == 0 && enough ? status_agree : status_differ;
}

} // namespace lockstep
