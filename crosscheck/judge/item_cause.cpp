#include "crosscheck/judge/item_cause.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>

#include <fmt/format.h>

#include "crosscheck/judge/item_sample.hpp"
#include "crosscheck/judge/rounding_only.hpp"
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

bool sums(const Mistake& mistake) {
    return mistake.change == Change::added_up || mistake.change == Change::units_added_up;
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
    : named_(of_pass(named, pass, false)), joint_(of_pass(named, pass, true)) {
    for (const NamedMistake& one : named)
        if (one.pass == pass && one.describes)
            describing_.push_back({.mistake = one.mistake, .named = &one});
}

bool ItemCauseFinder::explains(const Hypothesis& hypothesis, const Trial& trial, std::size_t item) {
    using Host = Hypothesis::Host;
    const JudgedPass& p = trial.likeness.pass();
    const std::vector<Component>& parts = trial.likeness.parts();
    if (hypothesis.host == Host::unwritten) {
        const View& before = p.before[p.pass.resource()];
        return std::all_of(parts.begin(), parts.end(), [&](const Component& c) {
            return alike(before.value(c.field, item, c.component), p.gpu.value(c.field, item, c.component));
        });
    }
    if (hypothesis.host == Host::field_kept || hypothesis.host == Host::fields_swapped) {
        const View& before = p.before[p.pass.resource()];
        return std::all_of(parts.begin(), parts.end(), [&](const Component& c) {
            const auto [one, other] = hypothesis.fields;
            const bool kept = hypothesis.host == Host::field_kept;
            const std::uint8_t from = kept || (c.field != one && c.field != other) ? c.field
                                      : c.field == one                             ? other
                                                                                   : one;
            const View& made = kept && c.field == one ? before : p.reference;
            return alike(made.value(from, item, c.component), p.gpu.value(c.field, item, c.component));
        });
    }
    const PassInput input{hypothesis.host == Host::earlier_state ? *p.earlier : p.before, p.frame};
    const auto made = hypothesis.mistake ? std::span(&*hypothesis.mistake, 1) : std::span<const Mistake>();
    const std::vector<std::uint32_t> words = p.pass.mistaken(input, item, p.profile, made);
    if (!hypothesis.rounds())
        return trial.likeness.are_gpus(item, words);
    return trial.likeness.are_near_gpus(item, words, sums(*hypothesis.mistake) ? summed_ulps : rewritten_ulps);
}

/// Of one with constants as many as it has.
void ItemCauseFinder::add_named(std::vector<Hypothesis>& all, const NamedMistake& named, const JudgedPass& pass,
                                const std::vector<std::size_t>& items) {
    std::vector<std::array<float, 3>> constants = named.constants;
    if (named.fit)
        for (const std::size_t item : sample(items, 4)) {
            std::vector<float> before, after;
            for (const Component& c : components(pass.gpu.about())) {
                before.push_back(pass.before[pass.pass.resource()].value(c.field, item, c.component).real());
                after.push_back(pass.gpu.value(c.field, item, c.component).real());
            }
            const std::array<float, 3> fitted = named.fit(before, after);
            if (std::find(constants.begin(), constants.end(), fitted) == constants.end())
                constants.push_back(fitted);
        }
    if (constants.empty())
        all.push_back({.mistake = named.mistake, .named = &named});
    for (const std::array<float, 3>& c : constants) {
        Hypothesis& with = all.emplace_back(Hypothesis{.mistake = named.mistake, .named = &named});
        with.mistake->constants = c;
        with.text =
            c[1] == 0.0F && c[2] == 0.0F ? fmt::format(" ({})", c[0]) : fmt::format(" ({}, {}, {})", c[0], c[1], c[2]);
    }
}

std::vector<ItemCauseFinder::Hypothesis> ItemCauseFinder::hypotheses(const JudgedPass& pass,
                                                                     const std::vector<std::size_t>& items) const {
    std::vector<Hypothesis> all;
    for (const NamedMistake* named : named_)
        add_named(all, *named, pass, items);
    all.push_back({.host = Hypothesis::Host::unwritten, .text = "items_not_written"});
    if (pass.earlier != nullptr)
        all.push_back({.host = Hypothesis::Host::earlier_state, .text = "state_of_earlier_frame"});
    const std::span<const Field> fields = pass.gpu.fields();
    for (std::uint8_t f = 0; f < fields.size() && fields.size() > 1; ++f) {
        all.push_back({.host = Hypothesis::Host::field_kept,
                       .text = fmt::format("{}_not_written", fields[f].name),
                       .fields = {f}});
        for (std::uint8_t g = 0; g < f; ++g)
            if (fields[f].components == fields[g].components && fields[f].scalar == fields[g].scalar)
                all.push_back({.host = Hypothesis::Host::fields_swapped,
                               .text = fmt::format("{}_and_{}_swapped", fields[g].name, fields[f].name),
                               .fields = {g, f}});
    }
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

/// Counts what it explains and what contradicts it, unless its balance is sure to fall below `at_least`: false then.
bool ItemCauseFinder::hold(Hypothesis& hypothesis, const Trial& trial, std::int64_t at_least) {
    auto left = static_cast<std::int64_t>(trial.divergent.size());
    const std::uint64_t before = hypothesis.explained;
    for (const std::size_t item : trial.divergent) {
        if (hypothesis.balance() + left-- < at_least)
            return false;
        if (!explains(hypothesis, trial, item))
            continue;
        ++hypothesis.explained;
        hypothesis.telling += trial.likeness.is_off_by_rounding(item) ? 0 : 1;
        hypothesis.distinct += trial.described[item] != 0 ? 0 : 1;
    }
    if (!trial.divergent.empty() && hypothesis.explained == before)
        return true;
    for (const std::size_t item : trial.agreeing) {
        if (hypothesis.balance() < at_least)
            return false;
        const bool agrees = explains(hypothesis, trial, item);
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
            if (explains(tried_[at], trial, item))
                ++promise[at];
            else if (tried_[at].named == nullptr)
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

void ItemCauseFinder::add(const JudgedPass& pass, const std::vector<ItemVerdict>& verdicts,
                          const SeenElsewhere& elsewhere) {
    joint_.add(pass, verdicts, elsewhere);
    try_single(pass, verdicts);
}

void ItemCauseFinder::try_single(const JudgedPass& pass, const std::vector<ItemVerdict>& verdicts) {
    const std::vector<std::size_t> divergent = divergent_items(verdicts);
    if (divergent.empty())
        return;
    const bool first = frames_ == 0, later = frames_ >= trial_frames;
    if (frames_++ >= trial_frames && (tried_.empty() || tried_.front().explained < divergent_))
        return;
    const std::size_t most = later ? later_items : trial_items;
    const std::vector<std::size_t> items = spread(sample(divergent, most)),
                                   agreeing =
                                       spread(agreeing_items(pass.gpu.count(), verdicts,
                                                             later ? agreeing_items_held / 4 : agreeing_items_held));
    const ItemLikeness likeness(pass);
    std::vector<char> described(pass.gpu.count());
    const auto part = [&](std::size_t from, std::size_t to) {
        const auto of = [&](const std::vector<std::size_t>& all) {
            return std::span(all).subspan(std::min(from, all.size()),
                                          std::min(to, all.size()) - std::min(from, all.size()));
        };
        return Trial{likeness, of(items), of(agreeing), described};
    };
    for (const std::vector<std::size_t>& some : {items, agreeing})
        parallel_blocks(static_cast<std::ptrdiff_t>(some.size()), [&](std::ptrdiff_t i) {
            const std::size_t item = some[static_cast<std::size_t>(i)];
            described[item] = std::any_of(describing_.begin(), describing_.end(), [&](const Hypothesis& description) {
                return explains(description, Trial{likeness, {}, {}, {}}, item);
            });
        });
    if (first)
        tried_ = hypotheses(pass, sample(divergent, 16));
    if (later && tried_.size() > most_shown + 1)
        tried_.resize(most_shown + 1);
    try_all(part(0, first_items));
    if (!tried_.empty() && tried_.front().explained == divergent_)
        try_all(part(first_items, agreeing_items_held));
}

CauseFindings ItemCauseFinder::of_single(bool beside_description) const {
    CauseFindings found;
    found.divergent = divergent_;
    for (const Hypothesis& hypothesis : tried_) {
        if (hypothesis.explained != tried_.front().explained || hypothesis.contradicted != tried_.front().contradicted)
            break;
        // A formula that comes near must be seen where more than rounding shows.
        if (hypothesis.telling == 0 || (hypothesis.rounds() && 2 * hypothesis.telling < hypothesis.explained))
            continue;
        // What has no item to show that the description lacks is another word for it, and fails where that does.
        if (hypothesis.distinct == 0 && !beside_description)
            continue;
        const bool named = hypothesis.named != nullptr;
        // A constant that fits a few is no evidence, nor is one of several that fit as well, but for those fitted.
        const auto is_rival = [&](const Hypothesis& other) {
            return &other != &hypothesis && other.named == hypothesis.named &&
                   other.explained == hypothesis.explained && other.contradicted == hypothesis.contradicted;
        };
        if (named && !hypothesis.text.empty() &&
            (hypothesis.explained < enough_evidence ||
             (!hypothesis.named->fit && std::any_of(tried_.begin(), tried_.end(), is_rival)) ||
             std::any_of(found.best.begin(), found.best.end(),
                         [&](const Cause& cause) { return cause.mistakes.front() == hypothesis.named->name; })))
            continue;
        std::string meaning = "a change of the twin at one site";
        if (hypothesis.host == Hypothesis::Host::unwritten)
            meaning = "the pass left them as they were";
        else if (hypothesis.host == Hypothesis::Host::earlier_state)
            meaning = "the pass read the state of the frame before";
        else if (hypothesis.host == Hypothesis::Host::field_kept)
            meaning = "the field is as it was";
        else if (hypothesis.host == Hypothesis::Host::fields_swapped)
            meaning = "each of the two fields holds what the other should";
        found.best.push_back({{named ? hypothesis.named->name : hypothesis.text},
                              named ? hypothesis.named->meaning + hypothesis.text : meaning,
                              hypothesis.explained,
                              hypothesis.contradicted,
                              named || hypothesis.host != Hypothesis::Host::none});
    }
    return found;
}

CauseFindings ItemCauseFinder::findings() const {
    CauseFindings found = joint_.findings();
    const bool one_name = found.explains_all() && found.best.front().mistakes.size() == 1;
    const CauseFindings single = of_single(one_name);
    if (!one_name) {
        // Among thousands of changes without a name one explains a few items by chance.
        if (single.explains_all() && (single.best.front().has_name || single.divergent >= enough_evidence))
            return single;
        const bool is_part = found.best.empty() && !single.best.empty() && single.best.front().contradicted == 0 &&
                             single.best.front().explained >= enough_evidence;
        return is_part ? single : found;
    }
    if (single.explains_all())
        for (const Cause& cause : single.best)
            if (cause.has_name)
                found.best.push_back(cause);
    return found;
}

} // namespace lockstep
