#include "crosscheck/package/item_verbs.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/command/exit_status.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/command/session_input.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/signals.hpp"
#include "crosscheck/judge/dispatch.hpp"
#include "crosscheck/judge/item_place.hpp"
#include "crosscheck/judge/pass_names.hpp"
#include "crosscheck/report/hash_lines.hpp"
#include "crosscheck/report/item_text.hpp"
#include "crosscheck/report/page/template.hpp"
#include "crosscheck/report/progress.hpp"
#include "crosscheck/report/verdict_text.hpp"
#include "crosscheck/scene/profile_text.hpp"
#include "gpu/system_side.hpp"
#include "reference/model/error.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep {
namespace {

constexpr std::array<std::string_view, 2> report_files{"report.html", "capsule.json"};

/// The one that is named, or else the first that runs in the frame.
std::size_t asked_pass(const SystemItem& item, const System& system) {
    for (std::size_t p = 0; item.pass.empty() && p < system.passes.size(); ++p)
        if (system.passes[p]->runs(item.frame))
            return p;
    return pass_named(item.pass, system, item.frame, "--pass");
}

std::string heading(const System& system, const std::string& file, const std::string& gl, const Profile& profile) {
    return run_heading(system.name, file, system.settings, gl, profile) + "\n";
}

void go_to(SystemRun& run, const SystemItem& item, std::size_t pass) {
    Progress progress("explain", item.frame, true);
    run.go_to(item.frame, pass, [&](int frame) { progress.show(frame); });
}

} // namespace

Option frame_option(int& frame) {
    return required(integer_option("--frame", "F", {0, most_frames}, frame, "the frame, counted from 0"));
}

Option pass_option(std::string& pass) {
    return text_option("--pass", "NAME", pass,
                       "the pass that makes the item, or its number where several "
                       "have a name; without it the first that runs in the frame");
}

Option hex_option(bool& hexadecimal) {
    return flag("--hex", hexadecimal, "hexadecimal floats instead of decimal ones");
}

std::string run_heading(const std::string& scene, const std::string& file, const std::string& settings,
                        const std::string& gl, const Profile& profile) {
    return fmt::format("scene     {}{}\nswitches  {}\nGL        {}\nprofile   {}\n", scene,
                       file.empty() ? "" : fmt::format(" ({})", plain_line(file)), settings.empty() ? "none" : settings,
                       plain_line(gl), describe(profile));
}

ItemPlace place_of(const SystemItem& item, const System& system) {
    const std::size_t pass = asked_pass(item, system);
    const std::uint8_t resource = system.passes[pass]->resource();
    return {pass, item_named(plain_line(item.item), system.schema.resources[resource], system.start.extent(resource),
                             system.name)};
}

std::string explain_text(const System& system, SystemSide& side, const SystemItem& item, const std::string& file) {
    const auto [pass, index] = place_of(item, system);
    const SideDescription about = side.describe();
    SystemRun run(system, side, known_operations(item.legal, about.profile));
    go_to(run, item, pass);
    return heading(system, file, about.name, about.profile) +
           plain_text(explain_item(run, index, number_format(item.hexadecimal)));
}

std::string explain_drawn_text(const System& picture, SystemSide& drawn, const SystemItem& item,
                               const std::string& file) {
    const auto [pass, index] = place_of(item, picture);
    const SideDescription about = drawn.describe();
    SystemRun run(picture, drawn, known_operations(item.legal, about.profile), 0, pass);
    JudgedPass of_frame = run.judged();
    of_frame.frame = item.frame;
    return heading(picture, file, about.name, about.profile) +
           plain_text(explain_item(of_frame, index, run.told(index), number_format(item.hexadecimal)));
}

ItemCapsule cut_item(const System& system, SystemSide& side, const SystemItem& item) {
    const auto [pass, index] = place_of(item, system);
    const SideDescription about = side.describe();
    SystemRun run(system, side, known_operations(item.legal, about.profile));
    go_to(run, item, pass);
    return cut_item_capsule(run, index, about.name);
}

