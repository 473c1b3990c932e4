#include "crosscheck/text/witness.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "reference/model/error.hpp"
#include "reference/text/alignment.hpp"

namespace lockstep {
namespace {

/// "compares 2 and 3".
std::string compared(const text::Trace& trace, const text::TraceRow& row) {
    const auto operands = trace.of(row);
    return operands.size() == 2 ? fmt::format("compares {} and {}", text::value_text(operands[0].bits, row.is_real),
                                              text::value_text(operands[1].bits, row.is_real))
                                : "asks";
}

std::string what_of(const text::Trace& trace, const text::Suspect& suspect) {
    const text::TraceRow& row = trace.rows[suspect.row];
    if (row.kind == text::TraceRow::Kind::store)
        return fmt::format("writes {}, which the reference does not write there",
                           text::value_text(row.bits, row.is_real));
    if (row.kind == text::TraceRow::Kind::comparison)
        return fmt::format("{}, which the reference does not{}", compared(trace, row),
                           suspect.repairs ? "; with the other answer all that it writes is right" : "");
    const std::string made = fmt::format("{} {}", row.kind == text::TraceRow::Kind::load ? "reads" : "makes",
                                         text::value_text(row.bits, row.is_real));
    return suspect.repairs ? fmt::format("{}; with {} all that it writes is right", made,
                                         text::value_text(suspect.repaired, row.is_real))
                           : fmt::format("{}, which the reference does not", made);
}

/// What speaks for a line.
struct Line {
    double score = 0.0;
    double loudest = 0.0;      ///< of one item
    std::string what;          ///< of that item
    bool only_compares = true; ///< and no other answer repairs
};

} // namespace

text::TracedRun common_run(const WitnessedText& text, std::uint32_t invocation,
                           std::span<const text::ForcedRow> forced) {
    constexpr std::uint64_t behind = std::uint64_t{1} << 48U;
    text::TracedRun run = text.run(invocation, forced);
    const auto name = [&](text::WrittenPlace& place) {
        const std::optional<text::WrittenPlace> common = text.common(place);
        if (common)
            place = *common;
        else
            place.word += behind;
        return common.has_value();
    };
    std::vector<text::TracedWord> words;
    for (text::TracedWord word : std::exchange(run.words, {}))
        if (name(word.place))
            words.push_back(word);
    run.words = std::move(words);
    std::sort(run.words.begin(), run.words.end(), [](const auto& a, const auto& b) { return a.place < b.place; });
    for (text::TraceRow& row : run.trace.rows)
        if (row.kind == text::TraceRow::Kind::load || row.kind == text::TraceRow::Kind::store)
            name(row.place);
    return run;
}

std::string line_of(const WitnessLine& line) { return fmt::format("{}: {}: {}", line.where, line.text, line.what); }

std::vector<WitnessLine> witness_lines(const WitnessedText& wrong, const WitnessedText& reference,
                                       std::span<const ItemWriters> items, std::span<const ItemWriters> others,
                                       const std::function<bool(std::string_view where)>& is_own,
                                       bool is_written_otherwise) try {
    constexpr double repair = 3.0, repair_of_output = 1.0, no_repair = 0.5, floor_of_score = 0.2;
    constexpr std::size_t most_lines = 3;
    const text::Program &program = wrong.program, &expected = reference.program;
    const auto line_in = [&](const text::Program& of, const text::Trace& trace,
                             const text::TraceRow& row) -> std::optional<std::uint32_t> {
        for (const std::uint32_t line : text::lines_of(of, trace, row))
            if (is_own(of.line_name(line)))
                return line;
        return {};
    };
    const auto line_of = [&](const text::Trace& trace, const text::TraceRow& row) {
        return line_in(program, trace, row);
    };
    std::map<std::uint32_t, Line> missing; // lines of the reference
    std::map<std::uint32_t, Line> lines;
    std::size_t looked_at = 0;
    for (const auto& [own, invocation] : items) {
        if (!invocation && !own)
            continue;
        const std::uint32_t number = own.value_or(invocation.value_or(0));
        const text::TracedRun run = common_run(wrong, number),
                              right = common_run(reference, invocation.value_or(number));
        if (run.words == right.words)
            continue; // the text does not differ: the driver does
        ++looked_at;
        const std::vector<text::Suspect> suspects =
            text::suspects_of(run, right, [&](std::span<const text::ForcedRow> forced) {
                return common_run(wrong, number, forced).words;
            });
        std::map<std::uint32_t, double> of_item;
        for (const text::Suspect& one : suspects) {
            const text::TraceRow& row = run.trace.rows[one.row];
            if (is_written_otherwise && row.kind == text::TraceRow::Kind::load &&
                row.place.space == text::WrittenPlace::Space::shared) // another invocation made it
                continue;
            const double weight = one.repairs ? (one.is_output ? repair_of_output : repair) : no_repair;
            const std::optional<std::uint32_t> own_line = line_of(run.trace, run.trace.rows[one.row]);
            if (!own_line)
                continue;
            const std::uint32_t at = *own_line;
            of_item[at] = std::max(of_item[at], weight);
            Line& line = lines[at];
            line.only_compares =
                line.only_compares && !one.repairs && run.trace.rows[one.row].kind == text::TraceRow::Kind::comparison;
            if (weight > line.loudest) {
                line.loudest = weight;
                line.what = what_of(run.trace, one);
            }
        }
        std::set<std::uint32_t> missed, counted_lines;
        for (const std::uint32_t row : text::missing_rows(right, run)) {
            const text::TraceRow& one = right.trace.rows[row];
            constexpr std::uint32_t counted = 16; // 0 and what loops count say nothing
            const bool is_common = one.is_real ? (one.bits & 0x7fffffffU) == 0 : one.bits <= counted;
            const bool is_comparison = one.kind == text::TraceRow::Kind::comparison;
            const bool is_store = one.kind == text::TraceRow::Kind::store;
            // A comparison counts where it keeps the reference from writing at all.
            const auto at = (is_comparison ? !right.words.empty() : is_common && !is_store)
                                ? std::nullopt
                                : line_in(expected, right.trace, one);
            if (!at)
                continue;
            if (missing[*at].what.empty())
                missing[*at].what = is_comparison ? compared(right.trace, one)
                                                  : fmt::format("{} {}", is_store ? "writes" : "makes",
                                                                text::value_text(one.bits, one.is_real));
            (one.is_real || is_comparison || is_store ? missed : counted_lines).insert(*at);
        }
        if (missed.empty()) // indices and what loops count differ with the way a text is written
            missed = std::move(counted_lines);
        for (const std::uint32_t at : missed)
            missing[at].score += 1.0 / static_cast<double>(missed.size());
        for (const auto& [at, weight] : of_item)
            lines[at].score += weight / static_cast<double>(of_item.size());
    }
    if (looked_at == 0)
        return {};
    // A line that differs where both write the same is another way to write it.
    std::map<std::uint32_t, double> excused;
    std::size_t alike = 0;
    for (const auto& [own, invocation] : others) {
        if (!invocation || !own)
            continue;
        const text::TracedRun run = common_run(wrong, *own), right = common_run(reference, *invocation);
        if (run.words != right.words)
            continue;
        ++alike;
        std::set<std::uint32_t> unmatched;
        for (const std::uint32_t row : text::unmatched_rows(run, right))
            if (const auto line = line_of(run.trace, run.trace.rows[row]))
                unmatched.insert(*line);
        for (const std::uint32_t line : unmatched)
            excused[line] += 1.0;
    }
    std::vector<std::pair<double, std::uint32_t>> ranked;
    for (const auto& [at, line] : lines) {
        const double share = alike == 0 ? 0.0 : excused[at] / static_cast<double>(alike);
        ranked.emplace_back(line.score / static_cast<double>(looked_at) * (1.0 - 0.8 * share), at);
    }
    std::sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    std::vector<WitnessLine> found;
    std::set<std::string> only_compared;
    for (const auto& [score, at] : ranked) {
        if (found.size() == most_lines || score < floor_of_score || score < 0.2 * ranked.front().first)
            break;
        if (lines[at].only_compares && is_written_otherwise)
            continue;
        if (lines[at].only_compares)
            only_compared.insert(program.line_name(at));
        found.push_back({program.line_name(at), wrong.line_text(at), lines[at].what});
    }
    // What the reference makes and the text never does, where no line of the text repairs anything.
    const bool repairs = !ranked.empty() && lines[ranked.front().second].loudest > repair_of_output;
    const auto most = std::max_element(missing.begin(), missing.end(),
                                       [](const auto& a, const auto& b) { return a.second.score < b.second.score; });
    if (!repairs && most != missing.end() && most->second.score > 0.3 * static_cast<double>(looked_at)) {
        if (alike == 0) // then what loops of a text compare that is written otherwise differs anywhere
            std::erase_if(found, [&](const WitnessLine& one) { return only_compared.contains(one.where); });
        found.insert(found.begin(), {fmt::format("{}{}", expected.line_name(most->first), reference_mark),
                                     reference.line_text(most->first),
                                     fmt::format("{}, which this text never does", most->second.what)});
    }
    found.resize(std::min(found.size(), most_lines));
    return found;
} catch (const Error&) {
    return {}; // of what is not run apart from others nothing is known
}

} // namespace lockstep
