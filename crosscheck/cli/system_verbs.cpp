#include "crosscheck/cli/system_verbs.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/system_run.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/png.hpp"
#include "crosscheck/files/run_inputs.hpp"
#include "crosscheck/files/shell_words.hpp"
#include "crosscheck/judge/dispatch.hpp"
#include "crosscheck/judge/system_check.hpp"
#include "crosscheck/judge/system_run.hpp"
#include "crosscheck/package/driver_notes.hpp"
#include "crosscheck/package/shader_findings.hpp"
#include "crosscheck/package/text_passes.hpp"
#include "crosscheck/record/capsule_parts.hpp"
#include "crosscheck/record/item_capsule.hpp"
#include "crosscheck/report/colour.hpp"
#include "crosscheck/report/item_text.hpp"
#include "crosscheck/report/picture_difference.hpp"
#include "crosscheck/report/places.hpp"
#include "crosscheck/report/power_text.hpp"
#include "crosscheck/report/run_to_run.hpp"
#include "crosscheck/report/shader_notes.hpp"
#include "crosscheck/report/system_debug_run.hpp"
#include "gpu/stages_run.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

constexpr int capsule_version = 1;

std::string check_line(const SystemInput& input, const SystemCheck& asked, int frames) {
    return input.command("check", fmt::format("--frames {}", frames)) +
           (asked.mode == CheckMode::free ? " --mode free" : "") + legal_option_text(asked.legal) +
           pass_options_text(asked.rules) + (asked.render ? "" : " --no-render");
}

/// What the last frame draws.
struct DrawnFrame {
    std::optional<CheckReport> report;
    RunDescription about;
    int frame = 0;
    std::size_t items = 0;
    std::string item = {};               ///< one of them
    std::vector<std::string> first = {}; ///< options of `explain` for the first that differs
};

/// What the texts of the user's own shaders say.
void add_text_notes(RunDescription& about, const ShadedSystem& of, const OwnTexts& own, const RunOptions& run,
                    SystemSide& side, const KnownOperations& known, const PassRules& rules, CheckReport& report) {
    DivergentPass divergence(of.system, side, known, report);
    TextNotes notes;
    if (about.shaders && !run.shaders.empty())
        notes =
            text_notes(of, {own, *about.shaders, run.shaders, run.reference}, divergence, report, covered_runs(rules));
    for (std::string& note : driver_notes(of, own, run.shaders, notes.findings, divergence))
        about.notes.push_back(std::move(note));
    add_notes(about, std::move(notes));
}

/// From the state that the GPU's frames left.
DrawnFrame judge_drawn(const SystemInput& input, const SystemSide& side, const RunOptions& run,
                       const SystemCheck& asked, const CheckReport& report) {
    const SystemScene& scene = input.scene();
    if (!scene.picture || input.is_recorded())
        return {};
    SystemState state = scene.system.start;
    side.read(state);
    const int frame = report.frames - 1;
    DrawnSystem made_here = input.drawn(state, frame);
    const SystemPicture& picture = made_here.picture;
    GlSystemSide drawn = side_of(input.gl(), picture, scene, run);
    CheckOptions options;
    options.frames = 1;
    options.known = known_operations(asked.legal, drawn.describe().profile);
    RunDescription about =
        describe_run(picture.system, drawn.describe(), options, check_line(input, asked, report.frames));
    about.scene = fmt::format("what frame {} of {} draws", frame, scene.system.name);
    const std::uint8_t made = picture.system.passes.front()->resource();
    DrawnFrame judged{check(picture.system, drawn, options), std::move(about), frame,
                      picture.system.start.extent(made).count(), picture.system.schema.resources[made].item};
    number_frame(*judged.report, frame);
    note_unset_variables(*judged.report, drawn.describe().warnings);
    judged.first = first_item_words(picture.system, *judged.report);
    judged.about.shaders = input.shaders();
    add_text_notes(judged.about, made_here.shaded(scene.arithmetic), made_here.own_texts, run, drawn, *options.known,
                   asked.rules, *judged.report);
    return judged;
}

/// A frame's picture has little power of its own.
PassRules drawn_rules(PassRules rules) {
    rules.power_at_least = 0.0;
    return rules;
}

std::string drawn_words(const DrawnFrame& drawn) {
    const CheckReport& report = *drawn.report;
    return fmt::format("{}: {} {}s that frame {} draws; coverage and blending are not judged", verdict_words(report),
                       drawn.items, drawn.item, drawn.frame);
}

