#include "crosscheck/judge/item_cause.hpp"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "crosscheck/judge/compare.hpp"

namespace lockstep {
namespace {

std::vector<std::size_t> sample(const std::vector<std::size_t>& all, std::size_t count) {
    if (all.size() <= count)
        return all;
    std::vector<std::size_t> some(count);
    for (std::size_t i = 0; i < count; ++i)
        some[i] = all[i * all.size() / count];
    return some;
}

std::vector<std::size_t> divergent_of(const std::vector<ItemVerdict>& verdicts) {
    std::vector<std::size_t> items;
    for (const ItemVerdict& verdict : verdicts)
        if (verdict.kind == DifferenceClass::divergent)
            items.push_back(verdict.index);
    return items;
}

std::vector<std::size_t> agreeing_of(const JudgedPass& pass, const std::vector<ItemVerdict>& verdicts) {
    std::vector<std::size_t> items;
    for (std::size_t i = 0, next = 0; i < pass.gpu.count(); ++i) {
        if (next < verdicts.size() && verdicts[next].index == i)
            ++next;
        else
            items.push_back(i);
    }
    return sample(items, ItemCauseFinder::trial_items);
}

/// The same bits but for the sign of zero, which depends on how a mistake was written down.
bool alike(Value a, Value b) {
    return same_bits(a, b) || (a.scalar == Scalar::float32 && a.real() == 0.0F && b.real() == 0.0F);
}

} // namespace

bool ItemCauseFinder::explains(const Hypothesis& hypothesis, const JudgedPass& p, std::size_t item) {
    using Host = Hypothesis::Host;
    const std::vector<Component> parts = components(p.gpu.about());
    if (hypothesis.host == Host::unwritten) {
        const View& before = p.before[p.pass.resource()];
        return std::all_of(parts.begin(), parts.end(), [&](const Component& c) {
            return alike(before.value(c.field, item, c.component), p.gpu.value(c.field, item, c.component));
        });
    }
    const PassInput input{hypothesis.host == Host::earlier_state ? *p.earlier : p.before, p.frame};
    std::vector<Mistake> made;
    if (hypothesis.mistake)
        made.push_back(*hypothesis.mistake);
    const std::vector<std::uint32_t> words = p.pass.mistaken(input, item, p.profile, made);
    for (std::size_t w = 0; w < parts.size(); ++w) {
        const Value gpu = p.gpu.value(parts[w].field, item, parts[w].component);
        if (!alike({gpu.scalar, words[w]}, gpu))
            return false;
    }
    return true;
}

std::vector<ItemCauseFinder::Hypothesis> ItemCauseFinder::hypotheses(const JudgedPass& pass,
                                                                     const std::vector<std::size_t>& items) const {
    std::vector<Hypothesis> all;
    for (const NamedMistake& named : named_)
        if (named.pass == pass.pass.name())
            all.push_back({.mistake = named.mistake, .named = &named});
    all.push_back({.host = Hypothesis::Host::unwritten, .text = "items_not_written"});
    if (pass.earlier != nullptr)
        all.push_back({.host = Hypothesis::Host::earlier_state, .text = "state_of_earlier_frame"});
    std::vector<SeenSite> sites;
    for (const std::size_t item : items)
        for (const SeenSite& site : pass.pass.sites(pass.input(), item, pass.profile))
            if (std::find(sites.begin(), sites.end(), site) == sites.end())
                sites.push_back(site);
    for (const Mistake& mistake : mistakes_at(sites))
        if (std::none_of(all.begin(), all.end(), [&](const Hypothesis& h) { return h.mistake == mistake; }))
            all.push_back({.mistake = mistake, .text = mistake_text(mistake, sites)});
    return all;
}

void ItemCauseFinder::add(const JudgedPass& pass, const std::vector<ItemVerdict>& verdicts) {
    const std::vector<std::size_t> divergent = divergent_of(verdicts);
    if (divergent.empty())
        return;
    const bool first = frames_ == 0;
    if (frames_++ >= trial_frames && (tried_.empty() || tried_.front().explained < divergent_))
        return;
    const std::vector<std::size_t> some = sample(divergent, trial_items);
    const std::vector<std::size_t> agreeing = agreeing_of(pass, verdicts);
    if (first)
        tried_ = hypotheses(pass, sample(divergent, 16));
    divergent_ += some.size();
    const auto count = [&](Hypothesis& hypothesis, const std::vector<std::size_t>& items) {
        return static_cast<std::uint64_t>(std::count_if(
            items.begin(), items.end(), [&](std::size_t item) { return explains(hypothesis, pass, item); }));
    };
    const auto n = static_cast<std::ptrdiff_t>(tried_.size());
#pragma omp parallel for schedule(dynamic)
    for (std::ptrdiff_t h = 0; h < n; ++h) {
        Hypothesis& hypothesis = tried_[static_cast<std::size_t>(h)];
        // A few items tell of most that they explain nothing.
        const std::uint64_t few = some.size() > 32 ? count(hypothesis, sample(some, 8)) : 1;
        const std::uint64_t explained = few == 0 ? 0 : count(hypothesis, some);
        hypothesis.explained += explained;
        if (explained > 0)
            hypothesis.contradicted += agreeing.size() - count(hypothesis, agreeing);
    }
    std::stable_sort(tried_.begin(), tried_.end(), [](const Hypothesis& a, const Hypothesis& b) {
        const auto balance = [](const Hypothesis& h) {
            return static_cast<std::int64_t>(h.contradicted) - static_cast<std::int64_t>(h.explained);
        };
        return std::tuple(balance(a), a.rank()) < std::tuple(balance(b), b.rank());
    });
    std::erase_if(tried_, [](const Hypothesis& h) { return h.explained == 0; });
}

CauseFindings ItemCauseFinder::findings() const {
    CauseFindings found;
    found.divergent = divergent_;
    for (const Hypothesis& hypothesis : tried_) {
        if (hypothesis.explained != tried_.front().explained || hypothesis.contradicted != tried_.front().contradicted)
            break;
        const bool named = hypothesis.named != nullptr;
        std::string meaning = "a change of the twin at one site";
        if (hypothesis.host == Hypothesis::Host::unwritten)
            meaning = "the pass left them as they were";
        else if (hypothesis.host == Hypothesis::Host::earlier_state)
            meaning = "the pass read the state of the frame before";
        found.best.push_back({{named ? hypothesis.named->name : hypothesis.text},
                              named ? hypothesis.named->meaning : meaning,
                              hypothesis.explained,
                              hypothesis.contradicted});
    }
    return found;
}

} // namespace lockstep
