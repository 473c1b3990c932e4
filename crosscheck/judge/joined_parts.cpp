#include "crosscheck/judge/joined_parts.hpp"

#include <algorithm>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

void expect(bool fits, const char* what) {
    if (!fits)
        throw Error(std::string("they are no parts of one run: ") + what);
}

/// None is tried in a part none of whose frames was looked at for it.
bool is_untried(const PowerSummary& power) { return power.mistakes.empty() && power.situations.empty(); }

void join(PowerSummary& run, const PowerSummary& next) {
    if (is_untried(next))
        return;
    if (is_untried(run)) {
        run = next;
        return;
    }
    expect(run.mistakes.size() == next.mistakes.size() && run.situations.size() == next.situations.size(),
           "other mistakes were tried");
    for (std::size_t m = 0; m < run.mistakes.size(); ++m) {
        PowerSummary::Mistake& mistake = run.mistakes[m];
        const PowerSummary::Mistake& more = next.mistakes[m];
        expect(mistake.name == more.name, "other mistakes were tried");
        if (!mistake.first_frame)
            mistake.first_frame = more.first_frame;
        mistake.changes = mistake.changes || more.changes;
        std::erase_if(mistake.reasons, [&](const std::string& reason) {
            return std::find(more.reasons.begin(), more.reasons.end(), reason) == more.reasons.end();
        });
    }
    for (std::size_t s = 0; s < run.situations.size(); ++s) {
        expect(run.situations[s].name == next.situations[s].name, "other situations were counted");
        run.situations[s].count += next.situations[s].count;
    }
}

} // namespace

void join(CheckReport& run, const CheckReport& next) {
    expect(run.particles == next.particles, "they have other numbers of particles");
    expect(run.verdicts.has_value() && next.verdicts.has_value(), "one was not judged frame by frame");
    expect(run.verdicts->judges_leans == next.verdicts->judges_leans, "they were judged by other rules");
    expect(run.first + run.frames == next.first, "the one does not follow the other");
    const bool both_diverge = !run.verdicts->divergent_frames.empty() && !next.verdicts->divergent_frames.empty();
    if (both_diverge)
        run.wider_rule.reset();
    else if (run.verdicts->divergent_frames.empty())
        run.wider_rule = next.wider_rule;
    run.frames += next.frames;
    run.frames_asked = run.frames;
    run.total.add(next.total);
    if (!run.first_frame) {
        run.first_frame = next.first_frame;
        run.worst = next.worst;
    }
    run.counts.insert(run.counts.end(), next.counts.begin(), next.counts.end());
    join(run.power, next.power);
    run.verdicts->join(*next.verdicts);
    run.hits += next.hits;
    run.drawn_texels += next.drawn_texels;
    run.reference_hash = next.reference_hash;
    run.gpu_hash = next.gpu_hash;
}

} // namespace lockstep
