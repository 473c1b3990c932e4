#include "crosscheck/text/witness.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/text/stage_text.hpp"
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

std::set<std::string> lines_in(const ShaderSource& stage) {
    std::set<std::string> lines;
    const auto count = static_cast<std::uint32_t>(std::ranges::count(stage.text, '\n')) + 1;
    for (std::uint32_t line = 1; line <= count; ++line)
        lines.insert(line_text(stage, line));
    return lines;
}

/// Lines that a row stands on: its own, then those of the calls that it is in; of files that are the user's.
struct Chain {
    std::vector<std::uint32_t> lines;
    bool is_called = false; ///< the row's own line lies in a file that is none of the user's
};

class OwnLines {
  public:
    OwnLines(const text::Program& program, const std::function<bool(std::string_view where)>& is_own)
        : program_(program), is_own_(is_own) {}
    [[nodiscard]] Chain chain(const text::Trace& trace, const text::TraceRow& row) {
        Chain chain;
        for (const std::uint32_t line : text::lines_of(program_, trace, row))
            if (!is_own(line))
                chain.is_called = chain.is_called || chain.lines.empty();
            else if (chain.lines.empty() || chain.lines.back() != line)
                chain.lines.push_back(line);
        return chain;
    }

  private:
    bool is_own(std::uint32_t line) {
        const auto [known, is_new] = known_.try_emplace(line);
        if (is_new)
            known->second = is_own_(program_.line_name(line));
        return known->second;
    }
    const text::Program& program_;
    const std::function<bool(std::string_view where)>& is_own_;
    std::map<std::uint32_t, bool> known_;
};

/// Which calls of a line were come by, and which of them are blamed. Where one of several is, the call is at fault, and
/// not the function; so it is where both texts have the function's line and not the call's.
class Calls {
  public:
    bool prefers_callers = false;
    void come_by(const Chain& chain) { add(all_, chain.lines); }
    void blame(const Chain& chain) { add(blamed_, chain.lines); }
    [[nodiscard]] std::uint32_t line_of(const std::vector<std::uint32_t>& chain,
                                        const std::function<bool(std::uint32_t)>& is_common) const {
        if (const auto own = std::ranges::find_if_not(chain, is_common);
            own != chain.end() && std::ranges::any_of(chain, is_common))
            return *own;
        // A helper of the reference's says less where the text has it not than the line that calls it.
        std::size_t at = prefers_callers && chain.size() > 2 && blamed_.at(chain.front()).size() == 1 ? 1 : 0;
        while (at + 1 < chain.size() && blamed_.at(chain[at]).size() == 1 && all_.at(chain[at]).size() > 1)
            ++at;
        return chain[at];
    }

  private:
    using CallsOfLines = std::map<std::uint32_t, std::set<std::uint32_t>>;
    static void add(CallsOfLines& to, const std::vector<std::uint32_t>& chain) {
        for (std::size_t at = 0; at + 1 < chain.size(); ++at)
            to[chain[at]].insert(chain[at + 1]);
    }
    CallsOfLines all_, blamed_;
};

/// What speaks for a line.
struct Line {
    double score = 0.0;
    double loudest = 0.0;      ///< of one item
    std::string what;          ///< of that item
    bool only_compares = true; ///< and no other answer repairs
    bool repairs = false;      ///< of the reference's: with the other answer it writes what the text does
};

/// What one row of an item's run says of its line.
struct Blame {
    std::size_t item = 0;
    Chain chain;
    double weight = 0.0;
    std::string what;
    bool only_compares = false, repairs = false;
};

