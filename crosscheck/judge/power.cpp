#include "crosscheck/judge/power.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "crosscheck/judge/item_sample.hpp"
#include "reference/parallel_blocks.hpp"

namespace lockstep {

void PowerMeter::add(const JudgedPass& p, const std::vector<std::size_t>& telling) {
    if (std::find(passes_.begin(), passes_.end(), p.pass.name()) == passes_.end())
        passes_.emplace_back(p.pass.name());
    std::vector<std::size_t> unseen;
    for (std::size_t m = 0; m < named_.size(); ++m)
        if (!seen_[m] && named_[m].pass == p.pass.name())
            unseen.push_back(m);
    const std::size_t count = p.reference.count();
    if (unseen.empty() || count == 0)
        return;
    std::vector<std::size_t> items = sample(telling, tried_a_frame / 2);
    for (std::size_t i = 0; i < tried_a_frame / 2; ++i) // others in every frame
        items.push_back((i * count / (tried_a_frame / 2) + static_cast<std::size_t>(p.frame) * 7) % count);
    const Resource& about = p.reference.about();
    std::vector<char> shown(unseen.size());
    parallel_blocks(static_cast<std::ptrdiff_t>(unseen.size()), [&](std::ptrdiff_t u) {
        const std::array made{named_[unseen[static_cast<std::size_t>(u)]].mistake};
        for (const std::size_t item : items) {
            const std::vector<std::uint32_t> words = p.pass.mistaken(p.input(), item, p.profile, made);
            if (words == item_words(p.reference, item))
                continue;
            const auto outcomes = p.pass.outcomes(p.input(), item, p.profile, p.known, nullptr);
            if (std::none_of(outcomes.begin(), outcomes.end(),
                             [&](const ItemOutcome& o) { return o.contains(words, about); })) {
                shown[static_cast<std::size_t>(u)] = 1;
                break;
            }
        }
    });
    for (std::size_t u = 0; u < unseen.size(); ++u)
        seen_[unseen[u]] = shown[u] != 0;
}

bool PowerMeter::has_seen_all() const { return !passes_.empty() && summary().unseen.empty(); }

PowerSummary PowerMeter::summary() const {
    PowerSummary summary;
    for (std::size_t m = 0; m < named_.size(); ++m) {
        if (std::find(passes_.begin(), passes_.end(), named_[m].pass) == passes_.end())
            continue;
        ++summary.mistakes;
        if (!seen_[m])
            summary.unseen.push_back(named_[m].name);
    }
    return summary;
}

} // namespace lockstep
