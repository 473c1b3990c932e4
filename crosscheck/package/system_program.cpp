#include "lockstep/system_program.hpp"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/command/command_line.hpp"
#include "crosscheck/command/exit_status.hpp"
#include "crosscheck/command/judging_options.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/judge/item_place.hpp"
#include "crosscheck/package/item_verbs.hpp"
#include "crosscheck/package/own_texts.hpp"
#include "crosscheck/report/colour.hpp"
#include "crosscheck/report/shader_notes.hpp"
#include "crosscheck/report/system_debug_run.hpp"
#include "gpu/shaders_read_once.hpp"

namespace lockstep {
namespace {

/// A system with its shaders, as the program was made for.
struct OwnProgram {
    System& system;
    const std::vector<GlPass>& passes;
    std::filesystem::path shaders;  ///< its own
    std::vector<std::string> words; ///< of the command line, after the program's name
};

struct Options {
    std::string gl = "auto";
    std::filesystem::path shaders, reference;
    int frames = 60;
    CheckMode mode = CheckMode::resync;
    PassRules rules;
    bool power = false, quiet = false, every = false;
    std::filesystem::path json, capsule, hashes, report;
    std::filesystem::path trace; ///< a recording, instead of GL
    std::filesystem::path output;
    int deflate = 1;
    bool frames_given = false;
    std::string profile = "strict";
    SystemItem item;
};

void add_gl_options(Verb& verb, Options& options) {
    verb.add(text_option("--gl", "auto|osmesa|egl|egl-device:N", options.gl, "which GL to open"));
    verb.add(path_option("--shaders", "DIR", options.shaders, "take the shaders from here instead"));
    add_werror_option(verb);
}

void add_reference_option(Verb& verb, Options& options) {
    verb.add(path_option("--reference", "DIR", options.reference,
                         "compute and vertex shaders that are the reference of their passes, instead of the twins"));
}

void add_item_options(Verb& verb, SystemItem& item) {
    verb.add(frame_option(item.frame));
    verb.add(required(text_option("--item", "I|X,Y", item.item, "the item; in an image its column and row")));
    verb.add(pass_option(item.pass));
    add_legal_option(verb, item.legal);
}

/// The system's shaders on this machine's GL, or a recording of them.
class OpenSide {
  public:
    OpenSide(const OwnProgram& program, const Options& options) : texts_(program.system, program.passes) {
        const bool is_recorded = !options.trace.empty();
        if (!options.reference.empty())
            texts_.take_references(options.reference, is_recorded ? std::nullopt : std::optional(options.shaders));
        if (is_recorded) {
            recording_.emplace(options.trace, program.system.schema.system);
            recording_->open(program.system);
            side_ = std::make_unique<RecordedSide>(*recording_, program.system);
            return;
        }
        gl_.emplace(options.gl);
        if (!*gl_)
            throw Error(gl_->missing());
        side_ = std::make_unique<GlSystemSide>(*gl_, program.system, program.passes, options.shaders.string());
        texts_.take_shaders(options.shaders, options.reference.empty() ? program.shaders : options.reference);
    }

    SystemSide& operator*() { return *side_; }
    SystemSide* operator->() { return side_.get(); }
    [[nodiscard]] const SystemRecording* recording() const { return recording_ ? &*recording_ : nullptr; }
    [[nodiscard]] const SystemTexts& texts() const { return texts_; }

