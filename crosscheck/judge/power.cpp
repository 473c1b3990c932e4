#include "crosscheck/judge/power.hpp"

#include <algorithm>
#include <array>

#include "crosscheck/judge/item_sample.hpp"
#include "reference/parallel_blocks.hpp"

namespace lockstep {

MistakenItem judge_mistaken(const JudgedPass& p, std::size_t item, std::span<const std::uint32_t> words) {
    const Resource& about = p.reference.about();
    bool same = true;
    std::size_t at = 0;
    for (std::uint8_t field = 0; field < about.fields.size(); ++field)
        for (int c = 0; c < about.fields[field].components; ++c)
            same = same && same_bits(Value{about.fields[field].scalar, words[at++]}, p.reference.value(field, item, c));
    if (same)
        return MistakenItem::same;
    const auto outcomes = p.on_input().outcomes(p.input(), item, p.profile, p.known, nullptr);
    const bool legal = std::any_of(outcomes.begin(), outcomes.end(),
                                   [&](const ItemOutcome& outcome) { return outcome.contains(words, about); });
    return legal ? MistakenItem::legal : MistakenItem::divergent;
}

std::vector<std::size_t> items_to_try(const JudgedPass& p, const std::vector<std::size_t>& telling, std::size_t most) {
    std::vector<std::size_t> items = sample(telling, most - most / 4);
    const std::size_t count = p.reference.count(), others = std::min(most - items.size(), count);
    for (std::size_t i = 0; i < others; ++i)
        items.push_back((i * count / others + static_cast<std::size_t>(p.frame) * 7) % count);
    return items;
}

namespace {

/// Whether an item that comes by these sites may become another by the mistake.
bool may_change(const std::vector<SeenSite>& sites, const Mistake& made) {
    for (const Mistake* one = &made; one != nullptr; one = one->also)
        if (one->site == 0 ||
            std::any_of(sites.begin(), sites.end(), [&](const SeenSite& seen) { return seen.site->id == one->site; }))
            return true;
    return false;
}

} // namespace

bool PowerMeter::add(const JudgedPass& p, const std::vector<std::size_t>& telling, std::size_t asked) {
    std::vector<std::size_t> unseen;
    std::size_t of_pass = 0;
    for (std::size_t m = 0; m < named_.size(); ++m)
        if (named_[m].pass == p.pass.name()) {
            tried_[m].passed = true;
            ++of_pass;
            if (tried_[m].first_frame < 0)
                unseen.push_back(m);
        }
    if (unseen.empty() || p.reference.count() == 0)
        return false;
    const std::size_t most = asked > 0 ? asked : std::min(tried_a_frame * of_pass / unseen.size(), tried_at_most);
    const std::vector<std::size_t> items = items_to_try(p, telling, most);
    std::vector<std::vector<SeenSite>> sites(items.size());
    parallel_blocks(static_cast<std::ptrdiff_t>(items.size()), [&](std::ptrdiff_t i) {
        const auto at = static_cast<std::size_t>(i);
        sites[at] = p.on_input().sites(p.input(), items[at], p.profile);
    });
    std::set<std::uint32_t> reached;
    for (const std::vector<SeenSite>& of_item : sites)
        for (const SeenSite& seen : of_item)
            reached.insert(seen.site->id);
    const auto steps_of = [&](std::size_t m) {
        return int{tried_[m].reached} + int{tried_[m].changes} + int{tried_[m].first_frame >= 0};
    };
    std::vector<char> is_further(unseen.size());
    parallel_blocks(static_cast<std::ptrdiff_t>(unseen.size()), [&](std::ptrdiff_t u) {
        const std::size_t m = unseen[static_cast<std::size_t>(u)];
        const std::array made{named_[m].mistake};
        const int before = steps_of(m);
        tried_[m].reached = tried_[m].reached || reached.contains(made[0].site);
        for (std::size_t i = 0; i < items.size(); ++i) {
            const std::size_t item = items[i];
            if (!may_change(sites[i], made[0]))
                continue;
            const MistakenItem is = judge_mistaken(p, item, p.on_input().mistaken(p.input(), item, p.profile, made));
            tried_[m].changes = tried_[m].changes || is != MistakenItem::same;
            if (is == MistakenItem::divergent) {
                tried_[m].first_frame = p.frame;
                break;
            }
        }
        is_further[static_cast<std::size_t>(u)] = steps_of(m) > before ? 1 : 0;
    });
    return std::find(is_further.begin(), is_further.end(), 1) != is_further.end();
}

void PowerMeter::note_idle(std::string_view pass) {
    for (std::size_t m = 0; m < named_.size(); ++m)
        if (named_[m].pass == pass)
            tried_[m].is_idle = !tried_[m].passed;
}

bool PowerMeter::has_seen_all() const {
    const PowerSummary now = summary();
    return !now.mistakes.empty() && now.seen() == now.mistakes.size();
}

PowerSummary PowerMeter::summary() const {
    PowerSummary summary;
    for (std::size_t m = 0; m < named_.size(); ++m) {
        const Tried& tried = tried_[m];
        if (!tried.passed && !tried.is_idle)
            continue;
        PowerSummary::Mistake& mistake = summary.mistakes.emplace_back();
        mistake.name = named_[m].name;
        mistake.pass = named_[m].pass;
        mistake.meaning = named_[m].meaning;
        if (tried.first_frame >= 0)
            mistake.first_frame = tried.first_frame;
        mistake.changes = tried.changes;
        if (tried.is_idle)
            mistake.reasons.emplace_back("its pass did not run");
        else if (!tried.reached)
            mistake.reasons.emplace_back("nothing that was tried came to where it is made");
    }
    return summary;
}

} // namespace lockstep
