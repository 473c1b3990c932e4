#include "crosscheck/package/shader_findings.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/judge/dispatch.hpp"
#include "crosscheck/judge/system_run.hpp"
#include "crosscheck/text/covered_text.hpp"
#include "crosscheck/text/pass_text.hpp"
#include "gpu/shader_warnings.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// The first frames: two, and more of small states, since a birth or a death may come late.
int examined_frames(const System& system, int frames) {
    constexpr std::size_t least = 2, items = 100'000;
    const SystemView start = system.start.view();
    std::size_t most = 1;
    for (std::uint8_t r = 0; r < system.schema.resources.size(); ++r)
        most = std::max(most, start[r].count());
    return std::min(frames, static_cast<int>(std::max(least, items / most)));
}

/// The first groups of a dispatch, where neighbours are, and few of the rest.
bool is_sampled(const std::array<std::uint32_t, 3>& group) {
    constexpr std::uint32_t first = 4, every = 61;
    const std::uint32_t place = group[0] + 7 * group[1] + 13 * group[2];
    return (group[0] < first && group[1] < 2 && group[2] < 2) || place % every == 0;
}

std::string line_of(const text::Program& program, const text::Finding& found) {
    std::string line = fmt::format("{}: {}: {}", program.line_name(found.place.line), found.rule, found.what);
    if (found.other && found.other->line != found.place.line)
        line += fmt::format("; the other at {}", program.line_name(found.other->line));
    return line;
}

/// One stage of a scene, and what was found in it so far.
struct WatchedText {
    std::shared_ptr<const PassText> text;
    text::Findings findings;
    text::Coverage coverage;
    std::size_t left = 0;       ///< invocations that may run for the coverage alone
    int sampled = 0, whole = 0; ///< frames of which groups ran, or all
};

/// Runs all of a dispatch for the coverage, unless it takes more than is left of the text's invocations.
void run_plainly(WatchedText& text, const PassInput& in, const Profile& profile, SystemState& after) {
    const std::size_t items = text.text->items(in);
    if (text.left < items || std::ranges::any_of(text.findings.all(), text::is_endless)) {
        text.left = 0;
        return;
    }
    text.left -= items;
    text::Findings ignored;
    try {
        text.text->run(in, profile, after, ignored, {.coverage = &text.coverage});
        ++text.whole;
    } catch (const text::DoesNotEnd&) {
        text.left = 0;
    }
}

/// By stage: a shader of several passes is one.
std::vector<TextCoverage> coverage_of(const std::vector<WatchedText>& texts, const std::filesystem::path& folder) {
    std::vector<TextCoverage> all;
    for (const WatchedText& one : texts) {
        if (one.text == nullptr || one.sampled + one.whole == 0)
            continue;
        TextCoverage made = covered_text(one.text->source(), one.text->program(), one.coverage, folder);
        if (made.lines.empty())
            continue;
        const std::string frames = counted(static_cast<std::size_t>(one.whole > 0 ? one.whole : one.sampled), "frame");
        made.in = one.whole > 0 ? frames : "some groups of " + frames;
        if (const auto known = std::ranges::find(all, made.stage, &TextCoverage::stage); known != all.end())
            known->add(made);
        else
            all.push_back(std::move(made));
    }
    return all;
}

} // namespace

void add_notes(RunDescription& run, TextNotes notes) {
    std::ranges::move(notes.lines, std::back_inserter(run.notes));
    std::ranges::move(notes.coverage, std::back_inserter(run.coverage));
}