void print_cut(const OutputFiles& files, const System& system, const SystemItem& item, const ItemCapsule& capsule) {
    const auto [pass, index] = place_of(item, system);
    const std::uint8_t resource = system.passes[pass]->resource();
    fmt::print("{}holds     {} of frame {}, pass {}: {}\n", files.written_text(),
               item_name(system.schema.resources[resource], system.start.extent(resource), index), item.frame,
               system.passes[pass]->name(), class_names[static_cast<std::size_t>(judge(capsule, system).kind)]);
}

std::string shown_text(const ItemCapsule& capsule, const System& system, NumberFormat format) {
    return heading(system, "", capsule.renderer, capsule.profile) +
           plain_text(item_capsule_text(capsule, system, format));
}

int status_of(const ItemCapsule& capsule, const System& system) {
    return judge(capsule, system).kind >= DifferenceClass::undefined ? status_differ : status_agree;
}

std::vector<std::string> first_item_words(const System& system, const CheckReport& report) {
    if (!report.verdicts || !report.verdicts->first)
        return {};
    const Place& place = report.verdicts->first->place;
    return {"--frame",
            std::to_string(place.frame),
            "--pass",
            pass_argument(system, report.verdicts->first->pass, place.frame),
            "--item",
            item_argument(system.schema.resources[place.resource], system.start.extent(place.resource), place.index)};
}

void print_hashes(const System& system, const std::string& profile, const HashedFrames& frames) {
    ReferenceRun reference(system, named_profile(profile));
    print_hash_lines(frames, [&](int frame, bool shown) {
        reference.step(frame);
        return shown ? reference.hash() : 0;
    });
}

namespace {

/// Of each pass whether it runs before the first frame that is shown.
std::vector<bool> leading(const System& system, const std::vector<std::string>& lead_in) {
    std::vector<bool> found(system.passes.size(), lead_in.empty());
    for (const std::string& name : lead_in)
        found[pass_named(name, system, 0, "--lead-in")] = true;
    return found;
}

} // namespace

void print_gpu_hashes(const System& system, SystemSide& side, const HashedFrames& frames) {
    const std::vector<bool> leads = leading(system, frames.lead_in);
    SystemState state = system.start;
    side.upload(std::as_const(state).view());
    print_hash_lines(frames, [&](int frame, bool shown) -> std::uint64_t {
        for (std::size_t p = 0; p < system.passes.size(); ++p)
            if (system.passes[p]->runs(frame) && !system.passes[p]->continues() && (leads[p] || frame >= frames.first))
                side.step(p, frame);
        if (!shown)
            return 0;
        side.read(state);
        return state_hash(state);
    });
}

CheckReport check_shown(const System& system, SystemSide& side, CheckOptions options, bool quiet,
                        const CheckWatch& watch) {
    const InterruptHandler handler;
    Progress progress("check", options.frames, !quiet);
    options.stop = &interrupted;
    options.on_frame = [&](int done) { progress.show(done); };
    return check(system, side, options, watch);
}

namespace {

/// "500 grains, 1 count, 8 x 4 texels"
std::string sizes_text(const System& system) {
    std::string text;
    for (std::uint8_t r = 0; r < system.schema.resources.size(); ++r) {
        const Resource& about = system.schema.resources[r];
        const Extent extent = system.start.extent(r);
        std::string count = grouped(extent.width);
        if (about.dimensions > 1)
            count = fmt::format("{} x {}{}", extent.width, extent.height,
                                about.dimensions > 2 ? fmt::format(" x {}", extent.depth) : "");
        text += fmt::format("{}{} {}{}", r == 0 ? "" : ", ", count, about.item, extent.count() == 1 ? "" : "s");
    }
    return text;
}

} // namespace

