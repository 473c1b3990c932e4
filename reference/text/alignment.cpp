#include "reference/text/alignment.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <unordered_set>

#include "reference/model/error.hpp"
#include "reference/text/program.hpp"

namespace lockstep::text {
namespace {

using Kind = TraceRow::Kind;

/// Zero and small integers occur anywhere: what they were made of counts.
bool says_little(const TraceRow& row) {
    constexpr std::uint32_t small = 4096;
    if (row.is_real)
        return (row.bits & 0x7fffffffU) == 0 || row.bits == std::bit_cast<std::uint32_t>(1.0F);
    return row.bits < small || row.bits > ~small;
}

/// What one run came by.
class Seen {
  public:
    explicit Seen(const Trace& trace) {
        for (const TraceRow& row : trace.rows)
            switch (row.kind) {
            case Kind::load:
                places_.insert(row.place);
                values_.insert(row.bits);
                break;
            case Kind::comparison:
                answers_[made_of(trace, row)].insert(row.bits);
                break;
            case Kind::operation:
                made_of_.insert(made_of(trace, row));
                if (!says_little(row))
                    values_.insert(row.bits);
                break;
            case Kind::store:
                break;
            }
    }
    [[nodiscard]] bool has(const Trace& trace, const TraceRow& row) const {
        if (row.kind == Kind::load && row.place.space == WrittenPlace::Space::shared) // a value on its way
            return places_.contains(row.place) || says_little(row) || values_.contains(row.bits);
        if (row.kind == Kind::load)
            return places_.contains(row.place);
        if (row.kind == Kind::comparison)
            return answers_.contains(made_of(trace, row));
        if (says_little(row))
            return made_of_.contains(made_of(trace, row));
        return values_.contains(row.bits);
    }
    /// Whether it compared the same numbers, and never with this answer.
    [[nodiscard]] bool answers_otherwise(const Trace& trace, const TraceRow& row) const {
        const auto found = answers_.find(made_of(trace, row));
        return found != answers_.end() && !found->second.contains(row.bits);
    }
    [[nodiscard]] bool has_value(std::uint32_t bits) const { return values_.contains(bits); }

  private:
    /// A comparison by its operands, whichever way round; another operation by its code, too.
    static std::vector<std::uint32_t> made_of(const Trace& trace, const TraceRow& row) {
        std::vector<std::uint32_t> key;
        for (const TraceOperand& operand : trace.of(row))
            key.push_back(operand.bits);
        std::sort(key.begin(), key.end());
        key.push_back(row.kind == Kind::comparison ? (row.is_real ? 0xffffU : 0xfffeU) : row.op);
        return key;
    }

