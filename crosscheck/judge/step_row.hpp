#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lockstep {

/// What the GPU's value in a row is, judged by the GPU's own values in the rows above it.
enum class RowVerdict {
    untold,    ///< nothing of the GPU's to compare
    same,      ///< the reference's bits
    rounding,  ///< another value, in the interval GLSL's precision rules allow
    tie,       ///< another decision, which follows from values that were rounded otherwise
    follows,   ///< other than the reference's, as it has to be after what differs above
    undefined, ///< GL leaves it open
    divergent, ///< does not follow from what the GPU itself had
};
inline constexpr std::array<std::string_view, 7> row_verdict_names{"",        "same",      "rounding", "tie",
                                                                   "follows", "undefined", "DIVERGENT"};

/// A number, words, or both; neither where there is nothing.
struct Cell {
    std::optional<float> number = {};
    std::string text = {};

    [[nodiscard]] bool empty() const { return !number && text.empty(); }
};

struct StepRow {
    std::string label;
    Cell strict = {};    ///< the reference on its own terms (profile strict)
    Cell reference = {}; ///< with the profile that was measured
    Cell gpu = {};
    RowVerdict verdict = RowVerdict::untold;
    std::string reason = {}; ///< what would be legal, where it is not
    std::string where = {};  ///< of the shader's text, what has its value: FILE:LINE, and the variable
    bool is_fetch = false;   ///< a texel read

    /// Between the reference with its profile and the GPU; 0 where one has no number.
    [[nodiscard]] std::int64_t ulp() const;
    [[nodiscard]] bool differs() const { return verdict > RowVerdict::same; }
    [[nodiscard]] bool has_nan() const;
};

} // namespace lockstep
