#include "crosscheck/cli/system_verbs.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/system_run.hpp"
#include "crosscheck/collision/record/capsule.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/shell_words.hpp"
#include "crosscheck/files/signals.hpp"
#include "crosscheck/judge/system_check.hpp"
#include "crosscheck/record/capsule_parts.hpp"
#include "crosscheck/record/item_capsule.hpp"
#include "crosscheck/report/item_text.hpp"
#include "crosscheck/report/power_text.hpp"
#include "crosscheck/report/progress.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

constexpr int capsule_version = 1;

/// A whole number that is all of a word.
std::optional<std::size_t> number(std::string_view text) {
    std::size_t value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    return status == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// The first that runs in the frame where none is named.
std::size_t pass_named(const std::string& name, const System& system, int frame) {
    std::vector<std::string> names;
    for (const auto& pass : system.passes) {
        if (name.empty() && pass->runs(frame))
            return names.size();
        names.emplace_back(pass->name());
    }
    if (const auto found = std::find(names.begin(), names.end(), name); found != names.end())
        return static_cast<std::size_t>(found - names.begin());
    if (const auto place = number(name); place && *place < names.size())
        return *place;
    throw Error(fmt::format("--pass: there is no pass '{}'; there are {}{}", plain_line(name), fmt::join(names, ", "),
                            did_you_mean(name, names)));
}

std::size_t item_named(const std::string& text, const SystemScene& scene, std::size_t pass) {
    const std::uint8_t resource = scene.system.passes[pass]->resource();
    const std::size_t count = scene.system.start.extent(resource).count();
    const auto item = number(text);
    if (!item || *item >= count)
        throw Error(fmt::format("--item: there is no {} '{}'; {} has 0 to {}",
                                scene.system.schema.resources[resource].item, plain_line(text), scene.system.name,
                                count - 1));
    return *item;
}

NumberFormat format(bool hexadecimal) { return hexadecimal ? NumberFormat::hexadecimal : NumberFormat::decimal; }

std::string check_line(const RunOptions& run, const SystemCheck& asked, int frames) {
    return command_line("check", run, frames) + (asked.mode == CheckMode::free ? " --mode free" : "") +
           legal_option_text(asked.legal) + pass_options_text(asked.rules);
}

CheckReport run_both(const System& system, SystemSide& side, CheckOptions options, bool quiet) {
    const InterruptHandler handler;
    Progress progress("check", options.frames, !quiet);
    options.stop = &interrupted;
    options.on_frame = [&](int done) { progress.show(done); };
    return check(system, side, options);
}

/// What the last frame draws.
struct DrawnFrame {
    std::optional<CheckReport> report;
    RunDescription about;
    int frame = 0;
    std::size_t items = 0;
};

/// From the state that the GPU's frames left.
DrawnFrame judge_drawn(const SystemScene& scene, const Gl& gl, const GlSystemSide& side, const RunOptions& run,
                       const SystemCheck& asked, const CheckReport& report) {
    if (!scene.picture)
        return {};
    SystemState state = scene.system.start;
    side.read(state);
    const int frame = report.frames - 1;
    const SystemPicture picture = scene.picture(state, frame);
    GlSystemSide drawn = side_of(gl, picture, scene, run);
    CheckOptions options;
    options.frames = 1;
    options.known = known_operations(asked.legal, drawn.describe().profile);
    RunDescription about =
        describe_run(picture.system, drawn.describe(), options, check_line(run, asked, report.frames));
    about.scene = fmt::format("what frame {} of {} draws", frame, scene.system.name);
    const std::size_t items = picture.system.start.extent(picture.system.passes.front()->resource()).count();
    return {check(picture.system, drawn, options), std::move(about), frame, items};
}

/// A frame's picture has little power of its own.
PassRules drawn_rules(PassRules rules) {
    rules.power_at_least = 0.0;
    return rules;
}

std::string drawn_text(const DrawnFrame& drawn, const PassRules& rules) {
    const CheckReport& report = *drawn.report;
    if (!passes(report, drawn_rules(rules)))
        return "\n" + report_text(report, drawn.about);
    return fmt::format("drawn     {}: {} {}s that frame {} draws; coverage and blending are not judged\n",
                       verdict_words(report), drawn.items, report.schema.resources.back().item, drawn.frame);
}

int status_of(const ItemCapsule& capsule, const System& system) {
    return judge(capsule, system).kind >= DifferenceClass::undefined ? status_differ : status_agree;
}

} // namespace

std::span<const std::string_view> system_check_options() {
    static constexpr std::array<std::string_view, 17> options{"--power",   "--power-at-least", "--json",
                                                              "scene",     "--particles",      "--preset",
                                                              "--set",     "--threads",        "--gl",
                                                              "--shaders", "--frames",         "--allow-unused",
                                                              "--mode",    "--legal",          "--allow-undefined",
                                                              "--quiet",   "--no-render"};
    return options;
}

