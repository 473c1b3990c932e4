#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/cli/check_request.hpp"
#include "crosscheck/cli/collision_lines.hpp"
#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/part_file.hpp"
#include "crosscheck/cli/rule_by_text.hpp"
#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/cli/stress_check.hpp"
#include "crosscheck/cli/system_verbs.hpp"
#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/collision/judge/side_state.hpp"
#include "crosscheck/collision/page/explained.hpp"
#include "crosscheck/collision/page/report_page.hpp"
#include "crosscheck/collision/record/capsule_json.hpp"
#include "crosscheck/collision/record/trace_side.hpp"
#include "crosscheck/collision/report/frame_images.hpp"
#include "crosscheck/collision/report/hash_file.hpp"
#include "crosscheck/command/judging_options.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/run_inputs.hpp"
#include "crosscheck/files/shell_words.hpp"
#include "crosscheck/files/signals.hpp"
#include "crosscheck/files/threads.hpp"
#include "crosscheck/report/junit.hpp"
#include "crosscheck/report/page/study_results.hpp"
#include "crosscheck/report/page/template.hpp"
#include "crosscheck/report/places.hpp"
#include "crosscheck/report/power_text.hpp"
#include "crosscheck/report/progress.hpp"
#include "crosscheck/report/report.hpp"
#include "crosscheck/report/shader_notes.hpp"
#include "crosscheck/scene/fragment_stages.hpp"
#include "crosscheck/scene/profile_text.hpp"
#include "crosscheck/scene/run_text.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "gpu/collision/simulation.hpp"
#include "gpu/context.hpp"
#include "gpu/stages_run.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr std::array<std::string_view, 2> report_files{"report.html", "capsule.json"};

void expect_files(const CheckRequest& options, OutputFiles& files) {
    protect_inputs(options.run, files);
    files.protect(options.trace);
    if (!options.images.empty())
        files.expect_folder(options.images, FrameImages::names);
    if (!options.report.empty()) {
        files.protect(options.report / study_results_name);
        files.expect_folder(options.report, report_files);
    }
    for (const std::filesystem::path& file : {options.json, options.junit})
        if (!file.empty())
            files.expect(file);
    if (!options.hashes.empty())
        files.expect(options.hashes);
}

std::vector<PageCommand> page_commands(const CheckRequest& options, const RunDescription& run,
                                       const CheckReport& report) {
    std::vector<PageCommand> commands{{"This run", repeat_line(options, {0, report.frames})}};
    if (frames_to_repeat(report) < report.frames)
        commands.push_back({"Up to the first frame that differs", run.repeat});
    if (!run.explain.empty()) {
        commands.push_back({"The first divergence, step by step", run.explain});
        if (options.trace.empty())
            commands.push_back({"The same, walked through by commands", command_line("debug", options.run, "")});
    }
    return commands;
}

/// What is checked: a scene on this machine's GL, or a recorded run.
struct Checked {
    const Scene& scene;
    const Profile& profile;
    GpuSide& gpu;
    KnownOperations known;
    CheckedRun run;
    RunPart* part = nullptr;                              ///< to be filled in; null: the whole run is checked
    const std::vector<ShaderWarning>* warnings = nullptr; ///< so far; null: no shaders run here
};

/// The first divergent particle's step, for a file.
struct FirstCapsule {
    std::string file;    ///< empty where there is none
    std::string missing; ///< why it could not be made; empty: it could, or nothing is divergent
};

FirstCapsule first_capsule(const Checked& checked, FrameRun& frames, const std::vector<PageItem>& items) {
    const auto first = std::find_if(items.begin(), items.end(), [](const PageItem& item) {
        return !item.texel && item.kind == static_cast<std::uint8_t>(DifferenceClass::divergent);
    });
    if (first == items.end())
        return {};
    frames.go_to(first->frame);
    try {
        return {capsule_file(cut_capsule(frames.judged(), {checked.scene, checked.run.context, checked.run.settings,
                                                           first->frame, first->index, frames.capture(first->index)})),
                ""};
    } catch (const Error& error) {
        return {"", fmt::format("no capsule of the first divergent particle: {}", error.what())};
    }
}