std::string drawn_text(const DrawnFrame& drawn, const PassRules& rules) {
    if (!passes(*drawn.report, drawn_rules(rules)))
        return "\n" + report_text(*drawn.report, drawn.about);
    return fmt::format("drawn     {}\n", drawn_words(drawn));
}

/// Keeps both sides' state of the frame of which pictures are written: the first that differs, else the last.
class PicturedFrame {
  public:
    static constexpr std::array<std::string_view, 3> names{"frame_reference.png", "frame_gpu.png",
                                                           "frame_difference.png"};

    void keep(int frame, const SystemState& reference, const SystemState& gpu) {
        if (differs_)
            return;
        frame_ = frame;
        differs_ = state_hash(reference) != state_hash(gpu);
        reference_ = reference;
        gpu_ = gpu;
    }

    void write(OutputFiles& files, const std::filesystem::path& folder, const SystemScene& scene, const Gl& gl,
               const Profile& profile, const RunOptions& run) const {
        if (frame_ < 0)
            return;
        const ColorImage of_reference = reference_picture(scene, reference_, frame_, profile);
        const ColorImage of_gpu = gpu_picture(gl, scene, gpu_, frame_, run);
        files.write(folder / names[0], png(of_reference));
        files.write(folder / names[1], png(of_gpu));
        files.write(folder / names[2], png(difference_picture(of_reference, of_gpu)));
    }

  private:
    int frame_ = -1;
    bool differs_ = false;
    SystemState reference_, gpu_;
};

/// The file of a capsule with the scene that it is of. Throws Error where it would be too large.
std::string capsule_text(const ReadScene& read, const ItemCapsule& capsule) {
    const System& twins = read.scene.system;
    const json document{{"lockstep_system_capsule", capsule_version},
                        {"name", twins.name},
                        {"scene", read.document},
                        {"options", read.options},
                        {"capsule", json::parse(item_capsule_file(capsule, twins))}};
    std::string text = document.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
    if (text.size() > largest_capsule)
        throw Error(fmt::format("its capsule would be {} bytes, with the scene; right is at most {}", text.size(),
                                largest_capsule));
    return text;
}

/// Whether a pass that is asked for is one that draws a frame, not one that makes it.
bool is_drawn(const SystemInput& input, const std::string& pass) {
    const auto is_asked = [&](const auto& one) { return one->name() == pass; };
    if (input.is_recorded() || !input.scene().picture || std::ranges::any_of(input.system().passes, is_asked))
        return false;
    return std::ranges::any_of(input.scene().picture(input.system().start, 0).system.passes, is_asked);
}

/// An item that a frame draws, from the state that the GPU's kernels left.
std::string explain_drawn(SystemInput& input, const RunOptions& run, const SystemItem& item) {
    SystemState state = input.system().start;
    static_cast<void>(place_of(item, input.scene().picture(state, item.frame).system));
    run_gpu(input.system(), input.open(), item.frame + 1, [&](std::size_t, int, const SystemState& now) {
        state = now;
        return true;
    });
    DrawnSystem drawn_here = input.drawn(state, item.frame);
    SystemPicture& picture = drawn_here.picture;
    picture.system.name = input.system().name;
    picture.system.settings = input.system().settings;
    GlSystemSide drawn = side_of(input.gl(), picture, input.scene(), run);
    const std::string text = explain_drawn_text(picture.system, drawn, item, input.read().file);
    const auto [pass, index] = place_of(item, picture.system);
    const std::optional<std::uint8_t> instances = picture.passes[pass].instances_of;
    if (!instances)
        return text;
    const std::size_t vertices = picture.system.start.extent(picture.system.passes[pass]->resource()).count() /
                                 picture.system.start.extent(*instances).count();
    return fmt::format("{}instance  {} {}, its vertex {}\n", text, picture.system.schema.resources[*instances].item,
                       index / vertices, index % vertices);
}

} // namespace

std::span<const std::string_view> system_check_options() {
    static constexpr std::array<std::string_view, 25> options{
        "--trace",         "--power",     "--power-at-least", "--json",
        "scene",           "--particles", "--preset",         "--set",
        "--threads",       "--gl",        "--shaders",        "--frames",
        "--allow-unused",  "--mode",      "--legal",          "--quiet",
        "--no-render",     "--hashes",    "--images",         "--allow-undefined",
        "--report",        "--hex",       "--werror-shaders", "--reference",
        "--cover-at-least"};
    return options;
}

