#include "crosscheck/collision/study/study_report.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/report/statistics.hpp"

namespace lockstep {
namespace {

using CountOrShare = std::variant<std::size_t, double>;
using Columns = std::vector<std::pair<std::string, CountOrShare>>;

/// Every number of a frame, by name.
Columns columns(const SearchCounts& n) {
    Columns all{
        {"particles", n.particles},
        {"ignored", n.ignored},
        {"owners", n.owners},
        {"with_neighbour", n.with_neighbour},
        {"with_neighbour_inside", n.with_neighbour_inside},
        {"with_neighbour_search", n.with_neighbour_search},
        {"recalled", n.recalled},
        {"recalled_with_base", n.recalled_with_base},
        {"recall", n.recall()},
        {"recall_inside", n.recall_inside()},
        {"recall_searching", n.recall_searching()},
        {"precision", n.precision()},
        {"true_nearest", n.true_nearest()},
        {"non_mutual_rate", n.non_mutual_rate()},
        {"mean_depth", n.mean_depth()},
        {"pairs", n.pairs},
        {"found_pairs", n.found_pairs},
    };
    for (std::size_t m = 0; m < miss_names.size(); ++m)
        all.emplace_back(fmt::format("missed_pairs_{}", miss_names[m]), n.missed_pairs[m]);
    for (std::size_t m = 0; m < miss_names.size(); ++m)
        all.emplace_back(fmt::format("missed_particles_{}", miss_names[m]), n.missed_particles[m]);
    for (std::size_t h = 0; h < hit_names.size(); ++h)
        all.emplace_back(fmt::format("hits_{}", hit_names[h]), n.hits[h]);
    return all;
}

Columns columns(const StudyFrame& frame) {
    Columns all{{"frame", static_cast<std::size_t>(frame.frame)}};
    const Columns counts = columns(frame.counts);
    all.insert(all.end(), counts.begin(), counts.end());
    all.emplace_back("energy_drift", frame.drift.energy);
    all.emplace_back("momentum_drift", frame.drift.momentum);
    return all;
}

std::string cell(const CountOrShare& value) {
    if (const auto* count = std::get_if<std::size_t>(&value))
        return std::to_string(*count);
    const double number = std::get<double>(value);
    return std::isfinite(number) ? fmt::format("{:.9g}", number) : std::string();
}

nlohmann::json object(const Columns& all) {
    nlohmann::json json = nlohmann::json::object();
    for (const auto& [name, value] : all) {
        if (const auto* count = std::get_if<std::size_t>(&value))
            json[name] = *count;
        else
            json[name] = std::isfinite(std::get<double>(value)) ? nlohmann::json(std::get<double>(value)) : nullptr;
    }
    return json;
}

std::string share(std::size_t part, std::size_t whole) {
    return percent(static_cast<double>(part) / static_cast<double>(whole));
}

std::string row(std::string_view name, const SearchCounts& n) {
    return fmt::format("{:>7} {:>10} {:>8} {:>9} {:>10} {:>8} {:>8} {:>8} {:>10}", name, n.with_neighbour,
                       percent(n.recall()), percent(n.recall_searching()), percent(n.precision()),
                       percent(n.true_nearest()), percent(n.non_mutual_rate()), share(n.owners, n.particles),
                       std::isnan(n.mean_depth()) ? "-" : fmt::format("{:.5f}", n.mean_depth()));
}

std::string drift_text(const Drift& d) {
    return fmt::format(" {:>10} {:>10}", std::isfinite(d.energy) ? fmt::format("{:+.2e}", d.energy) : "-",
                       std::isfinite(d.momentum) ? fmt::format("{:.2e}", d.momentum) : "-");
}

} // namespace

SearchCounts total(std::span<const StudyFrame> frames) {
    SearchCounts sum;
    for (const StudyFrame& frame : frames)
        sum += frame.counts;
    return sum;
}

std::string study_text(std::span<const StudyFrame> frames) {
    std::string out = fmt::format("{:>7} {:>10} {:>8} {:>9} {:>10} {:>8} {:>8} {:>8} {:>10} {:>10} {:>10}\n"
                                  "{:>7} {:>10} {:>8} {:>9} {:>10} {:>8} {:>8} {:>8} {:>10} {:>10} {:>10}\n",
                                  "frame", "particles", "recall", "of those", "precision", "nearest", "not", "visible",
                                  "mean depth", "energy", "momentum", "", "in contact", "%", "searching", "%",
                                  "found %", "mutual %", "%", "", "drift", "drift");
    const std::size_t stride = (frames.size() + 19) / 20;
    for (std::size_t i = 0; i < frames.size(); ++i)
        if (i % stride == 0 || i + 1 == frames.size())
            out += row(std::to_string(frames[i].frame), frames[i].counts) + drift_text(frames[i].drift) + "\n";
    const SearchCounts sum = total(frames);
    out += row("all", sum) + "\n";

    const std::size_t missed_pairs = sum.pairs - sum.found_pairs;
    const std::size_t missed = sum.with_neighbour - sum.recalled;
    out += fmt::format("\n{:<16} {:>12} {:>7} {:>12} {:>7}\n", "missed by", "pairs", "%", "particles", "%");
    for (std::size_t m = 0; m < miss_names.size(); ++m)
        if (sum.missed_pairs[m] + sum.missed_particles[m] > 0)
            out += fmt::format("{:<16} {:>12} {:>7} {:>12} {:>7}\n", miss_names[m], sum.missed_pairs[m],
                               share(sum.missed_pairs[m], missed_pairs), sum.missed_particles[m],
                               share(sum.missed_particles[m], missed));
    out += fmt::format("{:<16} {:>12} {:>7} {:>12} {:>7}\n", "sum", missed_pairs, "", missed, "");
    out += fmt::format("\n{:<16} {:>12} {:>7}\n", "search ends at", "particles", "%");
    for (std::size_t h = 0; h < hit_names.size(); ++h)
        if (sum.hits[h] > 0)
            out += fmt::format("{:<16} {:>12} {:>7}\n", hit_names[h], sum.hits[h], share(sum.hits[h], sum.particles));
    if (sum.ignored > 0)
        out += fmt::format("{:<16} {:>12} {:>7}\n", "(not finite)", sum.ignored, share(sum.ignored, sum.particles));
    return out;
}

std::string study_csv(std::span<const StudyFrame> frames) {
    std::string out;
    const auto line = [&out](const Columns& all, const auto& text) {
        const std::string_view first = all.front().first;
        for (const auto& column : all) {
            if (column.first != first)
                out += ',';
            out += text(column);
        }
        out += '\n';
    };
    line(columns(StudyFrame{}), [](const auto& column) { return column.first; });
    for (const StudyFrame& frame : frames)
        line(columns(frame), [](const auto& column) { return cell(column.second); });
    return out;
}

nlohmann::json study_json(std::span<const StudyFrame> frames) {
    nlohmann::json all = nlohmann::json::array();
    for (const StudyFrame& frame : frames)
        all.push_back(object(columns(frame)));
    return {{"frames", all}, {"total", object(columns(total(frames)))}};
}

} // namespace lockstep