/// Of part of the frames all that is told is told of these alone. Throws Error where that cannot be.
void expect_part(const CheckRequest& options) {
    const std::string by =
        options.frames.is_part ? fmt::format("--frames {}", options.frames.text()) : options.shard.asked;
    if (options.mode == CheckMode::free)
        throw Error(fmt::format("{}: with --mode free a frame follows from all before it; right is --mode resync", by));
    if (options.frames.is_part && options.shard.is_asked())
        throw Error(fmt::format("{}: does not go with {}, which chooses the frames already", options.shard.asked, by));
    if (!options.report.empty() || !options.images.empty())
        throw Error(fmt::format("{}: {} shows a whole run, not part of its frames", by,
                                options.report.empty() ? "--images" : "--report"));
}

/// What is asked of a run as a whole, none of its parts has to have.
PassRules rules_of_part(PassRules rules) {
    rules.require_hits = false;
    rules.power_at_least = 0.0;
    return rules;
}

/// "frames 4 to 7 of 12, by TEST_SHARD_INDEX=1 of TEST_TOTAL_SHARDS=3".
std::string part_text(const CheckRequest& options, int whole) {
    return fmt::format("frames {} to {} of {}{}{}", options.frames.first, options.frames.end - 1, whole,
                       options.shard.is_asked() ? ", by " : "", options.shard.asked);
}

std::vector<std::string> part_notes(const CheckRequest& options, int whole) {
    std::vector<std::string> notes{
        fmt::format("part of a run: {}; lockstep merge joins the parts' JSON", part_text(options, whole))};
    if (const PassRules& rules = options.rules; rules.require_hits || rules.power_at_least > 0.0)
        notes.push_back(fmt::format("lockstep merge judges{}, which the run as a whole has to pass",
                                    pass_options_text({false, rules.require_hits, rules.power_at_least})));
    return notes;
}

/// What a second run of the GPU, or of what was recorded of it, tells of the items that the page lists.
struct SecondLook {
    std::vector<ExplainedItem> items;
    FirstCapsule capsule;
};

SecondLook look_again(const CheckRequest& options, const Checked& checked, const std::vector<PageItem>& items) {
    std::optional<FrameRun> frames;
    const Scene& scene = checked.scene;
    if (scene.switches.search == Search::cdt && !has_remedies(scene.switches) && !items.empty()) {
        if (options.trace.empty())
            frames.emplace(scene, checked.profile, checked.known, options.run.shaders);
        else
            frames.emplace(scene, checked.profile, checked.known, checked.gpu);
    }
    SecondLook look;
    if (frames)
        look.capsule = first_capsule(checked, *frames, items);
    const auto explanation = [&](const PageItem& item) {
        try {
            return frames ? explained(*frames, item) : nlohmann::json();
        } catch (const Error&) { // what the capsule is told to miss; the verdicts stand
            return nlohmann::json();
        }
    };
    for (const PageItem& item : items)
        look.items.push_back(
            {item,
             explain_line(options,
                          place_arguments({item.frame, item.texel ? collision::cdt : collision::particles, item.index},
                                          collision_schema(), scene.width)),
             explanation(item)});
    return look;
}

bool is_rendered(const CheckRequest& options) { return !options.no_render; }

/// Judges the last frame's picture. `earlier`: the particles of the frame before; none where they were not kept.
void judge_last(const CheckRequest& options, const Checked& checked, const Particles& earlier, CheckReport& report) {
    Particles last;
    read_side(checked.gpu, checked.scene, last);
    const bool has_earlier = earlier.size() == last.size() && !report.partial();
    add_rendered(report, judge_rendered(last, has_earlier ? &earlier : nullptr, checked.scene, options.frames.end - 1,
                                        checked.profile, checked.known, options.run.shaders));
    if (options.render && report.rendered->of_particles == 0)
        report.untried.emplace_back("the rendered frame shows no particle");
}