TextNotes shader_findings(const ShadedSystem& of, const OwnTexts& own,
                          const std::optional<std::filesystem::path>& shaders, const Profile& profile, int frames,
                          CoveredRuns covered) {
    const System& system = of.system;
    const ShaderFolders folders = shader_folders(shaders.value_or(""), system.schema.system);
    std::vector<WatchedText> texts(of.passes.size());
    std::vector<std::string> lines;
    for (std::size_t p = 0; p < of.passes.size(); ++p)
        if (!of.passes[p].draws_vertices() && !of.passes[p].continues && (own[p] || shaders))
            try {
                texts[p].text = own[p]
                                    ? own[p]
                                    : std::make_shared<const PassText>(system.schema, of.passes[p],
                                                                       written_by(system, p), folders, of.arithmetic);
                texts[p].coverage = text::Coverage(texts[p].text->program());
                if (shaders)
                    texts[p].left = covered == CoveredRuns::all ? 2'000'000 : 20'000;
            } catch (const Error& error) {
                lines.push_back(fmt::format("text of {}{} not looked into: {}", of.passes[p].name,
                                            extension(of.passes[p].stage), error.what()));
            }
    if (std::none_of(texts.begin(), texts.end(), [](const WatchedText& one) { return one.text != nullptr; }))
        return {lines, {}, {}};
    ReferenceRun run(system, profile);
    const int looked_at = examined_frames(system, frames);
    const auto goes_on = [](const WatchedText& one) { return one.text != nullptr && one.left > 0; };
    const auto is_asked = [&](int frame) {
        return covered == CoveredRuns::all && frame < frames && std::ranges::any_of(texts, goes_on);
    };
    for (int frame = 0; frame < looked_at || is_asked(frame); ++frame)
        for (std::size_t p = 0; p < of.passes.size(); ++p) {
            WatchedText& watched = texts[p];
            if (watched.text != nullptr && system.passes[p]->runs(frame)) {
                const SystemView view = run.state().view();
                const PassInput in{view, frame};
                SystemState after = run.state();
                bool is_whole = true;
                const auto wants = [&](const std::array<std::uint32_t, 3>& group) {
                    const bool is = is_sampled(group);
                    is_whole = is_whole && is;
                    return is;
                };
                if (frame < looked_at) {
                    watched.text->run(in, profile, after, watched.findings,
                                      {.wants = wants, .is_watched = true, .coverage = &watched.coverage});
                    ++(is_whole ? watched.whole : watched.sampled);
                }
                if (watched.left > 0 && (frame >= looked_at || !is_whole))
                    run_plainly(watched, in, profile, after = run.state());
            }
            run.step_pass(p, frame);
        }
    std::vector<ShortFinding> in_short;
    for (std::size_t p = 0; p < texts.size(); ++p)
        for (const text::Finding& found : texts[p].findings.all()) {
            const text::Program& program = texts[p].text->program();
            lines.push_back(line_of(program, found));
            in_short.push_back({program.line_name(found.place.line), found.rule, text::is_race(found), p});
        }
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    return {std::move(lines), std::move(in_short),
            shaders ? coverage_of(texts, *shaders) : std::vector<TextCoverage>()};
}

std::vector<std::string> reference_notes(const ShadedSystem& of, const OwnTexts& references, const Profile& profile,
                                         int frames) {
    std::vector<std::string> notes;
    if (!references.empty())
        for (const std::string& found :
             shader_findings(of, references, std::nullopt, profile, frames, CoveredRuns::watched).lines)
            notes.push_back("in the reference: " + found);
    return notes;
}

namespace {

/// What passed may not the next time, or elsewhere, where the shader's text does what GLSL gives no result for.
void limit_verdict(CheckReport& report, const std::vector<ShortFinding>& findings) {
    const auto race = std::ranges::find(findings, true, &ShortFinding::is_race);
    const auto first = race != findings.end() ? race : findings.begin();
    if (first == findings.end() || std::ranges::any_of(report.untried, [&](const std::string& known) {
            return known.starts_with(first->place + " ");
        }))
        return;
    report.fails_by_text = shader_warnings_are_errors();
    (report.fails_by_text ? report.failures : report.untried)
        .push_back(first->is_race ? fmt::format("{} races with another invocation", first->place)
                                  : fmt::format("{} has a result that GLSL leaves open: {}", first->place,
                                                first->rule.substr(0, first->rule.find(" (GL"))));
}

/// Whether the reference of a pass is the text that the GPU runs: where that text leaves something open, a difference
/// says nothing else.
bool is_own_reference(const ShadedSystem& of, const OwnShaders& own, std::size_t pass) {
    return own.texts[pass] != nullptr && !own.reference.empty() &&
           own.texts[pass]->is_text_of(shader_folders(own.reference, of.system.schema.system));
}

} // namespace

TextNotes text_notes(const ShadedSystem& of, const OwnShaders& own, DivergentPass& divergence, CheckReport& report,
                     CoveredRuns covered) {
    TextNotes notes =
        shader_findings(of, own.texts, own.folder, divergence.side().describe().profile, report.frames, covered);
    std::vector<ShortFinding> limiting = notes.findings;
    if (report.verdict != Verdict::agree && report.verdict != Verdict::legal)
        std::erase_if(limiting, [&](const ShortFinding& one) { return !is_own_reference(of, own, one.pass); });
    limit_verdict(report, limiting);
    for (const std::string& line : lines_without_counterpart(of, own.texts, own.use, own.reference, divergence))
        notes.lines.push_back("without a counterpart in the reference: " + line);
    return notes;
}

} // namespace lockstep
