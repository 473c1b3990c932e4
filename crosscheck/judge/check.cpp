#include "crosscheck/judge/check.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/text/text_coverage.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

void note_difference(CheckReport& report, int frame, const Comparison& comparison) {
    const std::int64_t worst = comparison.worst.empty() ? 0 : comparison.worst.front().ulp;
    if (report.counts.empty() || report.counts.back().frame != frame)
        report.counts.push_back({frame, std::vector<std::uint64_t>(report.schema.resources.size()), 0});
    FrameCount& counts = report.counts.back();
    counts.worst_ulp = std::max(counts.worst_ulp, worst);
    for (std::uint8_t r = 0; r < report.schema.resources.size(); ++r)
        counts.items[r] += comparison.differing(r);
    if (comparison.agree() || report.first_frame)
        return;
    report.first_frame = frame;
    for (const Difference& difference : comparison.worst)
        report.worst.push_back({frame, difference});
}

void number_frame(CheckReport& report, int frame) {
    report.first = frame;
    if (report.first_frame)
        report.first_frame = frame;
    for (FrameDifference& difference : report.worst)
        difference.frame = frame;
    for (FrameCount& counts : report.counts)
        counts.frame = frame;
    for (PowerSummary::Mistake& mistake : report.power.mistakes)
        if (mistake.first_frame)
            mistake.first_frame = frame;
    if (!report.verdicts)
        return;
    for (std::optional<FirstDivergence>* first : {&report.verdicts->first, &report.verdicts->first_beyond_rounding})
        if (*first)
            (*first)->place.frame = frame;
    for (auto& [kind, ties] : report.verdicts->ties)
        ties.closest.frame = frame;
    for (int& divergent : report.verdicts->divergent_frames)
        divergent = frame;
}

Verdict verdict_on(const CheckReport& report) {
    if (report.total.agree())
        return Verdict::agree;
    if (!report.verdicts)
        return Verdict::differ;
    if (report.verdicts->total(DifferenceClass::divergent) > 0)
        return Verdict::divergent;
    return report.verdicts->total(DifferenceClass::undefined) > 0 ? Verdict::undefined : Verdict::legal;
}

void ask_power(CheckReport& report, double at_least) {
    if (at_least <= 0.0 || report.verdict == Verdict::nondeterministic)
        return;
    if (!report.verdicts)
        throw Error("power: only steps that are judged can show mistakes; use mode resync");
    if (report.power.share() < at_least && report.verdict != Verdict::divergent)
        report.failures.push_back(fmt::format(
            "this run would have shown {} of {} known mistakes ({:.1f} %), expected at least {:.4g} %",
            report.power.seen(), report.power.mistakes.size(), 100.0 * report.power.share(), 100.0 * at_least));
}

void ask_coverage(CheckReport& report, const CoverageCount& covered, double at_least) {
    if (at_least <= 0.0)
        return;
    if (covered.lines == 0)
        throw Error("--cover-at-least: no text of a shader of one's own was run; expected a compute stage, or a vertex "
                    "stage that is captured, in GLSL, that is interpreted (--shaders DIR)");
    report.covered = covered.share();
    if (report.covered < at_least)
        report.failures.push_back(fmt::format("the shaders' texts were covered to {:.1f} % ({}), expected at least "
                                              "{:.4g} %",
                                              100.0 * report.covered, coverage_words(covered), 100.0 * at_least));
}

void ask_hits(CheckReport& report, const PassRules& rules) {
    if (rules.require_hits && report.hits == 0 && std::erase(report.untried, no_hits) > 0)
        report.failures.push_back(fmt::format("{}, expected a hit", no_hits));
}

void add_rendered(CheckReport& report, RenderVerdict rendered) {
    const Verdict frame = rendered.count(DifferenceClass::divergent) > 0   ? Verdict::divergent
                          : rendered.count(DifferenceClass::undefined) > 0 ? Verdict::undefined
                          : rendered.differing > 0                         ? Verdict::legal
                                                                           : Verdict::agree;
    report.rendered = std::move(rendered);
    if (frame <= report.verdict)
        return;
    report.state_verdict = report.verdict;
    report.verdict = frame;
}

} // namespace lockstep