int check_system(const RegisteredSystem& system, const RunOptions& given, const SystemCheck& asked) {
    RunOptions run = with_folders(system, given);
    if (system.folders != nullptr && (asked.power || asked.rules.power_at_least > 0.0))
        throw Error("check: --power: a check file has no mistakes with names; expected --cover-at-least");
    if (asked.rules.cover_at_least > 0.0 && run.shaders.empty())
        throw Error("check: --cover-at-least goes with shaders of one's own; expected --shaders DIR");
    SystemInput input(system, run, asked.trace, asked.render ? DrawnStages::vertex : DrawnStages::none);
    const System& twins = input.system();
    if (!asked.images.empty() && !input.scene().has_pictures())
        throw Error(fmt::format("check: --images: scenes of system {} have no pictures", system.name));
    OutputFiles files;
    input.protect(files);
    CheckFiles outputs(asked.report, asked.hashes);
    outputs.expect(files);
    if (!asked.images.empty())
        files.expect_folder(asked.images, PicturedFrame::names);
    if (!asked.json.empty())
        files.expect(asked.json);
    SystemSide& side = input.open();
    if (input.is_recorded()) {
        if (!asked.frames_given)
            run.frames = input.recorded_frames();
        if (run.frames > input.recorded_frames())
            throw Error(
                fmt::format("--frames {}: {} holds {} frames", run.frames, input.read().file, input.recorded_frames()));
    }
    CheckOptions options;
    options.mode = asked.mode;
    options.frames = run.frames;
    options.known = known_operations(asked.legal, side.describe().profile);
    CheckWatch watch = outputs.watch(twins, side, run.frames);
    std::vector<TwoRuns> two_runs;
    watch_two_runs(watch, twins, two_runs);
    PicturedFrame pictured;
    if (!asked.images.empty())
        watch.on_frame = [&pictured, hashes = watch.on_frame](int frame, const SystemState& reference,
                                                              const SystemState& gpu) {
            if (hashes)
                hashes(frame, reference, gpu);
            pictured.keep(frame, reference, gpu);
        };
    CheckReport report = check_shown(twins, side, options, asked.quiet, watch);
    ask_power(report, asked.rules.power_at_least);
    note_unset_variables(report, side.describe().warnings);
    DrawnFrame drawn = asked.render && !report.partial() ? judge_drawn(input, side, run, asked, report) : DrawnFrame{};

    RunDescription about =
        describe_run(twins, side.describe(), options, check_line(input, asked, frames_to_repeat(report)));
    about.numbers = number_format(asked.hexadecimal);
    input.describe(about);
    if (about.shaders)
        note_what_ran(*about.shaders);
    for (const std::vector<std::string>& some : {input.left_open(side.describe().profile), run_to_run_notes(two_runs)})
        about.notes.insert(about.notes.end(), some.begin(), some.end());
    if (!input.is_recorded())
        add_text_notes(about, input.shaded(), input.own_texts(), run, side, *options.known, asked.rules, report);
    for (std::string& note :
         reference_notes(input.shaded(), input.reference_texts(), side.describe().profile, report.frames))
        about.notes.push_back(std::move(note));
    about.coverage.insert(about.coverage.end(), drawn.about.coverage.begin(), drawn.about.coverage.end());
    ask_coverage(report, coverage_count(about.coverage), asked.rules.cover_at_least);
    if (input.is_recorded() && run.frames < input.recorded_frames())
        about.notes.push_back(
            fmt::format("{} of the {} frames recorded were compared", run.frames, input.recorded_frames()));
    const auto explain_line = [&](const std::vector<std::string>& words) {
        return input.command("explain", fmt::format("{}", fmt::join(words, " "))) + legal_option_text(asked.legal);
    };
    if (const auto words = first_item_words(twins, report); !words.empty())
        about.explain = explain_line(words);
    if (!drawn.first.empty())
        drawn.about.explain = explain_line(drawn.first);
    if (drawn.report && passes(report, asked.rules) && !passes(*drawn.report, drawn_rules(asked.rules)))
        report.state_verdict = std::exchange(report.verdict, drawn.report->verdict);
    if (!asked.quiet) {
        if (report.interrupted())
            fmt::print("interrupted after {} of {} frames\n", report.frames, run.frames);
        fmt::print("{}{}", colored(plain_text(report_text(report, about))),
                   asked.power ? power_text(report.power) : std::string());
        if (drawn.report)
            fmt::print("{}", colored(plain_text(drawn_text(drawn, asked.rules))));
        std::fflush(stdout);
    }
    CheckFiles::Told told{{{"This run", check_line(input, asked, report.frames)}},
                          explain_line,
                          drawn.report ? drawn_words(drawn) : std::string(),
                          [](const std::filesystem::path& capsule) {
                              return fmt::format("lockstep capsule show {}", shell_path(capsule));
                          }};
    if (frames_to_repeat(report) < report.frames)
        told.commands.push_back({"Up to the first frame that differs", about.repeat});
    if (!about.explain.empty())
        told.commands.push_back({"The first item that differs, step by step", about.explain});
    outputs.write(files, report, about, std::move(told), [&] {
        const FirstDivergence& first = *report.verdicts->first;
        SystemRun again(twins, side, *options.known, first.place.frame, first.pass);
        return capsule_text(input.read(), cut_item_capsule(again, first.place.index, side.describe().name));
    });
    if (!asked.json.empty()) {
        json document = report_json(report, about);
        if (about.shaders)
            document["inputs"] = inputs_json(input_digests());
        if (!two_runs.empty())
            document["run_to_run"] = two_runs;
        if (drawn.report)
            document["drawn"] = report_json(*drawn.report, drawn.about);
        files.write(asked.json, json_text(document));
    }
    if (!asked.images.empty())
        pictured.write(files, asked.images, input.scene(), input.gl(), side.describe().profile, run);
    files.commit();
    if (!asked.quiet)
        fmt::print("{}", files.written_text());
    if (report.interrupted())
        return status_interrupted;
    return passes(report, asked.rules) && (!drawn.report || passes(*drawn.report, drawn_rules(asked.rules)))
               ? status_agree
               : status_differ;
}

