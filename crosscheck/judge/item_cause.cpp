#include "crosscheck/judge/item_cause.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "crosscheck/judge/item_sample.hpp"
#include "reference/parallel_blocks.hpp"

namespace lockstep {
namespace {

/// As few at the front as one likes come from everywhere.
std::vector<std::size_t> spread(const std::vector<std::size_t>& all) {
    constexpr std::size_t stride = 61;
    std::vector<std::size_t> some;
    some.reserve(all.size());
    for (std::size_t first = 0; first < stride; ++first)
        for (std::size_t i = first; i < all.size(); i += stride)
            some.push_back(all[i]);
    return some;
}

std::vector<const NamedMistake*> of_pass(const std::vector<NamedMistake>& named, std::string_view pass, bool exact) {
    std::vector<const NamedMistake*> some;
    for (const NamedMistake& one : named)
        if (one.pass == pass && one.is_exact() == exact)
            some.push_back(&one);
    return some;
}

} // namespace

ItemCauseFinder::ItemCauseFinder(const std::vector<NamedMistake>& named, std::string_view pass)
    : named_(of_pass(named, pass, false)), exact_(of_pass(named, pass, true)), joint_(exact_) {
    for (const NamedMistake& one : named)
        if (one.pass == pass && one.describes)
            describing_.push_back({.made = {one.mistake}, .named = {&one}});
}

/// Counts what it explains and what contradicts it, unless its balance is sure to fall below `at_least`: false then.
bool ItemCauseFinder::hold(Hypothesis& hypothesis, const Trial& trial, std::int64_t at_least) {
    auto left = static_cast<std::int64_t>(trial.divergent.size());
    const std::uint64_t before = hypothesis.explained;
    for (const std::size_t item : trial.divergent) {
        if (hypothesis.balance() + left-- < at_least)
            return false;
        if (!explains(hypothesis, trial.likeness, item))
            continue;
        ++hypothesis.explained;
        hypothesis.telling += trial.likeness.is_off_by_rounding(item) || !trial.likeness.is_off_by_more(item) ? 0 : 1;
        hypothesis.equal += hypothesis.rounds() && has_bits(hypothesis, trial.likeness, item) ? 1 : 0;
        hypothesis.distinct += trial.described[item] != 0 ? 0 : 1;
    }
    if (!trial.divergent.empty() && hypothesis.explained == before)
        return true;
    for (const std::size_t item : trial.right) {
        if (hypothesis.balance() < at_least)
            return false;
        const bool agrees = !contradicts(hypothesis, trial.likeness, item);
        hypothesis.contradicted += agrees ? 0 : 1;
        hypothesis.distinct += agrees && trial.described[item] == 0 ? 1 : 0;
    }
    return hypothesis.balance() >= at_least;
}

/// The most promising are held against all items, and the others until one of the divergent is not
/// explained, or one that agrees contradicts.
void ItemCauseFinder::try_all(const Trial& trial) {
    constexpr std::size_t few = 4, most_promising = 8;
    const std::span items(trial.divergent.data(), std::min(few, trial.divergent.size()));
    std::vector<std::size_t> promise(tried_.size());
    parallel_blocks(static_cast<std::ptrdiff_t>(tried_.size()), [&](std::ptrdiff_t h) {
        const auto at = static_cast<std::size_t>(h);
        for (const std::size_t item : items)
            if (explains(tried_[at], trial.likeness, item))
                ++promise[at];
            else if (tried_[at].named.empty())
                break;
    });
    std::vector<std::size_t> order(tried_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::tuple(promise[b], tried_[a].rank()) < std::tuple(promise[a], tried_[b].rank());
    });
    std::vector<char> kept(tried_.size());
    const auto hold_from = [&](std::size_t from, std::size_t to, std::int64_t at_least) {
        parallel_blocks(static_cast<std::ptrdiff_t>(to - from), [&](std::ptrdiff_t i) {
            const std::size_t h = order[from + static_cast<std::size_t>(i)];
            kept[h] = hold(tried_[h], trial, at_least) ? 1 : 0;
        });
    };
    const std::size_t first = std::min(most_promising, order.size());
    hold_from(0, first, std::numeric_limits<std::int64_t>::min());
    divergent_ += trial.divergent.size();
    hold_from(first, order.size(), static_cast<std::int64_t>(divergent_));
    std::vector<Hypothesis> next;
    for (std::size_t h = 0; h < tried_.size(); ++h)
        if (kept[h] != 0 && tried_[h].explained > 0)
            next.push_back(std::move(tried_[h]));
    tried_ = std::move(next);
    std::stable_sort(tried_.begin(), tried_.end(), [](const Hypothesis& a, const Hypothesis& b) {
        return std::tuple(-a.balance(), a.distinct == 0, a.rank()) <
               std::tuple(-b.balance(), b.distinct == 0, b.rank());
    });
}

