#pragma once
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/judge/step_row.hpp"
#include "reference/interval.hpp"

namespace lockstep {

/// Judges a table's rows in their order: what comes after a decision that was another, or a value none that is legal,
/// follows from it.
class RowJudge {
  public:
    struct Legality {
        bool legal = true;
        bool open = false; ///< GL leaves it open
    };

    /// `same`: the GPU has the reference's. `otherwise`: what another legal value is. `reason`: words for one that is
    /// not.
    template <class Reason>
    void put(StepRow& row, bool same, Legality legality, RowVerdict otherwise, const Reason& reason) {
        row.verdict = same                           ? RowVerdict::same
                      : !legality.legal && !is_lost_ ? RowVerdict::divergent
                      : legality.open                ? RowVerdict::undefined
                      : departed_                    ? RowVerdict::follows
                                                     : otherwise;
        if (row.verdict == RowVerdict::divergent)
            row.reason = reason();
        comes_after(row);
    }
    /// The GPU went where what is legal is not known.
    void lose_the_way() { is_lost_ = true; }
    void comes_after(const StepRow& row) { departed_ = departed_ || row.verdict > RowVerdict::rounding; }

  private:
    bool departed_ = false, is_lost_ = false;
};

/// A value's legal set, or that there is none to be told by; and words for where the GPU's is not in it.
struct LegalValue {
    RowJudge::Legality legality;
    std::string words;
};
LegalValue legal_value(const Interval& set, std::optional<float> value);

/// Puts rows under each other and judges each by what stands above.
class StepRows {
  public:
    explicit StepRows(std::vector<StepRow> above = {});

    void number(std::string label, std::optional<float> strict, std::optional<float> reference,
                std::optional<float> gpu, const LegalValue& legal);

    template <class Vector> void numbers(const std::string& label, const std::optional<Vector>& strict,
                                         const std::optional<Vector>& reference, const std::optional<Vector>& gpu,
                                         const Interval* legal) {
        for (int c = 0; c < Vector::length(); ++c) {
            const auto component = [c](const std::optional<Vector>& v) {
                return v ? std::optional<float>((*v)[c]) : std::nullopt;
            };
            number(fmt::format("{}.{}", label, "xyzw"[c]), component(strict), component(reference), component(gpu),
                   legal_value(legal[c], component(gpu)));
        }
    }

    /// `follows`: what the GPU has to decide by its own values; `may`: or may, whatever these say.
    void decision(std::string label, std::string strict, std::string reference, std::optional<std::string> gpu,
                  const std::string& follows, bool may = false);

    void only_reference(std::string label, Cell strict, Cell reference);

    std::vector<StepRow> take() { return std::move(rows_); }

  private:
    std::vector<StepRow> rows_;
    RowJudge judge_;
};

} // namespace lockstep