/// By line; each item's rows share what the item says.
std::map<std::uint32_t, Line> lines_by(const std::vector<Blame>& blames, const Calls& calls,
                                       const std::function<bool(std::uint32_t)>& is_common) {
    constexpr double of_common = 0.3; // a line that both texts have
    std::map<std::size_t, std::map<std::uint32_t, double>> by_item;
    std::map<std::uint32_t, Line> lines;
    for (const Blame& one : blames) {
        const std::uint32_t at = calls.line_of(one.chain.lines, is_common);
        // Of a call of what is not the user's, and of a decision that the text never comes to, that both texts have the
        // line says nothing.
        const bool says_less = is_common(at) && !one.chain.is_called && !one.repairs;
        const double own_weight = (says_less ? of_common : 1.0) * one.weight;
        double& weight = by_item[one.item][at];
        weight = std::max(weight, own_weight);
        Line& line = lines[at];
        line.only_compares = line.only_compares && one.only_compares;
        line.repairs = line.repairs || one.repairs;
        if (one.weight > line.loudest) {
            line.loudest = one.weight;
            line.what = one.what;
        }
    }
    for (const auto& [item, weights] : by_item) {
        double all = 0.0;
        for (const auto& [at, weight] : weights)
            all += weight * weight;
        for (const auto& [at, weight] : weights) // beside what repairs, the others say little
            lines[at].score += weight * weight * weight / all;
    }
    return lines;
}

/// That another integer keeps what is wrong from being written says as little as that the right output does.
constexpr double repair = 3.0, repair_of_output = 1.0, no_repair = 0.5;

/// What the reference's run of an item came by, and the text's never: lines of the reference.
std::vector<Blame> missing_of(const text::TracedRun& right, const text::TracedRun& run, std::size_t item,
                              OwnLines& lines) {
    std::vector<Blame> missed, counted_lines;
    for (const std::uint32_t row : text::missing_rows(right, run)) {
        const text::TraceRow& one = right.trace.rows[row];
        constexpr std::uint32_t counted = 16; // 0 and what loops count say nothing
        const bool is_common = one.is_real ? (one.bits & 0x7fffffffU) == 0 : one.bits <= counted;
        const bool is_comparison = one.kind == text::TraceRow::Kind::comparison;
        const bool is_store = one.kind == text::TraceRow::Kind::store;
        // A comparison counts where it keeps the reference from writing at all.
        if (is_comparison ? !right.words.empty() : is_common && !is_store)
            continue;
        Chain chain = lines.chain(right.trace, one);
        if (chain.lines.empty())
            continue;
        std::string what = is_comparison ? compared(right.trace, one)
                                         : fmt::format("{} {}", is_store ? "writes" : "makes",
                                                       text::value_text(one.bits, one.is_real));
        (one.is_real || is_comparison || is_store ? missed : counted_lines)
            .push_back({item, std::move(chain), 1.0, std::move(what)});
    }
    // Indices and what loops count differ with the way a text is written.
    return missed.empty() ? counted_lines : missed;
}