  private:
    SystemTexts texts_;
    std::optional<SystemRecording> recording_;
    std::optional<Gl> gl_;
    std::unique_ptr<SystemSide> side_;
};

/// How many frames are compared: of a recording all, if it was not said.
int frames_of(const Options& options, const OpenSide& gpu) {
    if (gpu.recording() == nullptr)
        return options.frames;
    const int recorded = gpu.recording()->frames();
    if (options.frames_given && options.frames > recorded)
        throw Error(fmt::format("--frames {}: {} holds {} frames", options.frames, options.trace.string(), recorded));
    return options.frames_given ? options.frames : recorded;
}

void keep_capsule(const OwnProgram& program, const Options& options, const CheckReport& report, SystemSide& side,
                  OutputFiles& files) {
    if (!report.verdicts || !report.verdicts->first) {
        fmt::print("capsule   none: nothing is divergent\n");
        return;
    }
    const auto& [place, pass] = std::pair(report.verdicts->first->place, report.verdicts->first->pass);
    SystemRun run(program.system, side, known_operations(options.item.legal, side.describe().profile), place.frame,
                  pass);
    files.write(options.capsule,
                item_capsule_file(cut_item_capsule(run, place.index, side.describe().name), program.system));
    fmt::print("capsule   {} of frame {}\n",
               item_name(program.system.schema.resources[place.resource], program.system.start.extent(place.resource),
                         place.index),
               place.frame);
}

int check_verb(const OwnProgram& program, const Options& options) {
    OpenSide gpu(program, options);
    OutputFiles files;
    files.protect(options.shaders);
    files.protect(options.reference);
    files.protect(options.trace);
    for (const auto& output : {options.json, options.capsule})
        if (!output.empty())
            files.expect(output);
    CheckFiles outputs(options.report, options.hashes);
    outputs.expect(files);
    CheckOptions check;
    check.mode = options.mode;
    check.frames = frames_of(options, gpu);
    check.known = known_operations(options.item.legal, gpu->describe().profile);
    CheckReport report =
        check_shown(program.system, *gpu, check, options.quiet, outputs.watch(program.system, *gpu, check.frames));
    ask_power(report, options.rules.power_at_least);
    note_unset_variables(report, gpu->describe().warnings);
    RunDescription run = describe_run(program.system, gpu->describe(), check, this_program(program.words));
    run.numbers = number_format(options.item.hexadecimal);
    if (gpu.recording() != nullptr) {
        run.shaders_untold = "recorded: " + gpu.recording()->info().shaders;
        run.notes = gpu.recording()->warnings();
    }
    add_notes(run, gpu.texts().notes(*gpu, *check.known, report, covered_runs(options.rules)));
    ask_coverage(report, coverage_count(run.coverage), options.rules.cover_at_least);
    const auto explain_line = [&](const std::vector<std::string>& words) {
        std::vector<std::string> explain{"explain"};
        explain.insert(explain.end(), words.begin(), words.end());
        if (options.trace.empty())
            explain.insert(explain.end(), {"--gl", options.gl, "--shaders", options.shaders.string()});
        else
            explain.insert(explain.end(), {"--trace", options.trace.string()});
        if (!options.reference.empty())
            explain.insert(explain.end(), {"--reference", options.reference.string()});
        return this_program(explain) + legal_option_text(options.item.legal);
    };
    if (const auto words = first_item_words(program.system, report); !words.empty())
        run.explain = explain_line(words);
    if (!options.quiet)
        fmt::print(
            "{}{}{}",
            report.interrupted() ? fmt::format("interrupted after {} of {} frames\n", report.frames, check.frames) : "",
            colored(plain_text(report_text(report, run))), options.power ? power_text(report.power) : std::string());
    std::fflush(stdout);
    CheckFiles::Told told{{{"This run", run.repeat}}, explain_line, {}, [](const std::filesystem::path& capsule) {
                              return this_program({"capsule", "show", capsule.string()});
                          }};
    if (!run.explain.empty())
        told.commands.push_back({"The first item that differs, step by step", run.explain});
    outputs.write(files, report, run, std::move(told), [&] {
        const FirstDivergence& first = *report.verdicts->first;
        SystemRun again(program.system, *gpu, *check.known, first.place.frame, first.pass);
        return item_capsule_file(cut_item_capsule(again, first.place.index, gpu->describe().name), program.system);
    });
    if (!options.json.empty())
        files.write(options.json, json_text(report_json(report, run)));
    if (!options.capsule.empty())
        keep_capsule(program, options, report, *gpu, files);
    files.commit();
    if (!options.quiet)
        fmt::print("{}", files.written_text());
    if (report.interrupted())
        return status_interrupted;
    return passes(report, options.rules) ? status_agree : status_differ;
}

int explain_verb(const OwnProgram& program, const Options& options) {
    static_cast<void>(place_of(options.item, program.system));
    OpenSide gpu(program, options);
    fmt::print("{}", colored(explain_text(program.system, *gpu, options.item, "")));
    return status_agree;
}

int debug_verb(const OwnProgram& program, const Options& options) {
    OpenSide gpu(program, options);
    DebugSetup setup;
    setup.frames = options.frames;
    setup.format = number_format(options.item.hexadecimal);
    setup.unchangeable = "this program's system has no switches";
    if (gpu.recording() != nullptr) {
        setup.recorded = gpu.recording()->frames();
        setup.unchangeable = recorded_is_fixed;
    }
    const SideDescription about = gpu->describe();
    setup.heading = run_heading(program.system.name, "", program.system.settings, about.name, about.profile);
    // They outlive the session.
    const std::shared_ptr<const System> system(std::shared_ptr<void>(), &program.system);
    const std::shared_ptr<SystemSide> side(std::shared_ptr<void>(), &*gpu);
    setup.start = [&](const std::vector<std::string>&) {
        return std::make_unique<SystemDebugRun>(system, side,
                                                known_operations(options.item.legal, gpu->describe().profile));
    };
    return debug_run(std::move(setup));
}

int record_verb(const OwnProgram& program, const Options& options) {
    OpenSide gpu(program, options);
    OutputFiles files;
    files.protect(options.shaders);
    files.expect(options.output);
    const RunDescription about = describe_run(program.system, gpu->describe(), {}, "");
    return record_run(program.system, *gpu,
                      {.name = program.system.name, .shaders = about.shaders_untold, .frames = options.frames},
                      options.output, options.deflate);
}

int trace_verb(const OwnProgram& program, const Options& options) {
    OpenSide gpu(program, options);
    fmt::print("{}", plain_text(recording_text(program.system, *gpu, *gpu.recording())));
    return status_agree;
}

int cut_verb(const OwnProgram& program, const Options& options) {
    static_cast<void>(place_of(options.item, program.system));
    OpenSide gpu(program, options);
    OutputFiles files;
    files.protect(options.shaders);
    files.protect(options.trace);
    files.expect(options.capsule);
    const ItemCapsule capsule = cut_item(program.system, *gpu, options.item);
    files.write(options.capsule, item_capsule_file(capsule, program.system));
    files.commit();
    print_cut(files, program.system, options.item, capsule);
    return status_agree;
}

int show_verb(const OwnProgram& program, const Options& options) {
    const ItemCapsule capsule = load_item_capsule(options.capsule, program.system);
    fmt::print("{}", shown_text(capsule, program.system, number_format(options.item.hexadecimal)));
    return status_of(capsule, program.system);
}

int hash_verb(const OwnProgram& program, const Options& options) {
    print_hashes(program.system, options.profile, {.end = options.frames, .every = options.every});
    return status_agree;
}

/// As `lockstep` has them for the systems it knows (docs/verbs.md): the same names, words and statuses.
Verb verbs_of(const std::string& name, const OwnProgram& program, const std::shared_ptr<Options>& options) {
    const auto running = [&program, options](int (*run)(const OwnProgram&, const Options&)) {
        return [&program, options, run](const Call& call) {
            if (!options->trace.empty())
                for (const char* option : {"--gl", "--shaders", "--werror-shaders", "--cover-at-least"})
                    if (call.has(option))
                        throw Error(fmt::format("{}: {} goes with shaders that run here, not with --trace",
                                                call.verb.name, option));
            options->frames_given = call.has("--frames");
            return run(program, *options);
        };
    };
    const auto add_trace_option = [options](Verb& verb) {
        verb.add(path_option("--trace", "FILE", options->trace, "instead of shaders: a recorded run; needs no GL"));
    };
    Verb check{"check", "run both sides, pass by pass, and compare every bit of every frame"};
    check.add(integer_option("--frames", "N", {1, most_frames}, options->frames, "frames to compare"));
    check.add(choice_option<CheckMode>("--mode", options->mode,
                                       {{"resync", CheckMode::resync}, {"free", CheckMode::free}},
                                       "resync: each frame's step alone; free: both run on by themselves"));
    add_gl_options(check, *options);
    add_reference_option(check, *options);
    add_legal_option(check, options->item.legal);
    check.add(flag("--allow-undefined", options->rules.allow_undefined, "do not fail on what GL leaves open"));
    check.add(share_option("--power-at-least", options->rules.power_at_least,
                           "fail where the run would have shown fewer of the mistakes with names: 95%, 0.95"));
    add_cover_option(check, options->rules);
    check.add(flag("--power", options->power, "list which mistakes the run would have shown, and why not the others"));
    check.add(path_option("--json", "FILE", options->json, "write the report as JSON"));
    check.add(path_option("--hashes", "FILE", options->hashes, "write both sides' state hash of every frame"));
    check.add(path_option("--report", "DIR", options->report, "write a self-contained report.html to DIR"));
    check.add(path_option("--capsule", "FILE", options->capsule, "keep the first item that is divergent"));
    check.add(hex_option(options->item.hexadecimal));
    check.add(flag("--quiet", options->quiet, "no report, only the exit status"));
    add_trace_option(check);
    check.run = running(check_verb);

    Verb record{"record", "write the GPU's states of a run to a file that is checked elsewhere"};
    add_gl_options(record, *options);
    record.add(required(path_option("-o,--output", "FILE", options->output, "the recording, HDF5")));
    record.add(integer_option("--frames", "N", {1, most_frames}, options->frames, "frames to record"));
    record.add(integer_option("--deflate", "LEVEL", {0, 9}, options->deflate, "how hard to compress, 0 to 9"));
    record.run = running(record_verb);
    Verb trace{"trace", "read a recorded run whole, and report what is in it or what is wrong"};
    trace.add(required(path_option("trace", "FILE", options->trace, "what `record` wrote")));
    trace.run = running(trace_verb);
    Verb report{"report", "check a recorded run, and write report.html about it"};
    report.add(required(path_option("trace", "FILE", options->trace, "what `record` wrote")));
    report.add(required(path_option("-o,--output", "DIR", options->report, "where report.html goes")));
    report.add(
        otherwise(integer_option("--frames", "N", {1, most_frames}, options->frames, "frames to compare"), "all"));
    add_legal_option(report, options->item.legal);
    report.add(flag("--quiet", options->quiet, "the page alone, and the exit status"));
    report.run = running(check_verb);

    Verb explain{"explain", "both sides of one item in one frame, value by value"};
    add_gl_options(explain, *options);
    add_reference_option(explain, *options);
    add_item_options(explain, options->item);
    explain.add(hex_option(options->item.hexadecimal));
    add_trace_option(explain);
    explain.run = running(explain_verb);

    Verb debug{"debug", "walk through both sides by commands, typed or from a pipe"};
    add_gl_options(debug, *options);
    add_reference_option(debug, *options);
    debug.add(integer_option("--frames", "N", {1, most_frames}, options->frames,
                             "how many frames `next` and `continue` look through"));
    add_legal_option(debug, options->item.legal);
    debug.add(hex_option(options->item.hexadecimal));
    add_trace_option(debug);
    debug.footer = "`help` lists the commands.";
    debug.run = running(debug_verb);

    Verb cut{"cut", "cut one out of a run"};
    add_gl_options(cut, *options);
    add_item_options(cut, options->item);
    cut.add(required(path_option("-o,--output", "FILE", options->capsule, "the capsule, JSON, at most 100 kB")));
    add_trace_option(cut);
    cut.run = running(cut_verb);
    Verb show{"show", "judge one again, and print its table; needs no GL"};
    show.add(required(path_option("capsule", "FILE", options->capsule, "what `capsule cut` or `check` wrote")));
    show.add(hex_option(options->item.hexadecimal));
    show.run = running(show_verb);
    Verb capsule{"capsule", "one item's step as a small file that repeats its verdict anywhere"};
    capsule.verbs = {cut, show};

    Verb hash{"hash", "run the reference alone and print its state hash; needs no GL"};
    hash.add(integer_option("--frames", "N", {1, most_frames}, options->frames, "frames to run"));
    hash.add(text_option("--profile", "strict|llvmpipe|nvidia", options->profile, "the order of sums"));
    hash.add(flag("--every", options->every, "print every frame's hash, not only the last"));
    hash.run = running(hash_verb);

    Verb verbs{
        name,
        fmt::format("{}: runs the system's twins beside its shaders, and compares every bit of every frame", name)};
    verbs.verbs = {check, explain, debug, capsule, hash, record, trace, report};
    verbs.footer = "Exit status: 0 it agrees or is legal, 1 it is not, 2 could not run, 130 ended by Ctrl-C.";
    return verbs;
}

std::string name_of(int argc, char** argv) {
    return argc > 0 ? std::filesystem::path(argv[0]).filename().string() : "lockstep";
}

/// What `run` throws is a message.
template <class Run> int telling(const std::string& name, const Run& run) {
    try {
        return run();
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: {}\n", name, plain_line(error.what()));
        return status_could_not_run;
    }
}

} // namespace

int run_system_program(int argc, char** argv, const std::function<System()>& system,
                       const std::function<std::vector<GlPass>()>& passes, const std::string& shaders) {
    return telling(name_of(argc, argv), [&] { return run_system_program(argc, argv, system(), passes(), shaders); });
}

int run_system_program(int argc, char** argv, const System& system, const std::vector<GlPass>& passes,
                       const std::string& shaders) {
    const std::string name = name_of(argc, argv);
    return telling(name, [&] {
        const ShadersReadOnce one_text_a_run;
        System here = beside(system);
        const OwnProgram program{here, passes, shaders, {argv + std::min(argc, 1), argv + argc}};
        const auto options = std::make_shared<Options>();
        options->shaders = shaders;
        return run_command_line(verbs_of(name, program, options), argc, argv, status_could_not_run);
    });
}

} // namespace lockstep