std::vector<Hypothesis> ItemCauseFinder::whole_ones() const {
    std::vector<Hypothesis> whole;
    std::copy_if(tried_.begin(), tried_.end(), std::back_inserter(whole),
                 [&](const Hypothesis& h) { return h.explained == divergent_ && h.contradicted == 0; });
    return whole;
}

/// Two at once with names, not both of them exact: of a first frame any, later what explained all before and one more.
void ItemCauseFinder::try_pairs(const Trial& trial, const std::vector<Hypothesis>& held,
                                std::uint64_t divergent_before) {
    constexpr std::size_t few = 16, most_kept = 64;
    std::vector<Hypothesis> one, other;
    for (const NamedMistake* named : named_)
        if (named->constants.empty() && !named->fit)
            one.push_back({.made = {named->mistake}, .named = {named}});
    other = one;
    for (const NamedMistake* named : exact_)
        other.push_back({.made = {named->mistake}, .named = {named}});
    if (divergent_before != 0) {
        one = held;
        std::erase_if(one, [](const Hypothesis& h) { return h.named.size() != 1 || !h.text.empty(); });
    }
    const std::span items(trial.divergent.data(), std::min(few, trial.divergent.size()));
    std::vector<std::vector<Hypothesis>> kept(one.size());
    parallel_blocks(static_cast<std::ptrdiff_t>(one.size()), [&](std::ptrdiff_t o) {
        const auto at = static_cast<std::size_t>(o);
        for (std::size_t b = divergent_before == 0 ? at + 1 : 0; b < other.size(); ++b) {
            if (one[at].named == other[b].named ||
                (one[at].named.front()->of_window && other[b].named.front()->of_window))
                continue;
            Hypothesis pair{.made = {one[at].made.front(), other[b].made.front()},
                            .named = {one[at].named.front(), other[b].named.front()}};
            if (std::all_of(items.begin(), items.end(),
                            [&](std::size_t item) { return explains(pair, trial.likeness, item); }))
                kept[at].push_back(std::move(pair));
        }
    });
    std::vector<Hypothesis> pairs;
    for (const std::vector<Hypothesis>& some : kept)
        pairs.insert(pairs.end(), some.begin(), some.end());
    if (pairs.size() > most_kept) // they fit whatever it is
        return;
    std::vector<char> stays(pairs.size());
    parallel_blocks(static_cast<std::ptrdiff_t>(pairs.size()), [&](std::ptrdiff_t p) {
        const auto at = static_cast<std::size_t>(p);
        pairs[at].explained = divergent_before;
        stays[at] = hold(pairs[at], trial, static_cast<std::int64_t>(divergent_)) && needs_both(pairs[at], trial);
    });
    for (std::size_t p = pairs.size(); p-- > 0;)
        if (stays[p] != 0)
            tried_.insert(tried_.begin(), pairs[p]);
}

/// Whether enough items speak against either alone, held to no more than both are.
bool ItemCauseFinder::needs_both(const Hypothesis& pair, const Trial& trial) {
    for (std::size_t part = 0; part < pair.made.size(); ++part) {
        const Hypothesis alone{.made = {pair.made[part]}, .named = {pair.named[part]}, .loosely = pair.rounds()};
        const auto unlike = [&](std::span<const std::size_t> items) {
            return static_cast<std::uint64_t>(std::count_if(
                items.begin(), items.end(), [&](std::size_t item) { return !explains(alone, trial.likeness, item); }));
        };
        if (unlike(trial.divergent) + unlike(trial.right) < enough_evidence)
            return false;
    }
    return true;
}

void ItemCauseFinder::add(const JudgedPass& pass, const std::vector<ItemVerdict>& verdicts,
                          const SeenElsewhere& elsewhere) {
    std::vector<Hypothesis> whole; // exact ones
    if (const CauseFindings found = joint_.findings(); found.explains_all())
        for (const Cause& cause : found.best)
            for (const NamedMistake* named : exact_)
                if (cause.mistakes == std::vector{named->name})
                    whole.push_back({.made = {named->mistake}, .named = {named}});
    joint_.add(pass, verdicts, elsewhere);
    try_single(pass, verdicts, std::move(whole));
}

