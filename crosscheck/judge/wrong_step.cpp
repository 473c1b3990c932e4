#include "crosscheck/judge/wrong_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <source_location>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/judge/item_likeness.hpp"
#include "crosscheck/judge/item_table.hpp"
#include "reference/model/same_bits.hpp"
#include "reference/model/ulp.hpp"

namespace lockstep {
namespace {

using Kind = RecordedRow::Kind;

std::string line_of(const std::source_location& where) {
    if (where.line() == 0)
        return "";
    return fmt::format("{}:{}", std::filesystem::path(where.file_name()).filename().string(), where.line());
}

/// How many ULP a value lies outside of what is legal; 0 inside.
std::int64_t distance_to(const Interval& legal, Value value) {
    if (value.scalar != Scalar::float32) {
        const auto x = static_cast<double>(value.integer());
        return legal.any || (legal.low <= x && x <= legal.high)
                   ? 0
                   : static_cast<std::int64_t>(std::max(legal.low - x, x - legal.high));
    }
    if (legal.contains(value.real()))
        return 0;
    return std::min(ulp_distance(static_cast<float>(legal.low), value.real()),
                    ulp_distance(static_cast<float>(legal.high), value.real()));
}

/// A component of the item, its place among all of them, and the line of the twin that named it last.
struct NamedComponent {
    Component part;
    std::size_t place = 0;
    std::size_t named = 0; ///< how late in the step
    std::optional<std::source_location> where = {};
};

/// In the order in which the twin names them: what is named last follows from what is named before.
std::vector<NamedComponent> in_order_of_step(const JudgedPass& p, std::size_t item) {
    const Resource& about = p.gpu.about();
    const std::vector<RecordedRow> rows = p.on_input().record(p.input(), item, p.profile);
    std::vector<NamedComponent> parts;
    for (const Component c : components(about)) {
        NamedComponent& part = parts.emplace_back(NamedComponent{c, parts.size()});
        const std::string_view output = p.pass.output(about, c.field);
        for (std::size_t r = 0; r < rows.size(); ++r)
            if (rows[r].site->output == output || rows[r].site->label == output) {
                part.named = r;
                part.where = rows[r].where;
            }
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const NamedComponent& a, const NamedComponent& b) { return a.named < b.named; });
    return parts;
}

/// Where an item parts from an outcome: the first component outside, and how far.
struct Parting {
    std::size_t fitting = 0; ///< components before it
    std::int64_t ulps = 0;
};

Parting parting(const ItemOutcome& outcome, const View& gpu, std::size_t item,
                const std::vector<NamedComponent>& parts) {
    Parting at;
    for (const NamedComponent& c : parts) {
        at.ulps = distance_to(outcome.values[c.place], gpu.value(c.part.field, item, c.part.component));
        if (at.ulps != 0)
            return at;
        ++at.fitting;
    }
    return at;
}

/// A decision or choice of the step, answered otherwise.
struct Otherwise {
    std::string step, right, instead, where;
    std::vector<ToldValue> told; ///< besides the state
    std::optional<ChoiceOfTexels> choice = {};
};

ToldValue told(const Site& site, std::vector<float> values, int turn = -1) {
    return {std::string(site.output), std::move(values), turn};
}

/// What a choice was made among: of each turn of a loop over texels, its fetch and its offer.
struct Offers {
    std::vector<std::pair<RecordedRow, RecordedRow>> turns;