int check_system(const RegisteredSystem& system, const RunOptions& run, const SystemCheck& asked) {
    const ReadScene read = read_scene(system, run);
    const System& twins = read.scene.system;
    OutputFiles files;
    files.protect(run.scene);
    files.protect(run.shaders);
    if (!asked.json.empty())
        files.expect(asked.json);
    ShaderUse shaders = shaders_of(read.scene, run);
    const Gl gl = open_gl(run);
    GlSystemSide side = side_of(gl, read.scene, run);
    CheckOptions options;
    options.mode = asked.mode;
    options.frames = run.frames;
    options.known = known_operations(asked.legal, side.describe().profile);
    CheckReport report = run_both(twins, side, options, asked.quiet);
    ask_power(report, asked.rules.power_at_least);

    const int frames = report.first_frame ? *report.first_frame + 1 : report.frames;
    RunDescription about = describe_run(twins, side.describe(), options, check_line(run, asked, frames));
    about.scene = fmt::format("{} ({})", twins.name, plain_line(read.file));
    about.shaders = std::move(shaders);
    if (report.verdicts && report.verdicts->first) {
        const auto& first = *report.verdicts->first;
        about.explain = command_line("explain", run,
                                     fmt::format("--frame {} --pass {} --item {}", first.place.frame,
                                                 twins.passes[first.pass]->name(), first.place.index)) +
                        legal_option_text(asked.legal);
    }
    const DrawnFrame drawn =
        asked.render && !report.partial() ? judge_drawn(read.scene, gl, side, run, asked, report) : DrawnFrame{};
    if (!asked.quiet) {
        if (report.partial())
            fmt::print("interrupted after {} of {} frames\n", report.frames, run.frames);
        fmt::print("{}{}", plain_text(report_text(report, about)),
                   asked.power ? power_text(report.power) : std::string());
        if (drawn.report)
            fmt::print("{}", plain_text(drawn_text(drawn, asked.rules)));
    }
    if (!asked.json.empty()) {
        json document = report_json(report, about);
        if (drawn.report)
            document["drawn"] = report_json(*drawn.report, drawn.about);
        files.write(asked.json, json_text(document));
    }
    files.commit();
    if (report.partial())
        return status_interrupted;
    return passes(report, asked.rules) && (!drawn.report || passes(*drawn.report, drawn_rules(asked.rules)))
               ? status_agree
               : status_differ;
}

int explain_system(const RegisteredSystem& system, const RunOptions& run, const SystemItem& item) {
    const ReadScene read = read_scene(system, run);
    const std::size_t pass = pass_named(item.pass, read.scene.system, item.frame);
    const std::size_t index = item_named(item.item, read.scene, pass);
    static_cast<void>(shaders_of(read.scene, run));
    const Gl gl = open_gl(run);
    GlSystemSide side = side_of(gl, read.scene, run);
    const Profile profile = side.describe().profile;
    SystemRun both(read.scene.system, side, known_operations(item.legal, profile), item.frame, pass);
    fmt::print("scene     {} ({})\nswitches  {}\nGL        {}\nprofile   {}\n\n{}", read.scene.system.name,
               plain_line(read.file), read.scene.system.settings, plain_line(gl.name()), describe(profile),
               plain_text(explain_item(both, index, format(item.hexadecimal))));
    return status_agree;
}

int hash_system(const RegisteredSystem& system, const RunOptions& run, const std::string& profile, bool every) {
    const ReadScene read = read_scene(system, run);
    ReferenceRun reference(read.scene.system, named_profile(profile));
    for (int frame = 0; frame < run.frames; ++frame) {
        reference.step(frame);
        if (every || frame + 1 == run.frames)
            fmt::print("{} {}\n", frame, hash_text(reference.hash()));
    }
    return status_agree;
}

int cut_system(const RegisteredSystem& system, const RunOptions& run, const SystemItem& item,
               const std::filesystem::path& output) {
    const ReadScene read = read_scene(system, run);
    const System& twins = read.scene.system;
    const std::size_t pass = pass_named(item.pass, twins, item.frame);
    const std::size_t index = item_named(item.item, read.scene, pass);
    OutputFiles files;
    files.protect(run.scene);
    files.protect(run.shaders);
    files.expect(output);
    static_cast<void>(shaders_of(read.scene, run));
    const Gl gl = open_gl(run);
    GlSystemSide side = side_of(gl, read.scene, run);
    SystemRun both(twins, side, known_operations(item.legal, side.describe().profile), item.frame, pass);
    const ItemCapsule capsule = cut_item_capsule(both, index, gl.name());
    json options{{"set", run.set}};
    if (run.particles)
        options["particles"] = *run.particles;
    if (run.preset)
        options["preset"] = *run.preset;
    const json document{{"lockstep_system_capsule", capsule_version},
                        {"name", twins.name},
                        {"scene", read.document},
                        {"options", options},
                        {"capsule", json::parse(item_capsule_file(capsule, twins))}};
    std::string text = document.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
    if (text.size() > largest_capsule)
        throw Error(fmt::format("its capsule would be {} bytes, with the scene; right is at most {}", text.size(),
                                largest_capsule));
    files.write(output, text);
    files.commit();
    return status_of(capsule, twins);
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
    SceneOptions options;
    const JsonValue given = value.at("options");
    given.check_keys({"set", "particles", "preset"});
    for (const JsonValue& change : given.at("set").items())
        options.set.push_back(change.text());
    if (const auto count = given.find("particles"))
        options.particles = static_cast<std::size_t>(count->integer(1, most_particles));
    if (const auto preset = given.find("preset"))
        options.preset = preset->text();
    const SystemScene scene = system->load(value.at("scene"), value.at("name").label(), options);
    const ItemCapsule capsule = read_item_capsule(value.at("capsule"), scene.system);
    fmt::print("scene     {}\nGL        {}\nprofile   {}\n\n{}", scene.system.name, plain_line(capsule.renderer),
               describe(capsule.profile), plain_text(item_capsule_text(capsule, scene.system, format(hexadecimal))));
    return status_of(capsule, scene.system);
}

} // namespace lockstep