int check_and_tell(const CheckRequest& options, OutputFiles& files, const Checked& checked) {
    const std::string page = options.report.empty() ? std::string() : report_page_template();
    const nlohmann::json study = options.report.empty() ? nlohmann::json() : study_results(options.report);
    HashFile hashes;
    FrameImages images;
    FrameCheckOptions check_options;
    check_options.mode = options.mode;
    check_options.first = options.frames.first;
    check_options.frames = options.frames.end;
    check_options.stop = &interrupted;
    check_options.known = checked.known;
    std::optional<PageCollector> collector;
    if (!options.report.empty())
        collector.emplace(checked.scene, checked.profile, options.mode, options.frames.end);
    Particles earlier;
    const bool render = checked.run.shaders && is_rendered(options);
    if (render && options.frames.end > 1)
        check_options.last_start = &earlier;
    if (!options.hashes.empty() || !options.images.empty() || collector)
        check_options.on_state = [&](const ComparedFrame& frame) {
            if (!options.hashes.empty())
                hashes.add(frame);
            if (!options.images.empty() || (collector && checked.run.shaders))
                images.keep(frame);
            if (collector)
                collector->add(frame);
        };
    int frames_done = 0;
    const auto run_both = [&] {
        const InterruptHandler handler;
        Progress progress("check", options.frames.end - options.frames.first, !options.quiet);
        check_options.on_frame = [&](int done) { progress.show(frames_done = done); };
        return judge_frames(checked.scene, checked.profile, checked.gpu, check_options);
    };
    std::optional<CheckReport> compared;
    try {
        compared = run_both();
    } catch (const Error& error) {
        if (!interrupted || frames_done > 0)
            throw;
        fmt::print(stderr, "lockstep: interrupted: {}\n", error.what());
        return status_interrupted;
    }
    CheckReport& report = *compared;
    if (checked.part != nullptr)
        checked.part->report = report;
    conclude(report);
    if (checked.part != nullptr)
        report.part = part_text(options, checked.part->of);
    const PassRules rules = checked.part == nullptr ? options.rules : rules_of_part(options.rules);
    ask_power(report, rules.power_at_least);
    ask_hits(report, rules);

    if (render)
        judge_last(options, checked, earlier, report);
    const std::vector<ShaderWarning> warnings =
        checked.warnings == nullptr ? std::vector<ShaderWarning>() : *checked.warnings;
    note_unset_variables(report, warnings);
    RunDescription run = description(options, checked.run, report);
    InputDigests inputs;
    if (run.shaders) {
        note_what_ran(*run.shaders);
        inputs = input_digests();
    }
    for (std::string& note : warning_notes(warnings))
        run.notes.push_back(std::move(note));
    if (checked.part != nullptr)
        run.notes.insert(run.notes.end(), checked.part->own_notes.begin(), checked.part->own_notes.end());
    if (checked.run.shaders)
        std::ranges::move(lines_without_counterpart(checked.scene, options.run.shaders, checked.profile, checked.known,
                                                    report, is_rendered(options)),
                          std::back_inserter(run.notes));
    tell(options, report, run);
    if (collector) {
        const SecondLook look = look_again(options, checked, collector->frames().items());
        std::vector<PageCommand> commands = page_commands(options, run, report);
        if (!look.capsule.missing.empty()) {
            fmt::print(stderr, "lockstep: {}\n", look.capsule.missing);
            run.notes.push_back(look.capsule.missing);
        }
        if (!look.capsule.file.empty()) {
            files.write(options.report / report_files[1], look.capsule.file);
            commands.push_back({"The first divergent particle's step, from the file beside this page; needs no GL",
                                fmt::format("lockstep capsule show {}", shell_path(options.report / report_files[1]))});
        }
        RenderedPictures rendered{images.frame(), {}};
        if (checked.run.shaders && images.frame() >= 0) {
            auto [reference, gpu, difference] = images.rendered(checked.scene, checked.profile, options.run.shaders);
            rendered.pictures = {
                {"Reference", std::move(reference)}, {"GPU", std::move(gpu)}, {"Difference", std::move(difference)}};
        }
        files.write(options.report / report_files[0],
                    report_page(page, *collector, report, run, commands, look.items, study, rendered));
    }
    const bool pass = passes(report, rules);
    if (!options.json.empty()) {
        nlohmann::json json = report_json(report, run);
        if (!inputs.empty())
            json["inputs"] = inputs_json(inputs);
        files.write(options.json,
                    checked.part == nullptr ? json_text(json) : part_file_text(json, part_file_json(*checked.part)));
    }
    if (!options.junit.empty())
        files.write(options.junit, junit_text(report, run, pass, inputs));
    if (!options.hashes.empty())
        files.write(options.hashes, hashes.text());
    if (!options.images.empty())
        images.write(files, options.images, checked.scene, checked.profile, options.run.shaders);
    files.commit();
    if (!options.quiet)
        fmt::print("{}", files.written_text());
    if (report.interrupted())
        return status_interrupted;
    return pass ? status_agree : status_differ;
}