/// A comparison that the text leaves out: with its other answer the reference writes what the text does. Of several
/// that each do, none is known to be the one, unless the text has the others' lines.
std::vector<Blame>
left_out_of(const text::TracedRun& right, const text::TracedRun& run, std::size_t item, OwnLines& lines,
            const std::function<bool(std::uint32_t)>& is_common,
            const std::function<std::vector<text::TracedWord>(std::span<const text::ForcedRow>)>& again) {
    std::vector<Blame> found;
    for (const text::Suspect& one : text::suspects_of(right, run, again, true)) {
        const text::TraceRow& row = right.trace.rows[one.row];
        Chain chain = lines.chain(right.trace, row);
        if (one.repairs && row.kind == text::TraceRow::Kind::comparison && !chain.lines.empty())
            found.push_back({item, std::move(chain), repair, compared(right.trace, row), false, true});
    }
    const auto are_one = [&] {
        return std::ranges::all_of(found,
                                   [&](const Blame& one) { return one.chain.lines == found.front().chain.lines; });
    };
    if (!are_one())
        std::erase_if(found, [&](const Blame& one) { return is_common(one.chain.lines.front()); });
    return are_one() ? found : std::vector<Blame>();
}

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
    constexpr double floor_of_score = 0.2;
    constexpr std::size_t most_lines = 3;
    const text::Program &program = wrong.program, &expected = reference.program;
    std::vector<Blame> blames, missing_blames;
    OwnLines own_lines(program, is_own), expected_lines(expected, is_own);
    const std::set<std::string> texts = lines_in(wrong.source), expected_texts = lines_in(reference.source);
    const auto is_common = [&](std::uint32_t line) { return expected_texts.contains(line_text(wrong.source, line)); };
    const auto is_common_in_reference = [&](std::uint32_t line) {
        return texts.contains(line_text(reference.source, line));
    };
    Calls calls, expected_calls;
    expected_calls.prefers_callers = true;
    std::size_t looked_at = 0;
    for (const auto& [own, invocation] : items) {
        if (!invocation && !own)
            continue;
        const std::uint32_t number = own.value_or(invocation.value_or(0)),
                            expected_number = invocation.value_or(number);
        const text::TracedRun run = common_run(wrong, number), right = common_run(reference, expected_number);
        if (run.words == right.words)
            continue; // the text does not differ: the driver does
        for (const text::TraceRow& row : run.trace.rows)
            calls.come_by(own_lines.chain(run.trace, row));
        for (const text::TraceRow& row : right.trace.rows)
            expected_calls.come_by(expected_lines.chain(right.trace, row));
        bool is_repaired = false;
        const std::vector<text::Suspect> suspects =
            text::suspects_of(run, right, [&](std::span<const text::ForcedRow> forced) {
                return common_run(wrong, number, forced).words;
            });
        for (const text::Suspect& one : suspects) {
            const text::TraceRow& row = run.trace.rows[one.row];
            if (is_written_otherwise && row.kind == text::TraceRow::Kind::load &&
                row.place.space == text::WrittenPlace::Space::shared) // another invocation made it
                continue;
            Chain chain = own_lines.chain(run.trace, row);
            if (chain.lines.empty())
                continue;
            calls.blame(chain);
            const bool says_little = one.is_output || (!row.is_real && row.kind != text::TraceRow::Kind::comparison);
            is_repaired = is_repaired || (one.repairs && !says_little);
            blames.push_back({looked_at, std::move(chain),
                              one.repairs ? (says_little ? repair_of_output : repair) : no_repair,
                              what_of(run.trace, one), !one.repairs && row.kind == text::TraceRow::Kind::comparison});
        }
        std::vector<Blame> missed = missing_of(right, run, looked_at, expected_lines);
        if (!is_repaired)
            std::ranges::move(left_out_of(right, run, looked_at, expected_lines, is_common_in_reference,
                                          [&](std::span<const text::ForcedRow> forced) {
                                              return common_run(reference, expected_number, forced).words;
                                          }),
                              std::back_inserter(missed));
        for (Blame& one : missed) {
            expected_calls.blame(one.chain);
            missing_blames.push_back(std::move(one));
        }
        ++looked_at;
    }
    std::map<std::uint32_t, Line> lines = lines_by(blames, calls, is_common);
    const std::map<std::uint32_t, Line> missing = lines_by(missing_blames, expected_calls, is_common_in_reference);
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
            for (const std::uint32_t line : own_lines.chain(run.trace, run.trace.rows[row]).lines)
                unmatched.insert(line);
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
        found.push_back({program.line_name(at), line_text(wrong.source, at), lines[at].what});
    }
    // What the reference makes and the text never does, where no line of the text repairs anything.
    const bool repairs = !ranked.empty() && lines[ranked.front().second].loudest > repair_of_output;
    const auto most = std::max_element(missing.begin(), missing.end(),
                                       [](const auto& a, const auto& b) { return a.second.score < b.second.score; });
    if (!repairs && most != missing.end() && most->second.score > 0.3 * static_cast<double>(looked_at)) {
        if (alike == 0) // then what loops of a text compare that is written otherwise differs anywhere
            std::erase_if(found, [&](const WitnessLine& one) { return only_compared.contains(one.where); });
        found.insert(
            found.begin(),
            {fmt::format("{}{}", expected.line_name(most->first), reference_mark),
             line_text(reference.source, most->first),
             fmt::format("{}, which this text never does{}", most->second.what,
                         most->second.repairs ? "; with the other answer the reference writes what it does" : "")});
    }
    found.resize(std::min(found.size(), most_lines));
    return found;
} catch (const Error&) {
    return {}; // of what is not run apart from others nothing is known
}

} // namespace lockstep
