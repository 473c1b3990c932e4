#include "crosscheck/judge/hypothesis.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "crosscheck/judge/item_sample.hpp"
#include "crosscheck/judge/rounding_only.hpp"

namespace lockstep {
namespace {

using Host = Hypothesis::Host;

bool sums(const Mistake& mistake) {
    return mistake.change == Change::added_up || mistake.change == Change::units_added_up;
}

void add_named(std::vector<Hypothesis>& all, const NamedMistake& named, const JudgedPass& pass,
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
        all.push_back({.made = {named.mistake}, .named = {&named}});
    for (const std::array<float, 3>& c : constants) {
        Hypothesis& with = all.emplace_back(Hypothesis{.made = {named.mistake}, .named = {&named}});
        with.made.front().constants = c;
        with.text =
            c[1] == 0.0F && c[2] == 0.0F ? fmt::format(" ({})", c[0]) : fmt::format(" ({}, {}, {})", c[0], c[1], c[2]);
    }
}

void add_hosts(std::vector<Hypothesis>& all, const JudgedPass& pass) {
    if (!pass.surely_written)
        all.push_back({.host = Host::unwritten, .text = "items_not_written"});
    if (pass.earlier != nullptr)
        all.push_back({.host = Host::earlier_state, .text = "state_of_earlier_frame"});
    const std::span<const Field> fields = pass.gpu.fields();
    for (std::uint8_t f = 0; f < fields.size() && fields.size() > 1; ++f) {
        if (!pass.surely_written)
            all.push_back(
                {.host = Host::field_kept, .text = fmt::format("{}_not_written", fields[f].name), .fields = {f}});
        for (std::uint8_t g = 0; g < f; ++g)
            if (fields[f].components == fields[g].components && fields[f].scalar == fields[g].scalar)
                all.push_back({.host = Host::fields_swapped,
                               .text = fmt::format("{}_and_{}_swapped", fields[g].name, fields[f].name),
                               .fields = {g, f}});
    }
}

/// The named one that is this change; of a setting that is inverted the one that switches it, if one alone does. What
/// is named is made where the setting is not so by itself.
const NamedMistake* same_among(const std::vector<const NamedMistake*>& exact, const Mistake& mistake,
                               const std::vector<SeenSite>& sites, const JudgedPass& pass,
                               const std::vector<std::size_t>& items) {
    const auto found = std::ranges::find(exact, mistake, &NamedMistake::mistake);
    if (found != exact.end())
        return *found;
    const bool is_setting = std::ranges::any_of(sites, [&](const SeenSite& seen) {
        return seen.kind == SeenSite::Kind::setting && seen.site->id == mistake.site;
    });
    if (!is_setting || mistake.change != Change::inverted)
        return nullptr;
    const auto is_same = [&](const Mistake& named) {
        const auto words = [&](const Mistake& made, std::size_t item) {
            return pass.on_input().mistaken(pass.input(), item, pass.profile, std::array{made});
        };
        return std::ranges::all_of(items, [&](std::size_t i) { return words(named, i) == words(mistake, i); });
    };
    const NamedMistake* only = nullptr;
    for (const NamedMistake* one : exact)
        for (const Change change : {Change::always, Change::never})
            if (one->mistake == Mistake{.site = mistake.site, .change = change}) {
                if (only != nullptr)
                    return nullptr;
                only = one;
            }
    return only != nullptr && is_same(only->mistake) ? only : nullptr;
}

/// What an item becomes by what is made, of the input or of the state of the frame before.
std::vector<std::uint32_t> words_of(const Hypothesis& hypothesis, const JudgedPass& p, std::size_t item) {
    return hypothesis.host == Host::earlier_state
               ? p.pass.mistaken({*p.earlier, p.frame}, item, p.profile, hypothesis.made)
               : p.on_input().mistaken(p.input(), item, p.profile, hypothesis.made);
}

/// How far an item's words move, in ULP, where the same is written in other ways: a sum in another order, its turns
/// backwards. As much may a shader be off that makes the mistake in its own way.
double spread_of(const Hypothesis& hypothesis, const ItemLikeness& likeness, std::size_t item,
                 const std::vector<std::uint32_t>& words) {
    const JudgedPass& p = likeness.pass();
    std::vector<Mistake> ways{{.change = Change::sums_left_to_right},
                              {.change = Change::sums_right_to_left},
                              {.change = Change::portable_arithmetic}};
    for (const SeenSite& seen : p.on_input().sites(p.input(), item, p.profile))
        if (seen.kind == SeenSite::Kind::loop)
            ways.push_back(mistake_at(*seen.site, Change::backwards));
    double most = 0.0;
    for (const Mistake& way : ways) {
        Hypothesis other = hypothesis;
        other.made.push_back(way);
        most = std::max(most, likeness.ulps_between(item, words, words_of(other, p, item)));
    }
    return most;
}

/// Whether these are the GPU's, or come as near as what is made asks for.
bool fit(const Hypothesis& hypothesis, const ItemLikeness& likeness, std::size_t item,
         const std::vector<std::uint32_t>& words) {
    if (!hypothesis.named.empty() && likeness.are_within_leeway(item, words))
        return true;
    if (!hypothesis.rounds())
        return likeness.are_gpus(item, words);
    const double apart = likeness.ulps_from_gpus(item, words);
    if (apart <= rewritten_ulps)
        return true;
    // The terms of a sum may cancel, in some items and not in others.
    constexpr double most = 64.0 * rewritten_ulps, as_near = 4.0;
    return apart <= most && std::any_of(hypothesis.made.begin(), hypothesis.made.end(), sums) &&
           apart <= as_near * spread_of(hypothesis, likeness, item, words);
}

} // namespace

bool Hypothesis::rounds() const {
    if (loosely)
        return true;
    if (named.empty())
        return !made.empty();
    return std::any_of(named.begin(), named.end(), [](const NamedMistake* one) { return one->rounds(); });
}

int Hypothesis::rank() const {
    if (!named.empty())
        return text.empty() ? 0 : 1;
    if (host != Host::none)
        return 2;
    return alike != nullptr || text.starts_with("u_") ? 3 : 4;
}

std::vector<std::string> Hypothesis::names() const {
    std::vector<std::string> all;
    for (const NamedMistake* one : named)
        all.push_back(one->name);
    if (named.empty())
        all.push_back(alike != nullptr ? alike->name : text);
    return all;
}

std::string Hypothesis::meaning() const {
    switch (host) {
    case Host::unwritten:
        return "the pass left them as they were";
    case Host::earlier_state:
        return "the pass read the state of the frame before";
    case Host::field_kept:
        return "the field is as it was";
    case Host::fields_swapped:
        return "each of the two fields holds what the other should";
    case Host::none:
        break;
    }
    std::string meaning;
    for (const NamedMistake* one : named)
        meaning += (meaning.empty() ? "" : "; ") + one->meaning;
    if (!named.empty())
        return meaning + text;
    return alike != nullptr ? alike->meaning : "a change of the twin at one site";
}

std::vector<Hypothesis> hypotheses_of(const std::vector<const NamedMistake*>& named,
                                      const std::vector<const NamedMistake*>& exact, const JudgedPass& pass,
                                      const std::vector<std::size_t>& items) {
    std::vector<Hypothesis> all;
    for (const NamedMistake* one : named)
        add_named(all, *one, pass, items);
    add_hosts(all, pass);
    std::vector<SeenSite> sites;
    const std::vector<std::size_t> some = sample(items, 16);
    for (const std::size_t item : some)
        for (const SeenSite& site : pass.on_input().sites(pass.input(), item, pass.profile))
            if (std::find(sites.begin(), sites.end(), site) == sites.end())
                sites.push_back(site);
    for (const Mistake& mistake : mistakes_at(sites)) {
        if (std::any_of(all.begin(), all.end(), [&](const Hypothesis& h) { return h.made == std::vector{mistake}; }))
            continue;
        all.push_back({.made = {mistake},
                       .alike = same_among(exact, mistake, sites, pass, some),
                       .text = mistake_text(mistake, sites)});
    }
    return all;
}

bool explains(const Hypothesis& hypothesis, const ItemLikeness& likeness, std::size_t item) {
    const JudgedPass& p = likeness.pass();
    const std::vector<Component>& parts = likeness.parts();
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
    return fit(hypothesis, likeness, item, words_of(hypothesis, p, item));
}

bool has_bits(const Hypothesis& hypothesis, const ItemLikeness& likeness, std::size_t item) {
    return hypothesis.host == Host::none && likeness.are_gpus(item, words_of(hypothesis, likeness.pass(), item));
}

bool contradicts(const Hypothesis& hypothesis, const ItemLikeness& likeness, std::size_t item) {
    if (hypothesis.host != Host::none)
        return !explains(hypothesis, likeness, item);
    const std::vector<std::uint32_t> words = words_of(hypothesis, likeness.pass(), item);
    return !fit(hypothesis, likeness, item, words) && !likeness.may_be_gpus(item, words);
}

} // namespace lockstep
