#include "crosscheck/text/text_coverage.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "crosscheck/files/plain_text.hpp"

namespace lockstep {
namespace {

using Line = TextCoverage::Line;
using Side = TextCoverage::Side;

/// What was not taken at a place, or lines that were not reached.
struct Gap {
    FileLine at;
    std::uint32_t to = 0; ///< the last line of those that were not reached
    std::string what;
    bool is_not_entered = false; ///< a condition that held the lines behind it back
};

/// "was never false"; where its line has several alike, which one.
std::string words_of(const Side& side, const Line& line, std::size_t decision) {
    std::size_t number = 0, alike = 0;
    for (std::size_t d = 0; d < line.decisions.size(); ++d)
        if (line.decisions[d].front().never == line.decisions[decision].front().never) {
            ++alike;
            number += d <= decision ? 1 : 0;
        }
    return side.never + (alike > 1 ? fmt::format(" (number {} of {} in the line)", number, alike) : "");
}

void add_decisions(const FileLine& at, const Line& line, std::vector<Gap>& gaps) {
    for (std::size_t d = 0; d < line.decisions.size(); ++d) {
        const std::vector<Side>& sides = line.decisions[d];
        if (std::ranges::none_of(sides, &Side::is_taken)) {
            if (line.has_statement)
                gaps.push_back({at, 0, words_of({"was never asked"}, line, d)});
            continue;
        }
        for (const Side& side : sides)
            if (!side.is_taken)
                gaps.push_back({at, 0, words_of(side, line, d), sides.size() == 2 && &side == sides.data()});
    }
}

/// In the order of the stage's own file, then of the others.
std::vector<Gap> gaps_of(const TextCoverage& of) {
    std::vector<Gap> gaps;
    const auto add_file = [&](bool is_own) {
        bool goes_on = false; // the line before was not reached
        const std::string* file = nullptr;
        for (const auto& [at, line] : of.lines) {
            if ((at.file == of.stage) != is_own)
                continue;
            goes_on = goes_on && file != nullptr && *file == at.file;
            file = &at.file;
            if (line.has_statement && !line.is_reached) {
                if (!goes_on)
                    gaps.push_back({at, 0, "never reached"});
                gaps.back().to = at.line;
            } else {
                add_decisions(at, line, gaps);
            }
            goes_on = line.has_statement ? !line.is_reached : goes_on && line.decisions.empty();
        }
    };
    add_file(true);
    add_file(false);
    return gaps;
}

std::string place_of(const TextCoverage& of, const FileLine& at) {
    return fmt::format("{}:{}", at.file == of.stage ? "" : at.file, at.line);
}

std::string words_of(const TextCoverage& of, const Gap& gap) {
    return place_of(of, gap.at) + (gap.to > gap.at.line ? fmt::format(" to :{} ", gap.to) : " ") + gap.what;
}

/// One for each that a reader looks at: lines that are held back by the condition before them are not another.
std::vector<std::string> gap_words(const TextCoverage& of) {
    std::vector<std::string> words;
    const std::vector<Gap> gaps = gaps_of(of);
    for (std::size_t k = 0; k < gaps.size(); ++k) {
        words.push_back(words_of(of, gaps[k]));
        if (k + 1 == gaps.size() || !gaps[k].is_not_entered || gaps[k + 1].to == 0 ||
            gaps[k + 1].at.file != gaps[k].at.file)
            continue;
        const auto between = [&](const auto& one) {
            return one.first.file == gaps[k].at.file && one.first.line > gaps[k].at.line &&
                   one.first.line < gaps[k + 1].at.line;
        };
        if (std::ranges::none_of(of.lines, between))
            words.back() += fmt::format(" ({})", words_of(of, gaps[++k]));
    }
    return words;
}

} // namespace

void TextCoverage::add(const TextCoverage& other) {
    for (const auto& [at, from] : other.lines) {
        Line& to = lines[at];
        to.has_statement = to.has_statement || from.has_statement;
        to.is_reached = to.is_reached || from.is_reached;
        for (std::size_t d = 0; d < from.decisions.size(); ++d) {
            if (d == to.decisions.size())
                to.decisions.emplace_back();
            for (std::size_t s = 0; s < from.decisions[d].size(); ++s) {
                if (s == to.decisions[d].size())
                    to.decisions[d].push_back(from.decisions[d][s]);
                to.decisions[d][s].is_taken = to.decisions[d][s].is_taken || from.decisions[d][s].is_taken;
            }
        }
    }
}

CoverageCount& CoverageCount::operator+=(const CoverageCount& other) {
    lines += other.lines;
    reached += other.reached;
    sides += other.sides;
    taken += other.taken;
    return *this;
}

double CoverageCount::share() const {
    const auto part = [](std::size_t of, std::size_t all) {
        return all == 0 ? 1.0 : static_cast<double>(of) / static_cast<double>(all);
    };
    return std::min(part(reached, lines), part(taken, sides));
}

CoverageCount coverage_count(const TextCoverage& of) {
    CoverageCount all;
    for (const auto& [at, line] : of.lines) {
        all.lines += line.has_statement ? 1 : 0;
        all.reached += line.has_statement && line.is_reached ? 1 : 0;
        for (const std::vector<Side>& sides : line.decisions) {
            all.sides += sides.size();
            all.taken += static_cast<std::size_t>(std::ranges::count_if(sides, &Side::is_taken));
        }
    }
    return all;
}

CoverageCount coverage_count(std::span<const TextCoverage> all) {
    CoverageCount sum;
    for (const TextCoverage& one : all)
        sum += coverage_count(one);
    return sum;
}

std::string coverage_words(const CoverageCount& of) {
    const std::string sides = counted(of.sides, "branch side");
    if (of.lines > 1 && of.reached == of.lines && of.taken == of.sides)
        return fmt::format("all {}{}", counted(of.lines, "line"), of.sides == 0 ? "" : " and " + sides);
    return fmt::format("{} of {}{}", of.reached, counted(of.lines, "line"),
                       of.sides == 0 ? "" : fmt::format(", {} of {}", of.taken, sides));
}

std::string coverage_text(const TextCoverage& of) {
    constexpr std::size_t most = 3;
    std::vector<std::string> gaps = gap_words(of);
    const std::size_t more = gaps.size() > most ? gaps.size() - most : 0;
    gaps.resize(gaps.size() - more);
    return fmt::format("{}: {} in {}{}{}{}", of.stage, coverage_words(coverage_count(of)), of.in,
                       gaps.empty() ? "" : "; ", fmt::join(gaps, ", "),
                       more > 0 ? fmt::format(", and {} more", more) : "");
}

nlohmann::json coverage_json(std::span<const TextCoverage> all) {
    nlohmann::json stages = nlohmann::json::array();
    for (const TextCoverage& of : all) {
        std::map<std::string, TextCoverage> by_file;
        for (const auto& [at, line] : of.lines)
            by_file[at.file].lines.emplace(at, line);
        nlohmann::json files = nlohmann::json::array(), never = nlohmann::json::array();
        for (const auto& [file, part] : by_file) {
            const CoverageCount counts = coverage_count(part);
            files.push_back({{"file", file},
                             {"lines", counts.lines},
                             {"reached", counts.reached},
                             {"sides", counts.sides},
                             {"taken", counts.taken}});
        }
        for (const Gap& gap : gaps_of(of)) {
            never.push_back({{"file", gap.at.file}, {"line", gap.at.line}, {"what", gap.what}});
            if (gap.to > 0)
                never.back()["to"] = gap.to;
        }
        stages.push_back({{"stage", of.stage},
                          {"in", of.in},
                          {"text", coverage_text(of)},
                          {"files", std::move(files)},
                          {"never", std::move(never)}});
    }
    return stages;
}

} // namespace lockstep