int run_scene(CheckRequest options) {
    if (options.frames.is_part)
        expect_part(options);
    const Scene scene = load(options.run);
    ShaderUse shaders = shaders_to_run(options.run, scene, is_rendered(options));
    OutputFiles files;
    expect_files(options, files);
    const Context context(parse_context_request(options.run.gl));
    if (!is_rendered(options))
        compile_unrendered(scene, options.run.shaders);
    const Profile profile = measured_profile(context, scene, options.run.shaders);
    RuleByText rule = rule_by_text(options.legal, scene, shaders, options.run.shaders, is_rendered(options));
    options.legal = rule.legal;
    std::vector<std::string> notes = conversion_notes(profile, scene.switches);
    std::ranges::move(rule.notes, std::back_inserter(notes));
    std::vector<ShaderWarning> warnings;
    const ShaderWarnings collected(warnings);
    GpuSimulation gpu(scene, options.run.shaders);
    return check_and_tell(options, files,
                          {scene,
                           profile,
                           gpu,
                           known_operations(options.legal, profile),
                           {scene.name,
                            options.run.scene.string(),
                            summary(context.describe()),
                            describe(profile),
                            settings_text(options.run, scene),
                            std::move(notes),
                            std::move(shaders),
                            {},
                            scene.width},
                           nullptr,
                           &warnings});
}

/// The frames that this run is to compare, of all of them.
FrameRange frames_of(const CheckRequest& options, const TraceInfo& info) {
    const std::string held = fmt::format("{} holds {} frames", info.file, info.frames);
    FrameRange frames = options.frames_given ? options.frames : FrameRange{0, info.frames};
    if (frames.end > info.frames)
        throw Error(frames.is_part ? fmt::format("--frames {}: {}, 0 to {}", frames.text(), held, info.frames - 1)
                                   : fmt::format("--frames {}: {}", frames.text(), held));
    if (!options.shard.is_asked())
        return frames;
    const auto count = static_cast<std::size_t>(frames.end);
    if (options.shard.of > count)
        throw Error(fmt::format("{}: {} frames make {} parts at most, and none may be empty", options.shard.asked,
                                count, count));
    return {static_cast<int>(options.shard.first(count)), static_cast<int>(options.shard.end(count)), true};
}

