#include "crosscheck/report/probe_table.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace lockstep {
namespace {

std::string distance(std::int64_t ulp) { return ulp == 0 ? "" : ulp == INT64_MAX ? "NaN" : fmt::format("{} ULP", ulp); }

std::string line(const std::string& name, const std::string& finding, std::uint64_t matched, std::uint64_t total,
                 std::int64_t max_ulp) {
    std::string text = fmt::format("{:<40}{:<34}{:>15} {:>12}", name, finding, fmt::format("{}/{}", matched, total),
                                   distance(max_ulp));
    text.erase(text.find_last_not_of(' ') + 1);
    return text + '\n';
}

std::string closest(const ProbeRow& row) {
    std::vector<ProbeCandidate> candidates = row.candidates;
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const ProbeCandidate& a, const ProbeCandidate& b) { return a.matched > b.matched; });
    candidates.resize(std::min<std::size_t>(candidates.size(), 4));
    std::string text;
    for (const ProbeCandidate& candidate : candidates)
        text += line("", "  " + candidate.name, candidate.matched, row.total, candidate.max_ulp);
    return text;
}

} // namespace

std::string probe_table(const ProbeResult& result) {
    std::string text = fmt::format("{}\n{} sub-pixel bits reported; measured in {:.2f} s\n\n", summary(result.context),
                                   result.context.subpixel_bits, result.seconds);
    for (const ProbeRow& row : result.rows) {
        text += line(row.name, row.finding, row.matched, row.total, row.max_ulp);
        if (row.finding == none_known)
            text += closest(row);
    }
    return text;
}

} // namespace lockstep