int explain_system(const RegisteredSystem& system, const RunOptions& given, const SystemItem& item,
                   const std::filesystem::path& trace) {
    const RunOptions run = with_folders(system, given);
    SystemInput input(system, run, trace, DrawnStages::vertex);
    if (is_drawn(input, item.pass)) {
        fmt::print("{}", explain_drawn(input, run, item));
        return status_agree;
    }
    static_cast<void>(place_of(item, input.system()));
    SystemSide& side = input.open();
    fmt::print("{}", colored(explain_text(input.system(), side, item, input.read().file)));
    return status_agree;
}

int hash_system(const RegisteredSystem& system, const RunOptions& given, const std::string& profile,
                const HashedFrames& frames) {
    const RunOptions run = with_folders(system, given);
    const SystemInput input(system, run, {});
    print_hashes(input.system(), profile, frames);
    return status_agree;
}

int hash_system_on_gpu(const RegisteredSystem& system, const RunOptions& given, const HashedFrames& frames) {
    const RunOptions run = with_folders(system, given);
    SystemInput input(system, run, {});
    print_gpu_hashes(input.system(), input.open(), frames);
    return status_agree;
}

int cut_system(const RegisteredSystem& system, const RunOptions& given, const SystemItem& item,
               const std::filesystem::path& trace, const std::filesystem::path& output) {
    if (system.folders != nullptr)
        throw Error("capsule cut: an item of a check file has no capsule; expected explain, or record and --trace");
    const RunOptions run = with_folders(system, given);
    SystemInput input(system, run, trace);
    static_cast<void>(place_of(item, input.system()));
    OutputFiles files;
    input.protect(files);
    files.expect(output);
    SystemSide& side = input.open();
    const ItemCapsule capsule = cut_item(input.system(), side, item);
    files.write(output, capsule_text(input.read(), capsule));
    files.commit();
    print_cut(files, input.system(), item, capsule);
    return status_agree;
}

namespace {

std::string heading_of(const ReadScene& read, const std::string& gl, const Profile& profile) {
    return run_heading(read.scene.system.name, read.file, read.scene.system.settings, gl, profile);
}

} // namespace