void ItemCauseFinder::try_single(const JudgedPass& pass, const std::vector<ItemVerdict>& verdicts,
                                 std::vector<Hypothesis> held) {
    const std::vector<std::size_t> divergent = divergent_items(verdicts);
    if (divergent.empty())
        return;
    const bool first = frames_ == 0, later = frames_ >= trial_frames;
    if (frames_++ >= trial_frames && (tried_.empty() || tried_.front().explained < divergent_))
        return;
    const std::size_t most = later ? later_items : trial_items;
    const std::vector<std::size_t> items = spread(sample(divergent, most)),
                                   right = spread(right_items(pass.gpu.count(), verdicts,
                                                              later ? right_items_held / 4 : right_items_held));
    const ItemLikeness likeness(pass, verdicts);
    std::vector<char> described(pass.gpu.count());
    const auto part = [&](std::size_t from, std::size_t to) {
        const auto of = [&](const std::vector<std::size_t>& all) {
            return std::span(all).subspan(std::min(from, all.size()),
                                          std::min(to, all.size()) - std::min(from, all.size()));
        };
        return Trial{likeness, of(items), of(right), described};
    };
    for (const std::vector<std::size_t>& some : {items, right})
        parallel_blocks(static_cast<std::ptrdiff_t>(some.size()), [&](std::ptrdiff_t i) {
            const std::size_t item = some[static_cast<std::size_t>(i)];
            described[item] = std::any_of(describing_.begin(), describing_.end(), [&](const Hypothesis& description) {
                return explains(description, likeness, item);
            });
        });
    const std::vector<Hypothesis> whole = whole_ones();
    held.insert(held.end(), whole.begin(), whole.end());
    const std::uint64_t divergent_before = divergent_;
    if (first)
        tried_ = hypotheses_of(named_, exact_, pass, sample(divergent, 16));
    if (later && tried_.size() > most_shown + 1)
        tried_.resize(most_shown + 1);
    try_all(part(0, first_items));
    const CauseFindings joint = joint_.findings();
    if (frames_ <= trial_frames && whole_ones().empty() &&
        !(joint.explains_all() && joint.best.front().mistakes.size() == 1))
        try_pairs(part(0, first_items), held, divergent_before);
    if (!tried_.empty() && tried_.front().explained == divergent_ &&
        std::any_of(tried_.begin(), tried_.end(), [](const Hypothesis& h) { return h.telling != 0; }))
        try_all(part(first_items, right_items_held));
}

CauseFindings ItemCauseFinder::of_single(bool beside_description) const {
    CauseFindings found;
    found.divergent = divergent_;
    for (const Hypothesis& hypothesis : tried_) {
        if (hypothesis.explained != tried_.front().explained || hypothesis.contradicted != tried_.front().contradicted)
            break;
        // A formula that comes near must be seen where more than rounding shows.
        const bool comes_near = hypothesis.rounds() && hypothesis.equal < hypothesis.explained;
        if (hypothesis.telling == 0 || (comes_near && 2 * hypothesis.telling < hypothesis.explained))
            continue;
        // What has no item to show that the description lacks is another word for it, and fails where that does.
        if (hypothesis.distinct == 0 && !beside_description)
            continue;
        // Of a few items two fields hold each other's values by chance.
        if (hypothesis.host == Hypothesis::Host::fields_swapped && hypothesis.explained < enough_evidence)
            continue;
        const bool named = !hypothesis.named.empty();
        const bool is_alike = hypothesis.alike != nullptr && divergent_ >= enough_evidence;
        // A constant that fits a few is no evidence, nor is one of several that fit as well, but for those fitted.
        const auto is_rival = [&](const Hypothesis& other) {
            return &other != &hypothesis && other.named == hypothesis.named &&
                   other.explained == hypothesis.explained && other.contradicted == hypothesis.contradicted;
        };
        if (named && !hypothesis.text.empty() &&
            (hypothesis.explained < enough_evidence ||
             (!hypothesis.named.front()->fit && std::any_of(tried_.begin(), tried_.end(), is_rival)) ||
             std::any_of(found.best.begin(), found.best.end(),
                         [&](const Cause& cause) { return cause.mistakes == hypothesis.names(); })))
            continue;
        found.best.push_back({hypothesis.names(), hypothesis.meaning(), hypothesis.explained, hypothesis.contradicted,
                              named || is_alike || hypothesis.host != Hypothesis::Host::none});
    }
    return found;
}

CauseFindings ItemCauseFinder::findings() const {
    CauseFindings found = joint_.findings();
    const bool one_name = found.explains_all() && found.best.front().mistakes.size() == 1;
    const CauseFindings single = of_single(one_name);
    const auto is_told = [&](const Cause& cause) {
        return std::any_of(found.best.begin(), found.best.end(), [&](const Cause& told) {
            return std::is_permutation(told.mistakes.begin(), told.mistakes.end(), cause.mistakes.begin(),
                                       cause.mistakes.end());
        });
    };
    if (!one_name) {
        // Among thousands of changes without a name one explains a few items by chance.
        if (single.explains_all() && (single.best.front().has_name || single.divergent >= enough_evidence)) {
            if (!found.explains_all() || single.best.front().mistakes.size() == 1)
                return single;
            std::copy_if(single.best.begin(), single.best.end(), std::back_inserter(found.best), std::not_fn(is_told));
            return found;
        }
        const bool is_part = found.best.empty() && !single.best.empty() && single.best.front().contradicted == 0 &&
                             single.best.front().explained >= enough_evidence;
        if (is_part)
            return single;
        if (found.best.empty())
            found.divergent = std::max(found.divergent, single.divergent);
        return found;
    }
    if (single.explains_all())
        for (const Cause& cause : single.best)
            if (cause.has_name && !is_told(cause))
                found.best.push_back(cause);
    return found;
}

} // namespace lockstep
