#include "crosscheck/report/row_text.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "crosscheck/report/value_text.hpp"

namespace lockstep {
namespace {

std::string cell_text(const Cell& cell, NumberFormat format) {
    if (!cell.number)
        return cell.text.empty() ? "-" : cell.text;
    return number_text(*cell.number, format) + (cell.text.empty() ? "" : " " + cell.text);
}

std::string ulp_text(const StepRow& row) {
    if (!row.reference.number || !row.gpu.number)
        return "";
    const std::int64_t ulp = row.ulp();
    if (of_other_sign(*row.reference.number, *row.gpu.number, ulp))
        return "other sign";
    return ulp == INT64_MAX ? "NaN" : fmt::format("{}", ulp);
}

std::string line(std::size_t width, std::string_view mark, std::string_view label, std::string_view strict,
                 std::string_view reference, std::string_view gpu, std::string_view ulp, std::string_view verdict,
                 std::string_view where = {}) {
    std::string text = fmt::format("{:1} {:<{}} {:<24} {:<24} {:<24} {:>10}  {:<9}  {}", mark, label, width, strict,
                                   reference, gpu, ulp, verdict, where);
    text.erase(text.find_last_not_of(' ') + 1);
    return text + "\n";
}

} // namespace

std::string number_text(float value, NumberFormat format) {
    return format == NumberFormat::hexadecimal ? fmt::format("{:a}", value) : fmt::format("{:.9g}", value);
}

std::string row_text(const StepRow& row, NumberFormat format, std::size_t label_width) {
    return line(label_width, row.differs() ? ">" : "", row.label, cell_text(row.strict, format),
                cell_text(row.reference, format), cell_text(row.gpu, format), ulp_text(row),
                row_verdict_names[static_cast<std::size_t>(row.verdict)], row.where);
}

std::string head_text(const Profile& profile, std::size_t label_width) {
    return line(label_width, "", "step", "reference (strict)", fmt::format("reference ({})", profile.name), "GPU",
                "ULP", "verdict");
}

} // namespace lockstep