int run_trace(CheckRequest options) {
    expect_twins(options.run);
    start_threads(options.run.threads);
    if (options.heeds_environment && !options.frames.is_part && !options.shard.is_asked())
        options.shard = shard_of_environment();
    if (options.frames.is_part || options.shard.is_asked())
        expect_part(options);
    OutputFiles files;
    expect_files(options, files);
    TraceReader trace(options.trace);
    const TraceInfo& info = trace.info();
    const int whole = options.frames_given && !options.frames.is_part ? options.frames.end : info.frames;
    options.frames = frames_of(options, info);
    const Profile profile = followed_profile(info);
    std::vector<std::string> notes = notes_on(info);
    for (std::string& note : conversion_notes(profile, info.scene.switches))
        notes.push_back(std::move(note));
    if (whole < info.frames)
        notes.push_back(fmt::format("{} of the {} frames recorded were compared", whole, info.frames));
    CheckedRun run{info.scene.name,
                   info.file,
                   fmt::format("recorded: {}", info.renderer.empty() ? "untold" : info.renderer),
                   describe(profile),
                   info.settings.empty() ? "untold" : info.settings,
                   std::move(notes),
                   {},
                   info.shaders,
                   info.scene.width};
    TraceSide recorded(trace);
    RunPart part;
    if (options.frames.is_part)
        part = {options.trace.string(), trace.seal(), info.frames, whole, options, run, {}, part_notes(options, whole)};
    return check_and_tell(options, files,
                          {info.scene, profile, recorded, known_operations(info, options.legal), std::move(run),
                           options.frames.is_part ? &part : nullptr});
}

SystemCheck system_check(const CheckRequest& options) {
    return {.mode = options.mode,
            .legal = options.legal,
            .rules = options.rules,
            .json = options.json,
            .hashes = options.hashes,
            .images = options.images,
            .report = options.report,
            .power = options.power,
            .quiet = options.quiet,
            .hexadecimal = options.hexadecimal,
            .render = !options.no_render,
            .trace = options.trace,
            .frames_given = options.frames_given};
}

void check_stress_options(const Call& call, const CheckRequest& options) {
    if (options.frames.is_part)
        throw Error(fmt::format("check: --frames {}: --stress checks its scenes from their start; right is a number of "
                                "frames, or --shard for some of the scenes",
                                options.frames.text()));
    static constexpr std::array<std::string_view, 18> allowed{
        "--shard",   "--stress",       "--frames", "--preset",          "--set",          "--threads",        "--gl",
        "--shaders", "--allow-unused", "--legal",  "--allow-undefined", "--require-hits", "--power-at-least", "--power",
        "--json",    "--quiet",        "--help",   "--werror-shaders"};
    if (!options.run.scene.empty())
        throw Error("check: a scene does not go with --stress, which brings its own");
    check_options(call, "--stress", allowed);
}

} // namespace

Verb report_command() {
    auto options = std::make_shared<CheckRequest>();
    options->report = ".";
    Verb verb{"report", "check a recorded run, and write report.html about it"};
    verb.add(required(path_option("trace", "FILE", options->trace,
                                  "what `lockstep record` wrote, or an engine of your own (docs/traces.md)")));
    verb.add(path_option("-o,--output", "DIR", options->report, "where report.html goes"));
    verb.add(
        otherwise(integer_option("--frames", "N", {1, most_frames}, options->frames.end, "frames to compare"), "all"));
    add_threads_option(verb, options->run);
    add_legal_option(verb, options->legal);
    add_pass_options(verb, options->rules);
    verb.add(flag("--quiet", options->quiet, "the page alone, and the exit status"));
    verb.footer = "Exit status: as lockstep check --trace FILE --report DIR, which does the same.\n"
                  "Example: lockstep report run.h5 -o pages";
    verb.run = [options](const Call& call) {
        options->frames_given = call.has("--frames");
        options->run.frames = options->frames.end;
        const RegisteredSystem* system = system_of_recording(options->trace);
        if (system != nullptr && options->rules.require_hits)
            throw Error(
                fmt::format("report: --require-hits does not go with a recording of system {}", name_of(*system)));
        return system != nullptr ? check_system(*system, options->run, system_check(*options)) : run_trace(*options);
    };
    return verb;
}