int record_run(const System& system, SystemSide& side, SystemRunInfo info, const std::filesystem::path& output,
               int deflate) {
    const SideDescription about = side.describe();
    info.settings = system.settings.empty() ? "none" : system.settings;
    info.renderer = about.name;
    info.profile = about.profile;
    SystemRecorder recorder(output, system, info, deflate);
    {
        const InterruptHandler handler;
        Progress progress("record", info.frames, true);
        run_gpu(system, side, info.frames, [&](std::size_t pass, int frame, const SystemState& state) {
            recorder.add(pass, frame, state);
            progress.show(frame + 1);
            return !interrupted;
        });
    }
    if (interrupted) {
        fmt::print(stderr, "interrupted: nothing was recorded\n");
        return status_interrupted;
    }
    recorder.commit();
    fmt::print("{}: {}, {} frames, {} bytes; {}\n", plain_line(output.string()), sizes_text(system), info.frames,
               grouped(std::filesystem::file_size(output)), plain_line(info.renderer));
    return status_agree;
}

std::string recording_text(const System& system, SystemSide& side, const SystemRecording& recording) {
    const SystemRunInfo& info = recording.info();
    side.upload(system.start.view());
    for (int frame = 0; frame < recording.frames(); ++frame)
        for (std::size_t p = 0; p < system.passes.size(); ++p)
            side.step(p, frame);
    std::string text = fmt::format(
        "{:<10}{}: {} bytes, sealed, every value read\n{:<10}{}\n{:<10}{} ({}): {}, {} frames\n", "recording",
        recording.file(), grouped(std::filesystem::file_size(recording.file())), "program", recording.program(),
        "scene", info.name, system.schema.system, sizes_text(system), recording.frames());
    const auto line = [&](std::string_view key, const std::string& value) {
        text += fmt::format("{:<10}{}\n", key, plain_line(value));
    };
    line("switches", info.settings);
    line("GL", info.renderer);
    line("shaders", info.shaders);
    line("profile", describe(info.profile));
    for (const std::string& warning : recording.warnings())
        line("warning", warning);
    return text;
}

int debug_run(DebugSetup setup) {
    setup.stop = [] { return interrupted.load(); };
    setup.say = print_lines;
    DebugSession session(std::move(setup));
    obey_input({.opening = session.opening(),
                .obey = [&](const std::string& line) { return session.obey(line); },
                .ended = [&] { return session.ended(); },
                .complete = [&](const std::string& line) { return session.completions(line); }});
    return status_agree;
}

CheckFiles::CheckFiles(std::filesystem::path report, std::filesystem::path hashes)
    : report_(std::move(report)), hashes_(std::move(hashes)) {}

void CheckFiles::expect(OutputFiles& files) {
    if (!report_.empty())
        files.expect_folder(report_, report_files);
    if (!hashes_.empty())
        files.expect(hashes_);
    if (!report_.empty())
        template_ = report_page_template();
}

CheckWatch CheckFiles::watch(const System& system, SystemSide& side, int frames) {
    CheckWatch watch;
    if (!report_.empty()) {
        page_.emplace(system, side, frames);
        watch.on_pass = [this](const CheckedPass& checked) { page_->add(checked); };
    }
    if (!hashes_.empty())
        watch.on_frame = [this](int frame, const SystemState& reference, const SystemState& gpu) {
            hash_lines_ +=
                fmt::format("{} {} {}\n", frame, hash_text(state_hash(reference)), hash_text(state_hash(gpu)));
        };
    return watch;
}

void CheckFiles::write(OutputFiles& files, const CheckReport& report, RunDescription run, Told told,
                       const std::function<std::string()>& capsule) {
    if (!hashes_.empty())
        files.write(hashes_, hash_lines_);
    if (!page_)
        return;
    if (report.verdicts && report.verdicts->first &&
        report.verdicts->first->verdict.kind == DifferenceClass::divergent) {
        const std::filesystem::path file = report_ / report_files[1];
        try {
            files.write(file, capsule());
            told.commands.push_back(
                {"The first divergent item's step, from the file beside this page; needs no GL", told.show(file)});
        } catch (const Error& error) {
            run.notes.push_back(fmt::format("no capsule of the first divergent item: {}", error.what()));
            fmt::print(stderr, "note: {}\n", plain_line(run.notes.back()));
        }
    }
    files.write(report_ / report_files[0],
                page_->text(template_, report, run, told.commands, told.explain, told.drawn));
}

} // namespace lockstep