    std::set<WrittenPlace> places_;
    std::set<std::vector<std::uint32_t>> made_of_;
    std::map<std::vector<std::uint32_t>, std::set<std::uint32_t>> answers_;
    std::unordered_set<std::uint32_t> values_;
};

std::vector<bool> matched_in(const Trace& trace, const Seen& other) {
    std::vector<bool> matched;
    for (const TraceRow& row : trace.rows)
        matched.push_back(row.kind == Kind::store || other.has(trace, row));
    return matched;
}

std::set<WrittenPlace> places_that_differ(const std::vector<TracedWord>& a, const std::vector<TracedWord>& b) {
    std::map<WrittenPlace, std::uint32_t> words;
    for (const TracedWord& word : b)
        words[word.place] = word.bits;
    std::set<WrittenPlace> differ;
    for (const TracedWord& word : a) {
        const auto same = words.find(word.place);
        if (same == words.end() || same->second != word.bits)
            differ.insert(word.place);
        if (same != words.end())
            words.erase(same);
    }
    for (const auto& [place, bits] : words)
        differ.insert(place);
    return differ;
}

/// Rows without a counterpart that lead to some of `places`, or `to_decisions`, and whose operands all have one.
std::vector<std::uint32_t> front_of(const Trace& trace, const std::vector<bool>& matched,
                                    const std::set<WrittenPlace>& places, bool to_decisions = true) {
    std::vector<std::uint32_t> open, front;
    std::vector<bool> seen(trace.rows.size());
    const auto visit = [&](std::uint32_t row) {
        if (row != TraceOperand::no_row && !matched[row] && !seen[row]) {
            seen[row] = true;
            open.push_back(row);
        }
    };
    for (std::uint32_t row = 0; row < trace.rows.size(); ++row) {
        const TraceRow& one = trace.rows[row];
        if (one.kind == Kind::comparison && to_decisions)
            visit(row);
        if (one.kind == Kind::store && places.contains(one.place))
            for (const TraceOperand& operand : trace.of(one))
                visit(operand.row);
    }
    while (!open.empty()) {
        const std::uint32_t row = open.back();
        open.pop_back();
        bool is_first = true;
        for (const TraceOperand& operand : trace.of(trace.rows[row]))
            if (operand.row != TraceOperand::no_row && !matched[operand.row]) {
                is_first = false;
                visit(operand.row);
            }
        if (is_first)
            front.push_back(row);
    }
    std::sort(front.begin(), front.end());
    return front;
}

/// Stores to some of `places` of what both runs came by, or of a constant.
std::vector<std::uint32_t> stores_of_matched(const Trace& trace, const std::vector<bool>& matched,
                                             const std::set<WrittenPlace>& places) {
    std::vector<std::uint32_t> stores;
    for (std::uint32_t row = 0; row < trace.rows.size(); ++row) {
        const TraceRow& one = trace.rows[row];
        if (one.kind != Kind::store || !places.contains(one.place))
            continue;
        const std::uint32_t value = trace.operands[one.first].row;
        if (value == TraceOperand::no_row || matched[value])
            stores.push_back(row);
    }
    return stores;
}

/// Of each line the first rows and the last, so that no loop takes the place of all else.
std::vector<std::uint32_t> some_of_each_line(const Trace& trace, const std::vector<std::uint32_t>& rows,
                                             std::size_t most) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> by_line;
    for (const std::uint32_t row : rows)
        by_line[trace.rows[row].line].push_back(row);
    const std::size_t of_each = std::max<std::size_t>(2, most / std::max<std::size_t>(by_line.size(), 1));
    std::vector<std::uint32_t> some;
    for (const auto& [line, all] : by_line)
        for (std::size_t k = 0; k < all.size(); ++k)
            if (k + 1 < of_each || k + 1 == all.size())
                some.push_back(all[k]);
    std::sort(some.begin(), some.end());
    return some;
}

/// How far two floats are apart, in units of the larger; of others by their bits.
double distance(std::uint32_t a, std::uint32_t b) {
    const double x = std::bit_cast<float>(a), y = std::bit_cast<float>(b);
    if (!std::isfinite(x) || !std::isfinite(y))
        return 2.0;
    return x == y ? 0.0 : std::abs(x - y) / std::max(std::abs(x), std::abs(y));
}

/// The rows of a trace that are components of one result, by the first.
struct Components {
    std::uint32_t first = 0, count = 0;
};

/// All results of several components.
std::vector<Components> results_of(const Trace& trace) {
    std::vector<Components> all;
    const auto is_next = [&](std::uint32_t row) {
        const TraceRow &one = trace.rows[row - 1], &next = trace.rows[row];
        return one.step == next.step && one.calls == next.calls && one.kind == next.kind && one.is_real == next.is_real;
    };
    for (std::uint32_t first = 0, row = 1; row <= trace.rows.size(); ++row)
        if (row == trace.rows.size() || !is_next(row)) {
            const Kind kind = trace.rows[first].kind;
            if (row - first > 1 && row - first <= 4 && (kind == Kind::operation || kind == Kind::load))
                all.push_back({first, row - first});
            first = row;
        }
    return all;
}

} // namespace