    [[nodiscard]] std::optional<ChosenTexel> texel(std::size_t turn) const {
        if (turn >= turns.size())
            return {};
        const auto& [fetch, offer] = turns[turn];
        return ChosenTexel{static_cast<int>(fetch.values[0]), static_cast<int>(fetch.values[1]), offer.values[0]};
    }
    /// Whose offer was the best, the last time that one was.
    [[nodiscard]] std::size_t chosen() const {
        std::size_t best = turns.size();
        for (std::size_t i = 0; i < turns.size(); ++i)
            if (turns[i].second.values[1] != 0.0F)
                best = i;
        return best;
    }
};

std::string choice_text(const std::optional<ChosenTexel>& chosen) {
    return chosen ? fmt::format("texel ({}, {}) at {:.9g}", chosen->x, chosen->y, chosen->offer) : "no texel";
}

/// Each that was not chosen, or nothing.
void add_choices(const RecordedRow& choice, const Offers& offers, std::vector<Otherwise>& found) {
    const std::size_t count = offers.turns.size(), right = offers.chosen();
    for (std::size_t chosen = 0; chosen <= count; ++chosen) {
        if (chosen == right)
            continue;
        const ChoiceOfTexels both{offers.texel(right), offers.texel(chosen)};
        Otherwise& one = found.emplace_back(Otherwise{std::string(choice.site->label),
                                                      choice_text(both.right) + " is right",
                                                      "took " + choice_text(both.taken),
                                                      line_of(choice.where),
                                                      {told(*choice.site, {chosen < count ? 1.0F : 0.0F})},
                                                      both});
        for (std::size_t i = 0; i < count; ++i) {
            const RecordedRow& fetch = offers.turns[i].first;
            one.told.push_back(told(*fetch.site, {fetch.values[0], fetch.values[1]}, static_cast<int>(i)));
            one.told.push_back(told(*choice.site, {i == chosen ? 1.0F : 0.0F}, static_cast<int>(i)));
        }
    }
}

/// Every decision and choice that can be told of, and was come by for the first time.
std::vector<Otherwise> decided_otherwise(const std::vector<RecordedRow>& step) {
    std::vector<Otherwise> found;
    std::vector<const Site*> seen;
    Offers offers;
    std::optional<RecordedRow> fetch;
    for (const RecordedRow& row : step) {
        if (row.kind == Kind::fetch)
            fetch = row.site->output_id != 0 ? std::optional(row) : std::nullopt;
        else if (row.kind == Kind::offer && fetch)
            offers.turns.emplace_back(*std::exchange(fetch, std::nullopt), row);
        else if (row.kind == Kind::choice && row.site->output_id != 0)
            add_choices(row, std::exchange(offers, {}), found);
        if (row.site->output_id == 0 || (row.kind != Kind::decision && row.kind != Kind::value) ||
            std::find(seen.begin(), seen.end(), row.site) != seen.end())
            continue;
        seen.push_back(row.site);
        if (row.kind != Kind::decision)
            continue;
        const bool yes = row.values[0] != 0.0F;
        found.push_back({std::string(row.site->label),
                         yes ? "yes is right" : "no is right",
                         yes ? "decided no" : "decided yes",
                         line_of(row.where),
                         {told(*row.site, {yes ? 0.0F : 1.0F})}});
    }
    return found;
}

/// Whether all that a run was told of the state is legal on its way, and came up there.
bool fits(const FollowedStep& step, const std::vector<ToldValue>& state) {
    std::size_t told = 0;
    for (const ReadingRow& row : step.rows)
        if (row.kind == Kind::value && row.is_told &&
            std::any_of(state.begin(), state.end(), [&](const ToldValue& v) { return v.output == row.site->output; })) {
            if (!row.is_legal())
                return false;
            ++told;
        }
    return told >= state.size() && step.undefined == Undefined::none;
}

/// The last decision that alone explains the state where it is made otherwise.
std::optional<Otherwise> wrong_decision(const JudgedPass& p, std::size_t item) {
    const std::vector<ToldValue> state = told_by_state(p.pass, p.gpu, item);
    std::vector<Otherwise> all = decided_otherwise(p.on_input().record(p.input(), item, p.profile));
    for (auto one = all.rbegin(); one != all.rend(); ++one) {
        one->told.insert(one->told.end(), state.begin(), state.end());
        if (fits(p.on_input().follow(p.input(), item, p.profile, p.known, one->told), state))
            return std::move(*one);
    }
    return {};
}

/// What a decision, loop or choice on the way did otherwise, where that leaves the item as it is: an offer that the
/// twin never made has no row, and is told of the choice that follows.
std::optional<Otherwise> wrong_search(const JudgedPass& p, std::size_t item) {
    const std::vector<RecordedRow> rows = p.on_input().record(p.input(), item, p.profile);
    const auto choice = std::find_if(rows.begin(), rows.end(), [](const RecordedRow& row) {
        return row.kind == Kind::choice && row.site->output_id != 0;
    });
    if (choice == rows.end())
        return {};
    std::vector<SeenSite> sites;
    using Seen = SeenSite::Kind;
    for (const SeenSite& seen : p.on_input().sites(p.input(), item, p.profile)) {
        const auto of_site = [&](const RecordedRow& row) { return row.site == seen.site; };
        if (std::none_of(rows.begin(), choice + 1, of_site) && std::any_of(choice, rows.end(), of_site))
            break; // what follows from the choice
        if (seen.kind == Seen::condition || seen.kind == Seen::setting || seen.kind == Seen::loop)
            sites.push_back(seen);
    }
    const ItemLikeness likeness(p);
    for (const Mistake& mistake : mistakes_at(sites))
        if (likeness.are_gpus(item, p.on_input().mistaken(p.input(), item, p.profile, {&mistake, 1})))
            return Otherwise{std::string(choice->site->label),
                             choice->values[0] != 0.0F ? "what was found is right" : "to find none is right",
                             "computed as with this mistake: " + mistake_text(mistake, sites),
                             line_of(choice->where),
                             {}};
    return {};
}

} // namespace