Verb check_command() {
    auto options = std::make_shared<CheckRequest>();
    Verb verb{"check", "run both sides and compare every bit of every frame"};
    add_scene_options(verb, options->run, SceneArgument::optional);
    add_gl_options(verb, options->run);
    add_reference_option(verb, options->run);
    add_trace_option(verb, options->trace);
    verb.add(frames_option("--frames", options->frames,
                           "frames to compare; without it all of a trace; A..B: only these, counted from 0"));
    verb.add(shard_option(options->shard));
    verb.add(choice_option<CheckMode>("--mode", options->mode,
                                      {{"resync", CheckMode::resync}, {"free", CheckMode::free}},
                                      "resync: each frame's step alone; free: both run on by themselves"));
    add_legal_option(verb, options->legal);
    add_pass_options(verb, options->rules);
    add_cover_option(verb, options->rules);
    verb.add(path_option("--json", "FILE", options->json, "write the report as JSON"));
    verb.add(path_option("--junit", "FILE", options->junit, "write the verdict as JUnit"));
    verb.add(path_option("--hashes", "FILE", options->hashes, "write both sides' state hash of every frame"));
    verb.add(path_option("--images", "DIR", options->images,
                         "write CDT and rendered frame of both sides, and their difference, as PNG"));
    verb.add(path_option("--report", "DIR", options->report,
                         "write a self-contained report.html to DIR (includes DIR/study.json if present)"));
    verb.add(flag("--no-render", options->no_render, "do not judge the rendered frame, the last one's picture"));
    verb.add(flag("--render", options->render, "judge the last rendered frame; warn if it shows no particle"));
    verb.add(flag("--power", options->power, "list which mistakes the run would have shown, and why not the others"));
    verb.add(flag("--stress", options->stress,
                  "instead of a scene: all of data/scenes/stress, small ones in which mistakes show"));
    verb.add(hex_option(options->hexadecimal));
    verb.add(flag("--quiet", options->quiet, "no report, only the exit status"));
    verb.footer =
        "Exit status: 0 every bit agrees, or what differs is legal (rounding, ties); 1 divergent, undefined "
        "without --allow-undefined, any difference in free mode, no hit with --require-hits, or less power than "
        "--power-at-least, or less of the shaders' texts run than --cover-at-least; 2 could not run; "
        "130 ended by Ctrl-C, with a verdict on the frames before.\n"
        "Example: lockstep check data/scenes/lattice.json --frames 100 --preset paper";
    verb.run = [options](const Call& call) {
        if (options->render && options->no_render)
            throw Error("check: --render does not go with --no-render; right is one of them");
        if (options->mode == CheckMode::free && call.has("--legal"))
            throw Error("check: --legal does not go with --mode free, which judges nothing; right is --mode resync");
        options->run.frames = options->frames.end;
        if (options->stress) {
            check_stress_options(call, *options);
            if (!options->shard.is_asked())
                options->shard = shard_of_environment();
            return check_stress({options->run, options->legal, options->rules, options->shard, options->json,
                                 options->power, options->quiet});
        }
        check_scene_or_trace(call, options->run, options->trace);
        options->frames_given = call.has("--frames");
        options->heeds_environment = true;
        if (const RegisteredSystem* system =
                options->trace.empty() ? system_of(options->run) : system_of_recording(options->trace)) {
            check_options(call, fmt::format("a scene of system {}", name_of(*system)), system_check_options());
            if (options->frames.is_part)
                throw Error(
                    fmt::format("check: --frames {}: a scene of system {} is checked from its start; right is a "
                                "number of frames",
                                options->frames.text(), name_of(*system)));
            return check_system(*system, options->run, system_check(*options));
        }
        if (options->rules.cover_at_least > 0.0)
            throw Error("check: --cover-at-least does not go with a scene of system collision, whose shaders are not "
                        "run by their texts");
        if (options->trace.empty() && options->shard.is_asked())
            throw Error(
                fmt::format("{}: shares out the frames of a recording (lockstep record, check --trace FILE), or the "
                            "scenes of --stress; a scene that is run here has to run from its start",
                            options->shard.asked));
        return options->trace.empty() ? run_scene(*options) : run_trace(*options);
    };
    return verb;
}

} // namespace lockstep