std::vector<Suspect> suspects_of(const TracedRun& wrong, const TracedRun& right,
                                 const std::function<std::vector<TracedWord>(std::span<const ForcedRow>)>& again,
                                 bool turns_all) {
    constexpr std::size_t most_rows = 24, most_values = 32, most_vectors = 12;
    const Seen in_right(right.trace), in_wrong(wrong.trace);
    const std::set<WrittenPlace> places = places_that_differ(wrong.words, right.words);
    const std::vector<bool> matched = matched_in(wrong.trace, in_right);
    std::vector<std::uint32_t> front = front_of(wrong.trace, matched, places);
    if (front.size() > most_rows)
        front = some_of_each_line(wrong.trace, front, most_rows);
    std::set<std::uint32_t> outputs;
    for (const TraceRow& row : wrong.trace.rows)
        if (row.kind == Kind::store && places.contains(row.place))
            outputs.insert(wrong.trace.operands[row.first].row);
    std::vector<std::uint32_t> reals, whole; // that the wrong run lacks
    for (const TraceRow& row : right.trace.rows)
        if (row.kind == Kind::load || (row.kind == Kind::operation && !in_wrong.has(right.trace, row)))
            (row.is_real ? reals : whole).push_back(row.bits);
    const auto all_repair = [&](std::span<const ForcedRow> forced) {
        try {
            return again(forced) == right.words;
        } catch (const Error&) { // a loop without an end, or what is not run apart
            return false;
        }
    };
    const auto repairs = [&](const ForcedRow& forced) { return all_repair({&forced, 1}); };
    std::set<std::uint32_t> turned_steps;
    /// With the other answer at this row, or at all from it on.
    const auto turns_right = [&](std::uint32_t row) {
        const TraceRow& one = wrong.trace.rows[row];
        const std::uint32_t answer = one.bits ^ 1U;
        return repairs({row, answer}) || (turned_steps.insert(one.step).second && repairs({row, answer, one.step}));
    };
    std::vector<Suspect> all;
    for (const std::uint32_t row : front) {
        const TraceRow& one = wrong.trace.rows[row];
        Suspect suspect{.row = row, .is_output = outputs.contains(row)};
        std::vector<std::uint32_t> values;
        if (one.kind == Kind::comparison) {
            suspect.repairs = turns_right(row);
            suspect.repaired = one.bits ^ 1U;
        } else {
            values = one.is_real ? reals : whole;
            std::sort(values.begin(), values.end());
            values.erase(std::unique(values.begin(), values.end()), values.end());
            std::stable_sort(values.begin(), values.end(), [&](std::uint32_t a, std::uint32_t b) {
                return distance(a, one.bits) < distance(b, one.bits);
            });
            values.resize(std::min(values.size(), most_values));
        }
        for (const std::uint32_t bits : values)
            if (bits != one.bits && repairs({row, bits})) {
                suspect.repairs = true;
                suspect.repaired = bits;
                break;
            }
        all.push_back(suspect);
    }
    // A vector is one result: its components together, by those of a vector of the right run.
    const auto suspect_at = [&](std::uint32_t row) { return std::ranges::find(all, row, &Suspect::row); };
    const std::vector<Components> of_right = results_of(right.trace);
    for (const Components& own : results_of(wrong.trace)) {
        const TraceRow* const rows = &wrong.trace.rows[own.first];
        const auto is_open = [&](std::uint32_t c) {
            const auto found = suspect_at(own.first + c);
            return found != all.end() && !found->repairs;
        };
        std::uint32_t open = 0;
        for (std::uint32_t c = 0; c < own.count; ++c)
            open += is_open(c) ? 1 : 0;
        if (open < 2)
            continue;
        std::vector<std::pair<double, std::uint32_t>> nearest; // of the right run's, by their first rows
        for (const Components& other : of_right) {
            const TraceRow* const values = &right.trace.rows[other.first];
            if (other.count != own.count || values->is_real != rows->is_real)
                continue;
            double apart = values->op == rows->op ? 0.0 : 1.0;
            bool is_new = false;
            for (std::uint32_t c = 0; c < own.count; ++c) {
                apart += distance(values[c].bits, rows[c].bits);
                is_new = is_new || !in_wrong.has(right.trace, values[c]);
            }
            if (is_new)
                nearest.emplace_back(apart, other.first);
        }
        std::sort(nearest.begin(), nearest.end());
        nearest.resize(std::min(nearest.size(), most_vectors));
        for (const auto& [apart, first] : nearest) {
            std::vector<ForcedRow> forced;
            for (std::uint32_t c = 0; c < own.count; ++c)
                forced.push_back({own.first + c, right.trace.rows[first + c].bits});
            if (!all_repair(forced))
                continue;
            for (std::uint32_t c = 0; c < own.count; ++c)
                if (const auto found = suspect_at(own.first + c); found != all.end()) {
                    found->repairs = true;
                    found->repaired = forced[c].bits;
                }
            break;
        }
    }
    // The same comparison, otherwise asked, and those of what the right run never came by: what repairs tells the
    // mistake from another way to write it.
    std::vector<std::uint32_t> turned;
    for (std::uint32_t row = 0; row < wrong.trace.rows.size(); ++row)
        if (const TraceRow& one = wrong.trace.rows[row];
            one.kind == Kind::comparison && (in_right.answers_otherwise(wrong.trace, one) ||
                                             (!matched[row] && !std::ranges::binary_search(front, row))))
            turned.push_back(row);
    if (turns_all || std::ranges::none_of(all, [](const Suspect& one) { return one.repairs && !one.is_output; }))
        for (const std::uint32_t row : some_of_each_line(wrong.trace, turned, most_rows))
            if (turns_right(row))
                all.push_back({.row = row, .repairs = true, .repaired = wrong.trace.rows[row].bits ^ 1U});
    // A right value in the wrong place: the store itself, unless a row before it explains all that is wrong.
    if (std::ranges::none_of(all, [](const Suspect& one) { return one.repairs && !one.is_output; }))
        for (const std::uint32_t row : stores_of_matched(wrong.trace, matched, places))
            all.push_back({.row = row, .is_output = true});
    return all;
}

std::vector<std::uint32_t> missing_rows(const TracedRun& right, const TracedRun& wrong) {
    const std::vector<bool> matched = matched_in(right.trace, Seen(wrong.trace));
    std::set<WrittenPlace> places = places_that_differ(right.words, wrong.words);
    // What leads to decisions alone differs with the way a text is written; where nothing is written it is all there
    // is.
    std::vector<std::uint32_t> rows = front_of(right.trace, matched, places, right.words.empty());
    for (const TracedWord& word : wrong.words)
        places.erase(word.place);
    // What is stored of a value that both have: the store itself.
    const std::vector<std::uint32_t> stores = stores_of_matched(right.trace, matched, places);
    rows.insert(rows.end(), stores.begin(), stores.end());
    return rows;
}

std::vector<std::uint32_t> unmatched_rows(const TracedRun& run, const TracedRun& other) {
    const std::vector<bool> matched = matched_in(run.trace, Seen(other.trace));
    std::vector<std::uint32_t> rows;
    for (std::uint32_t row = 0; row < matched.size(); ++row)
        if (!matched[row])
            rows.push_back(row);
    return rows;
}

} // namespace lockstep::text
