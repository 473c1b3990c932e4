#include "crosscheck/judge/item_table.hpp"

#include <filesystem>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "reference/model/ulp.hpp"

namespace lockstep {
namespace {

/// Turns of a loop that a table shows.
constexpr int most_turns = 8;

/// A site's values on one side, by how often it was come by before.
using Occurrences = std::map<std::pair<std::uint32_t, int>, RecordedRow>;

Occurrences by_site(const std::vector<RecordedRow>& rows) {
    Occurrences found;
    std::map<std::uint32_t, int> seen;
    for (const RecordedRow& row : rows)
        if (row.kind == RecordedRow::Kind::value || row.kind == RecordedRow::Kind::decision)
            found.emplace(std::pair{row.site->id, seen[row.site->id]++}, row);
    return found;
}

std::optional<float> value_of(const Occurrences& side, const ReadingRow& row, std::size_t c) {
    const auto found = side.find({row.site->id, row.occurrence});
    return found == side.end() || static_cast<int>(c) >= found->second.size ? std::nullopt
                                                                            : std::optional(found->second.values[c]);
}

Cell cell(std::optional<float> value, bool integer) {
    if (!value)
        return {};
    return integer ? Cell{{}, fmt::format("{}", static_cast<long>(*value))} : Cell{value, {}};
}

std::string label_of(const ReadingRow& row, std::size_t c) {
    std::string label(row.site->label);
    if (row.occurrence > 0)
        label += fmt::format(" [{}]", row.occurrence);
    return row.size > 1 ? fmt::format("{}.{}", label, "xyzw"[c]) : label;
}

std::string legal_text(const ReadingRow& row, std::size_t c) {
    const Interval& legal = row.legal[c];
    const std::string line =
        fmt::format("{}:{}", std::filesystem::path(row.where.file_name()).filename().string(), row.where.line());
    return legal.low == legal.high ? fmt::format("{:.9g} follows from the GPU's own values above ({})", legal.low, line)
                                   : fmt::format("{:.9g} to {:.9g} would be legal ({})", legal.low, legal.high, line);
}

} // namespace

std::vector<StepRow> item_rows(const JudgedPass& pass, std::size_t item, std::span<const ToldValue> told) {
    const Occurrences strict = by_site(pass.pass.record(pass.input(), item, named_profile("strict")));
    const Occurrences reference = by_site(pass.pass.record(pass.input(), item, pass.profile));
    const FollowedStep followed = pass.pass.follow(pass.input(), item, pass.profile, pass.known, told);
    std::vector<StepRow> rows;
    bool departed = false; // a decision was another, or a value none that is legal
    std::size_t left_out = 0;
    for (const ReadingRow& row : followed.rows) {
        if (row.occurrence >= most_turns && !row.is_told) {
            ++left_out;
            continue;
        }
        if (row.occurrence == 0 && left_out > 0)
            rows.push_back({.label = fmt::format("({} more of the loop)", std::exchange(left_out, 0))});
        for (std::size_t c = 0; c < static_cast<std::size_t>(row.size); ++c) {
            const std::optional<float> expected = value_of(reference, row, c);
            StepRow& out = rows.emplace_back();
            out.label = label_of(row, c);
            out.strict = cell(value_of(strict, row, c), row.is_integer);
            out.reference = cell(expected, row.is_integer);
            if (!row.is_told)
                continue;
            const float gpu = row.told[c];
            out.gpu = cell(gpu, row.is_integer);
            if (expected && same_bits(*expected, gpu)) {
                out.verdict = RowVerdict::same;
            } else if (!row.legal[c].contains(gpu)) {
                out.verdict = RowVerdict::divergent;
                out.reason = legal_text(row, c);
            } else if (row.legal[c].any) {
                out.verdict = RowVerdict::undefined;
            } else {
                out.verdict = departed ? RowVerdict::follows : row.is_integer ? RowVerdict::tie : RowVerdict::rounding;
            }
            departed = departed || out.verdict > RowVerdict::rounding;
        }
    }
    return rows;
}

std::vector<ToldValue> told_by_state(const JudgedPass& pass, std::size_t item) {
    std::vector<ToldValue> told;
    const View& gpu = pass.gpu;
    for (std::size_t f = 0; f < gpu.fields().size(); ++f) {
        ToldValue value{std::string(pass.pass.output(gpu.about(), static_cast<std::uint8_t>(f))), {}};
        for (int c = 0; c < gpu.fields()[f].components; ++c) {
            const Value v = gpu.value(f, item, c);
            value.values.push_back(v.scalar == Scalar::float32 ? v.real() : static_cast<float>(v.integer()));
        }
        told.push_back(std::move(value));
    }
    return told;
}

} // namespace lockstep
