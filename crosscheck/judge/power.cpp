#include "crosscheck/judge/power.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace lockstep {
namespace {

/// At most `count` of them, evenly spread.
std::vector<std::size_t> spread(const std::vector<std::size_t>& all, std::size_t count) {
    if (all.size() <= count)
        return all;
    std::vector<std::size_t> some(count);
    for (std::size_t i = 0; i < count; ++i)
        some[i] = all[i * all.size() / count];
    return some;
}

/// An item's words, those that the reference gave it.
std::vector<std::uint32_t> words_of(const View& state, std::size_t item, const std::vector<Component>& parts) {
    std::vector<std::uint32_t> words;
    for (const Component& c : parts)
        words.push_back(state.value(c.field, item, c.component).bits);
    return words;
}

bool contains(const ItemOutcome& outcome, const std::vector<std::uint32_t>& words, const Resource& about,
              const std::vector<Component>& parts) {
    for (std::size_t w = 0; w < words.size(); ++w) {
        const Value value{about.fields[parts[w].field].scalar, words[w]};
        const Interval& legal = outcome.values[w];
        const bool in = value.scalar == Scalar::float32
                            ? legal.contains(value.real())
                            : legal.any || (legal.low <= static_cast<double>(value.integer()) &&
                                            static_cast<double>(value.integer()) <= legal.high);
        if (!in)
            return false;
    }
    return true;
}

} // namespace

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
    std::vector<std::size_t> items = spread(telling, tried_a_frame / 2);
    for (std::size_t i = 0; i < tried_a_frame / 2; ++i) // others in every frame
        items.push_back((i * count / (tried_a_frame / 2) + static_cast<std::size_t>(p.frame) * 7) % count);
    const Resource& about = p.reference.about();
    const std::vector<Component> parts = components(about);
    const auto n = static_cast<std::ptrdiff_t>(unseen.size());
    std::vector<char> shown(unseen.size());
#pragma omp parallel for schedule(dynamic)
    for (std::ptrdiff_t u = 0; u < n; ++u) {
        const std::array made{named_[unseen[static_cast<std::size_t>(u)]].mistake};
        for (const std::size_t item : items) {
            const std::vector<std::uint32_t> words = p.pass.mistaken(p.input(), item, p.profile, made);
            if (words == words_of(p.reference, item, parts))
                continue;
            const auto outcomes = p.pass.outcomes(p.input(), item, p.profile, p.known, nullptr);
            if (std::none_of(outcomes.begin(), outcomes.end(),
                             [&](const ItemOutcome& o) { return contains(o, words, about, parts); })) {
                shown[static_cast<std::size_t>(u)] = 1;
                break;
            }
        }
    }
    for (std::size_t u = 0; u < unseen.size(); ++u)
        seen_[unseen[u]] = shown[u] != 0;
}

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
