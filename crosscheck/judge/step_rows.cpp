#include "crosscheck/judge/step_rows.hpp"

#include <utility>

#include "reference/model/same_bits.hpp"

namespace lockstep {

LegalValue legal_value(const Interval& set, std::optional<float> value) {
    LegalValue answer{{.legal = !value || set.contains(*value), .open = set.any}, {}};
    if (!answer.legality.legal)
        answer.words = set.low == set.high ? fmt::format("{:.9g} follows from the GPU's own values above", set.low)
                                           : fmt::format("{:.9g} to {:.9g} would be legal", set.low, set.high);
    return answer;
}

StepRows::StepRows(std::vector<StepRow> above) : rows_(std::move(above)) {
    for (const StepRow& row : rows_)
        judge_.comes_after(row);
}

void StepRows::number(std::string label, std::optional<float> strict, std::optional<float> reference,
                      std::optional<float> gpu, const LegalValue& legal) {
    StepRow row{.label = std::move(label), .strict = {strict, {}}, .reference = {reference, {}}, .gpu = {gpu, {}}};
    if (gpu)
        judge_.put(row, reference && same_bits(*reference, *gpu), legal.legality, RowVerdict::rounding,
                   [&] { return legal.words; });
    rows_.push_back(std::move(row));
}

void StepRows::decision(std::string label, std::string strict, std::string reference, std::optional<std::string> gpu,
                        const std::string& follows, bool may) {
    StepRow row{.label = std::move(label), .strict = {{}, std::move(strict)}, .reference = {{}, reference}};
    if (gpu) {
        row.gpu.text = *gpu;
        judge_.put(row, *gpu == reference, {.legal = may || *gpu == follows}, RowVerdict::tie,
                   [&] { return fmt::format("{} follows from the GPU's own values above", follows); });
    }
    rows_.push_back(std::move(row));
}

void StepRows::only_reference(std::string label, Cell strict, Cell reference) {
    rows_.push_back({.label = std::move(label), .strict = std::move(strict), .reference = std::move(reference)});
}

} // namespace lockstep