WrongStep wrong_step_of_item(const JudgedPass& p, std::size_t item) {
    const std::vector<NamedComponent> parts = in_order_of_step(p, item);
    const auto outcomes = p.on_input().outcomes(p.input(), item, p.profile, p.known, &p.gpu);
    const ItemOutcome* nearest = &outcomes.front();
    Parting best = parting(*nearest, p.gpu, item, parts);
    for (const ItemOutcome& outcome : outcomes) {
        const Parting at = parting(outcome, p.gpu, item, parts);
        if (std::pair(parts.size() - at.fitting, at.ulps) < std::pair(parts.size() - best.fitting, best.ulps)) {
            best = at;
            nearest = &outcome;
        }
    }
    const auto differs = [&](const NamedComponent& part) {
        return !same_bits(p.reference.value(part.part.field, item, part.part.component),
                          p.gpu.value(part.part.field, item, part.part.component));
    };
    // Of what is open every value is legal: then the first that differs.
    const auto first = std::find_if(parts.begin(), parts.end(), differs);
    const NamedComponent& wrong = best.fitting < parts.size() ? parts[best.fitting]
                                  : first != parts.end()      ? *first
                                                              : parts.back();
    const Component c = wrong.part;
    const Field& field = p.gpu.fields()[c.field];
    WrongStep step;
    step.step = field_label(field);
    step.operation = fmt::format("{} {} is legal", component_name(field, c.component),
                                 legal_text(nearest->values[wrong.place], field.scalar));
    if (wrong.where)
        step.where = line_of(*wrong.where);
    const Value reference = p.reference.value(c.field, item, c.component),
                gpu = p.gpu.value(c.field, item, c.component);
    if (best.ulps != 0)
        step.margin = field.scalar != Scalar::float32 ? fmt::format("off by {}", best.ulps)
                      : best.ulps == INT64_MAX        ? "NaN on one side"
                                                      : fmt::format("{} ULP outside", best.ulps);
    step.difference = {{p.pass.resource(), c.field}, item, c.component, reference, gpu, distance(reference, gpu)};
    if (best.ulps == 0)
        return step;
    auto decision = wrong_decision(p, item);
    if (!decision)
        decision = wrong_search(p, item);
    if (decision) {
        step.step = std::move(decision->step);
        step.operation = std::move(decision->right);
        step.gpu = std::move(decision->instead);
        step.where = std::move(decision->where);
        step.choice = decision->choice;
        step.margin.clear();
    }
    return step;
}

} // namespace lockstep
