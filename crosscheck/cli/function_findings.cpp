#include "crosscheck/cli/function_findings.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "crosscheck/files/plain_text.hpp"

namespace lockstep {

FunctionRows without(const FunctionRows& rows, const std::vector<UndefinedRow>& undefined) {
    FunctionRows kept = rows;
    kept.words.clear();
    kept.lines.clear();
    if (kept.results)
        kept.results->clear();
    const std::size_t width = rows.width(), count = rows.count();
    const std::size_t result_width = rows.results ? rows.results->size() / count : 0;
    for (std::size_t row = 0; row < count; ++row) {
        if (std::ranges::binary_search(undefined, row, {}, &UndefinedRow::row))
            continue;
        const auto append = [&](auto& to, const auto& from, std::size_t n) {
            const auto first = from.begin() + static_cast<std::ptrdiff_t>(row * n);
            to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(n));
        };
        append(kept.words, rows.words, width);
        if (!rows.lines.empty())
            kept.lines.push_back(rows.lines[row]);
        if (rows.results)
            append(*kept.results, *rows.results, result_width);
    }
    return kept;
}

std::string undefined_text(const FunctionRows& rows, const std::vector<UndefinedRow>& undefined, std::size_t others) {
    constexpr std::size_t most = 20;
    std::string all = fmt::format(
        "verdict   UNDEFINED: {} of {} rows rest on an operation for which GLSL defines no result{}\n",
        undefined.size(), rows.count(), others > 0 ? fmt::format("; every bit of the other {} agrees", others) : "");
    const std::string file = std::filesystem::path(rows.file).filename().string();
    for (std::size_t k = 0; k < undefined.size() && k < most; ++k) {
        const UndefinedRow& one = undefined[k];
        all += fmt::format("row {:<5} {}{}: {}: {}\n", one.row,
                           rows.lines.empty() ? "" : fmt::format("{}:{}: ", file, rows.lines[one.row]), one.where,
                           one.rule, one.what);
    }
    if (undefined.size() > most)
        all += fmt::format("          and {} rows more\n", undefined.size() - most);
    return all;
}

std::string unread_text(std::initializer_list<std::string> reasons) {
    std::string all;
    for (const std::string& reason : reasons)
        if (!reason.empty())
            all += fmt::format(
                "note      the text is not read: {}\n"
                "          undefined operands and unset variables stay unseen, and each result is one value\n",
                plain_line(reason));
    return all;
}

} // namespace lockstep
