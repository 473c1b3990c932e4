#include "reference/readings/mistake.hpp"

#include <algorithm>
#include <array>

namespace lockstep {
namespace {

using enum Change;
using Kind = SeenSite::Kind;

constexpr std::array names{"as it is",
                           "zero",
                           "one",
                           "negated",
                           "doubled",
                           "halved",
                           "1 / x",
                           "1 - x",
                           "one more",
                           "one less",
                           "half more",
                           "half less",
                           "x and y swapped",
                           "x for all",
                           "instead",
                           "plus",
                           "minus",
                           "times",
                           "y and z swapped",
                           "x and z swapped",
                           "y, z, x",
                           "z, x, y",
                           "by a formula",
                           "spoiled",
                           "decided otherwise",
                           "ranged otherwise",
                           "fetched elsewhere",
                           "chosen otherwise",
                           "inverted",
                           "always",
                           "never",
                           "or equal",
                           "reversed",
                           "dropped",
                           "or for and",
                           "first skipped",
                           "last skipped",
                           "backwards",
                           "outside is the edge",
                           "outside is the other side",
                           "outside is zero",
                           "left out",
                           "transposed",
                           "squared",
                           "sum of magnitudes",
                           "without x",
                           "without y",
                           "without z",
                           "the last taken",
                           "the first taken",
                           "the greatest taken",
                           "the last of equals",
                           "one a turn",
                           "all added up",
                           "all added up as unit vectors",
                           "sums left to right",
                           "sums right to left",
                           "sums fused",
                           "products fused",
                           "portable arithmetic",
                           "subnormals kept",
                           "item kept",
                           "handed over otherwise"};
static_assert(names.size() == static_cast<std::size_t>(handed_over) + 1);

constexpr std::array value_changes{zero,     one,      negated,  doubled,   halved,   reciprocal,
                                   opposite, one_more, one_less, half_more, half_less};
constexpr std::array whole_changes{zero, one, negated, halved, doubled, one_more, one_less};
constexpr std::array taken_from{instead, plus, minus, times};

void add_values(std::vector<Mistake>& found, const SeenSite& seen, std::span<const Change> changes) {
    for (const Change change : changes) {
        found.push_back({.site = seen.site->id, .change = change});
        for (int part = 0; seen.size > 1 && part < seen.size; ++part)
            found.push_back({.site = seen.site->id, .change = change, .part = part});
    }
    if (seen.size > 1)
        for (const Change change : {swapped, x_everywhere})
            found.push_back({.site = seen.site->id, .change = change});
    if (seen.size == 3)
        for (const Change change : {yz_swapped, xz_swapped, rotated, rotated_back})
            found.push_back({.site = seen.site->id, .change = change});
}

bool is_value(const SeenSite& seen) { return seen.kind == Kind::value || seen.kind == Kind::whole_value; }

} // namespace

std::string_view change_name(Change change) { return names[static_cast<std::size_t>(change)]; }

const CameBy::Kept* CameBy::find(std::uint32_t site) const {
    for (std::size_t step = 0; step < places; ++step) {
        const Kept& kept = kept_[(site + step) % places];
        if (kept.site == site)
            return &kept;
        if (kept.site == 0)
            return nullptr;
    }
    return nullptr;
}

void CameBy::keep(std::uint32_t site, std::span<const float> values) {
    for (std::size_t step = 0; step < places; ++step) {
        Kept& kept = kept_[(site + step) % places];
        if (kept.site != site && kept.site != 0)
            continue;
        kept.site = site;
        std::copy_n(values.begin(), std::min(values.size(), most_values), kept.values.begin());
        return;
    }
}

const std::array<float, CameBy::most_values>& CameBy::of(const Site& site) const {
    static constexpr std::array<float, most_values> none{};
    const Kept* kept = find(site.id);
    return kept == nullptr ? none : kept->values;
}

std::vector<Mistake> mistakes_at(std::span<const SeenSite> sites) {
    std::vector<Mistake> found;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const SeenSite& seen = sites[i];
        const auto all = [&](std::initializer_list<Change> changes) {
            for (const Change change : changes)
                found.push_back({.site = seen.site->id, .change = change});
        };
        switch (seen.kind) {
        case Kind::value:
            add_values(found, seen, value_changes);
            break;
        case Kind::whole_value:
            add_values(found, seen, whole_changes);
            break;
        case Kind::condition:
            all({inverted, always, never});
            for (int part = 0; part < seen.size; ++part)
                for (const Change change : {or_equal, reversed, dropped})
                    if (change != dropped || seen.size > 1)
                        found.push_back({.site = seen.site->id, .change = change, .part = part});
            if (seen.size > 1)
                all({and_is_or});
            break;
        case Kind::setting:
            all({inverted});
            break;
        case Kind::loop:
            all({first_skipped, last_skipped, backwards});
            break;
        case Kind::fetch:
            all({outside_is_edge, outside_is_other_side, outside_is_zero});
            break;
        case Kind::length:
            all({squared, sum_of_magnitudes, without_x, without_y, without_z});
            break;
        case Kind::optional_operation:
            all({not_done});
            break;
        case Kind::matrix:
            all({transposed});
            break;
        case Kind::choice:
            all({last_taken, first_taken, greatest_taken, last_of_equals, one_a_turn, added_up, units_added_up});
            break;
        }
        if (!is_value(seen))
            continue;
        for (std::size_t other = 0; other < i; ++other) {
            const SeenSite& source = sites[other];
            if (source.kind == seen.kind && source.size == seen.size && source.site->id != seen.site->id)
                for (const Change change : taken_from)
                    found.push_back({.site = seen.site->id, .change = change, .source = source.site->id});
            else if (source.kind == Kind::value && seen.kind == Kind::value && source.size == 1)
                found.push_back({.site = seen.site->id, .change = times, .source = source.site->id});
        }
    }
    return found;
}

std::string mistake_text(const Mistake& mistake, std::span<const SeenSite> sites) {
    const auto label = [&](std::uint32_t id) {
        const auto seen = std::find_if(sites.begin(), sites.end(), [&](const SeenSite& s) { return s.site->id == id; });
        return seen == sites.end() ? std::string("?") : std::string(seen->site->label);
    };
    std::string text = label(mistake.site) + ": ";
    if (mistake.part >= 0)
        text += "part " + std::to_string(mistake.part) + " ";
    text += change_name(mistake.change);
    return mistake.source != 0 ? text + " " + label(mistake.source) : text;
}

} // namespace lockstep