int debug_system(const RegisteredSystem& system, const RunOptions& given, Legal legal, DebugSetup setup,
                 const std::filesystem::path& trace) {
    const RunOptions run = with_folders(system, given);
    if (!trace.empty()) {
        const auto input = std::make_shared<SystemInput>(system, run, trace);
        SystemSide& side = input->open();
        setup.recorded = input->recorded_frames();
        setup.unchangeable = recorded_is_fixed;
        setup.heading = heading_of(input->read(), side.describe().name, side.describe().profile);
        setup.start = [&](const std::vector<std::string>&) {
            return std::make_unique<SystemDebugRun>(std::shared_ptr<const System>(input, &input->system()),
                                                    std::shared_ptr<SystemSide>(input, &side),
                                                    known_operations(legal, side.describe().profile));
        };
        return debug_run(std::move(setup));
    }
    const ReadScene first = read_scene(system, run);
    static_cast<void>(shaders_of(first.scene, run));
    const Gl gl = open_gl(run);
    setup.heading = heading_of(first, gl.name(), gl.profile(run.shaders));
    setup.start = [&](const std::vector<std::string>& changes) {
        RunOptions changed = run;
        changed.set.insert(changed.set.end(), changes.begin(), changes.end());
        const auto read = std::make_shared<ReadScene>(read_scene(system, changed));
        const ShadedSystem shaded{read->scene.system, read->scene.passes, read->scene.arithmetic};
        if (!changed.reference.empty())
            static_cast<void>(
                take_references(shaded, references_of(read->scene, changed), changed.reference, changed.shaders));
        show_texts(shaded, changed.shaders);
        const std::shared_ptr<const System> twins(read, &read->scene.system);
        auto side = std::make_shared<GlSystemSide>(gl, *twins, read->scene.passes, changed.shaders.string(),
                                                   read->scene.arithmetic);
        const KnownOperations known = known_operations(legal, side->describe().profile);
        return std::make_unique<SystemDebugRun>(twins, std::move(side), known);
    };
    return debug_run(std::move(setup));
}

int record_system(const RegisteredSystem& system, const RunOptions& given, const std::filesystem::path& output,
                  int deflate) {
    const RunOptions run = with_folders(system, given);
    SystemInput input(system, run, {});
    OutputFiles files;
    input.protect(files);
    files.expect(output);
    SystemSide& side = input.open();
    RunDescription about = describe_run(input.system(), side.describe(), {}, "");
    input.describe(about);
    return record_run(input.system(), side,
                      {.name = input.system().name,
                       .scene = input.read().document,
                       .options = input.read().options,
                       .shaders = about.shaders ? shaders_text(*about.shaders) : about.shaders_untold,
                       .frames = run.frames},
                      output, deflate);
}

int tell_recording(const RegisteredSystem& system, const std::filesystem::path& file) {
    const RunOptions run;
    SystemInput input(system, run, file);
    SystemSide& side = input.open();
    fmt::print("{}", plain_text(recording_text(input.system(), side, *input.recording())));
    return status_agree;
}

const RegisteredSystem* system_of_recording(const std::filesystem::path& file) {
    const std::string name = recorded_system(file);
    if (name.empty())
        return nullptr;
    std::vector<std::string> names{std::string(default_system)};
    for (const RegisteredSystem& system : registered_systems()) {
        if (system.name == name)
            return &system;
        if (system.name != own_system)
            names.emplace_back(system.name);
    }
    throw Error(
        fmt::format("{}: a recording of system '{}', which is none of lockstep's: {}; the program of that system "
                    "reads it",
                    file.string(), plain_line(name), fmt::join(names, ", ")));
}

std::optional<int> show_system(const std::filesystem::path& file, bool hexadecimal) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        return {};
    const json document = read_json(file);
    const JsonValue value(document, file.string());
    if (!document.is_object() || !value.find("lockstep_system_capsule"))
        return {};
    static_cast<void>(value.at("lockstep_system_capsule").integer(capsule_version, capsule_version));
    value.check_keys({"lockstep_system_capsule", "name", "scene", "options", "capsule"});
    const RegisteredSystem* system = system_of_scene(value.at("scene"));
    if (system == nullptr)
        value.at("scene").fail(fmt::format("is of system {}, whose capsules are others", default_system));
    const SystemScene scene = recorded_scene(*system, value.at("scene").raw(), value.at("options").raw(),
                                             value.at("name").label(), file.string())
                                  .scene;
    const ItemCapsule capsule = read_item_capsule(value.at("capsule"), scene.system);
    fmt::print("{}", colored(shown_text(capsule, scene.system, number_format(hexadecimal))));
    return status_of(capsule, scene.system);
}

} // namespace lockstep
