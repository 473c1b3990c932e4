#include <fstream>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/collision/judge/side_state.hpp"
#include "crosscheck/collision/report/frame_images.hpp"
#include "crosscheck/files/shell_words.hpp"
#include "crosscheck/files/threads.hpp"
#include "crosscheck/package/folded_text.hpp"
#include "crosscheck/report/places.hpp"
#include "crosscheck/report/shader_notes.hpp"
#include "crosscheck/scene/fragment_stages.hpp"
#include "crosscheck/scene/profile_text.hpp"
#include "crosscheck/scene/run_text.hpp"
#include "lockstep/lockstep.hpp"

namespace lockstep {
namespace {

constexpr std::size_t most_lines = 58; // of 60, two are the caller's: a heading

/// What this program was called with, after its name.
std::vector<std::string> own_arguments() {
    std::ifstream stream("/proc/self/cmdline", std::ios::binary);
    std::vector<std::string> words;
    for (std::string word; std::getline(stream, word, '\0');)
        words.push_back(word);
    if (!words.empty())
        words.erase(words.begin());
    return words;
}

PassRules rules(const MatchOptions& options) {
    return {options.allow_undefined, options.require_hits, options.power_at_least};
}

/// The lines that lead back to what differs.
class CommandLines {
  public:
    CommandLines(const Scene& scene, const SideDescription& side, const MatchOptions& options)
        : scene_(scene), side_(side), options_(options) {}

    [[nodiscard]] std::string repeat(const CheckReport& report) const {
        if (!program_can())
            return options_.repeat.empty() ? this_program(own_arguments()) : options_.repeat;
        return fmt::format("lockstep check {} --frames {}{}{}{}{}{}", scene_.origin, frames_to_repeat(report),
                           *side_.arguments, options_.mode == CheckMode::free ? " --mode free" : "",
                           legal_option_text(options_.legal), options_.render ? " --render" : "",
                           pass_options_text(rules(options_)));
    }

    [[nodiscard]] std::string explain(const CheckReport& report) const {
        const std::string first = first_arguments(report, scene_.width);
        if (!program_can() || first.empty())
            return "";
        return fmt::format("lockstep explain {} {}{}{}", scene_.origin, first, *side_.arguments,
                           legal_option_text(options_.legal));
    }

  private:
    [[nodiscard]] bool program_can() const { return !scene_.origin.empty() && side_.arguments; }

    const Scene& scene_;
    const SideDescription& side_;
    const MatchOptions& options_;
};

} // namespace

std::string this_program(const std::vector<std::string>& arguments) {
    std::string line = fmt::format("cd {} && {}", shell_word(std::filesystem::current_path().string()),
                                   shell_word(std::filesystem::read_symlink("/proc/self/exe").string()));
    for (const std::string& argument : arguments)
        line += fmt::format(" {}", shell_word(argument));
    return line;
}

MatchResult::MatchResult(CheckReport report, RunDescription run, bool passed)
    : report_(std::move(report)), run_(std::move(run)), passed_(passed) {}

std::string MatchResult::text(std::size_t width) const {
    const std::string text = report_text(report_, run_);
    return width == 0 ? text : folded_text(text, width, most_lines);
}

std::string MatchResult::verdict() const { return line_of(report_text(report_, run_), "verdict"); }

std::string MatchResult::failure(std::size_t width) const {
    const std::string text = failure_first(report_text(report_, run_));
    return width == 0 ? text : folded_text(text, width, most_lines);
}

MatchResult match_reference(GpuSide& gpu, const Scene& scene, const MatchOptions& options) {
    have_waiting_threads_sleep_soon();
    const auto* shaders = dynamic_cast<const UserShaders*>(&gpu);
    if (options.render && shaders == nullptr)
        throw Error("render: an engine of its own draws no frame that could be compared; UserShaders do");
    if (!(options.power_at_least >= 0.0 && options.power_at_least <= 1.0))
        throw Error(fmt::format("power_at_least({}): a share is from 0 to 1, as 0.95", options.power_at_least));
    SideDescription side = gpu.describe();
    if (shaders != nullptr)
        side.profile = with_written_codes(side.profile, scene, shaders->folder());
    CheckOptions check_options;
    check_options.mode = options.mode;
    check_options.frames = options.frames;
    check_options.known = known_operations(options.legal, side.profile);
    CheckReport report = check(scene, side.profile, gpu, check_options);

    ask_power(report, options.power_at_least);
    ask_hits(report, rules(options));
    note_unset_variables(report, side.warnings);
    const CommandLines commands(scene, side, options);
    RunDescription run{fmt::format("{} ({})", scene.name, scene.origin.empty() ? "made in code" : scene.origin),
                       side.name,
                       lockstep::describe(side.profile),
                       switches_text(scene),
                       options.mode == CheckMode::free ? "free" : "resync",
                       commands.repeat(report),
                       commands.explain(report),
                       conversion_notes(side.profile, scene.switches),
                       side.shaders};
    for (std::string& note : warning_notes(side.warnings))
        run.notes.push_back(std::move(note));
    if (options.render) {
        Particles last;
        read_side(gpu, scene, last);
        add_rendered(report, judge_rendered(last, nullptr, scene, report.frames - 1, side.profile, *check_options.known,
                                            shaders->folder()));
        run.explain = commands.explain(report);
    }
    const bool passed = passes(report, rules(options));
    return {std::move(report), std::move(run), passed};
}

} // namespace lockstep
