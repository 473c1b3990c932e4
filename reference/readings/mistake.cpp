#include "reference/readings/mistake.hpp"

#include <algorithm>
#include <array>

namespace lockstep {
namespace {

constexpr std::array change_names{"as it is",
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
                                  "found otherwise",
                                  "inverted",
                                  "always",
                                  "never",
                                  "or equal",
                                  "reversed",
                                  "dropped",
                                  "!=",
                                  "<= for ==",
                                  ">= for ==",
                                  "with 0 on the left",
                                  "with 0 on the right",
                                  "with twice the right",
                                  "with half the right",
                                  "or for and",
                                  "the loop left if so",
                                  "the loop left if not",
                                  "all loops left if so",
                                  "all loops left if not",
                                  "first skipped",
                                  "last skipped",
                                  "first alone",
                                  "last alone",
                                  "first half",
                                  "last half",
                                  "every second",
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
                                  "compared with the first",
                                  "the second least",
                                  "compared with the one before",
                                  "one a turn",
                                  "all added up",
                                  "all added up as unit vectors",
                                  "the least so far added up",
                                  "the least so far added up as unit vectors",
                                  "sums left to right",
                                  "sums right to left",
                                  "sums fused",
                                  "products fused",
                                  "portable arithmetic",
                                  "subnormals kept",
                                  "item kept",
                                  "handed over otherwise"};
static_assert(change_names.size() == static_cast<std::size_t>(Change::handed_over) + 1);

constexpr std::array value_changes{Change::zero,     Change::one,        Change::negated,  Change::doubled,
                                   Change::halved,   Change::reciprocal, Change::opposite, Change::one_more,
                                   Change::one_less, Change::half_more,  Change::half_less};
constexpr std::array whole_changes{Change::zero,    Change::one,      Change::negated, Change::halved,
                                   Change::doubled, Change::one_more, Change::one_less};
constexpr std::array comparison_changes{
    Change::or_equal, Change::reversed,  Change::dropped,    Change::differs,       Change::at_most,
    Change::at_least, Change::left_zero, Change::right_zero, Change::right_doubled, Change::right_halved};
constexpr std::array taken_from{Change::instead, Change::plus, Change::minus, Change::times};

void add_values(std::vector<Mistake>& found, const SeenSite& seen, std::span<const Change> changes) {
    for (const Change change : changes) {
        found.push_back({.site = seen.site->id, .change = change});
        for (int part = 0; seen.size > 1 && part < seen.size; ++part)
            found.push_back({.site = seen.site->id, .change = change, .part = part});
    }
    if (seen.size > 1)
        for (const Change change : {Change::swapped, Change::x_everywhere})
            found.push_back({.site = seen.site->id, .change = change});
    if (seen.size == 3)
        for (const Change change : {Change::yz_swapped, Change::xz_swapped, Change::rotated, Change::rotated_back})
            found.push_back({.site = seen.site->id, .change = change});
}

/// That a condition leaves the loops it stands in, or a comparison of it does.
void add_ends_of_loops(std::vector<Mistake>& found, const SeenSite& seen) {
    constexpr std::array ends{Change::loop_left_if_so, Change::loop_left_if_not, Change::loops_left_if_so,
                              Change::loops_left_if_not};
    const std::size_t count = seen.loops > 1 ? ends.size() : seen.loops > 0 ? 2 : 0;
    for (const Change change : std::span(ends).first(count))
        for (int part = -1; part < (seen.size > 1 ? seen.size : 0); ++part)
            found.push_back({.site = seen.site->id, .change = change, .part = part});
}

bool is_value(const SeenSite& seen) {
    return seen.kind == SeenSite::Kind::value || seen.kind == SeenSite::Kind::whole_value;
}

} // namespace

std::string_view change_name(Change change) { return change_names[static_cast<std::size_t>(change)]; }

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
    static constexpr std::array<float, most_values> nothing{};
    const Kept* kept = find(site.id);
    return kept == nullptr ? nothing : kept->values;
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
        case SeenSite::Kind::value:
            add_values(found, seen, value_changes);
            break;
        case SeenSite::Kind::whole_value:
            add_values(found, seen, whole_changes);
            break;
        case SeenSite::Kind::condition:
            all({Change::inverted, Change::always, Change::never});
            for (int part = 0; part < seen.size; ++part)
                for (const Change change : comparison_changes)
                    if (change != Change::dropped || seen.size > 1)
                        found.push_back({.site = seen.site->id, .change = change, .part = part});
            if (seen.size > 1)
                all({Change::and_is_or});
            add_ends_of_loops(found, seen);
            break;
        case SeenSite::Kind::setting:
            all({Change::inverted});
            break;
        case SeenSite::Kind::loop:
            all({Change::first_skipped, Change::last_skipped, Change::first_alone, Change::last_alone,
                 Change::first_half, Change::last_half, Change::every_second, Change::backwards});
            break;
        case SeenSite::Kind::fetch:
            all({Change::outside_is_edge, Change::outside_is_other_side, Change::outside_is_zero});
            if (seen.loops > 0)
                all({Change::loop_left_if_not});
            if (seen.loops > 1)
                all({Change::loops_left_if_not});
            break;
        case SeenSite::Kind::length:
            all({Change::squared, Change::sum_of_magnitudes, Change::without_x, Change::without_y, Change::without_z});
            break;
        case SeenSite::Kind::optional_operation:
            all({Change::not_done});
            break;
        case SeenSite::Kind::matrix:
            all({Change::transposed});
            break;
        case SeenSite::Kind::choice:
            all({Change::last_taken, Change::first_taken, Change::greatest_taken, Change::last_of_equals,
                 Change::compared_with_first, Change::second_least, Change::compared_with_last, Change::one_a_turn,
                 Change::added_up, Change::units_added_up, Change::improving_added_up,
                 Change::improving_units_added_up});
            break;
        }
        if (!is_value(seen))
            continue;
        for (std::size_t other = 0; other < i; ++other) {
            const SeenSite& source = sites[other];
            if (source.kind == seen.kind && source.size == seen.size && source.site->id != seen.site->id)
                for (const Change change : taken_from)
                    found.push_back({.site = seen.site->id, .change = change, .source = source.site->id});
            else if (source.kind == SeenSite::Kind::value && seen.kind == SeenSite::Kind::value && source.size == 1)
                found.push_back({.site = seen.site->id, .change = Change::times, .source = source.site->id});
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
