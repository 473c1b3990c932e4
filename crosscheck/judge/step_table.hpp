#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/judge/frame_run.hpp"
#include "reference/step_trace.hpp"

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
    bool is_fetch = false;   ///< a texel read

    /// Between the reference with its profile and the GPU; 0 where one has no number.
    [[nodiscard]] std::int64_t ulp() const;
    [[nodiscard]] bool differs() const { return verdict > RowVerdict::same; }
    [[nodiscard]] bool has_nan() const;
};

/// One particle's step on both sides, down the listing: clip position, texture coordinate, base texel, own position,
/// every neighbour, response or integration, gl_Position, window position, texel, depth, who else wanted the texel and
/// who won it.
struct StepTable {
    int frame = 0;
    std::size_t particle = 0;
    StepTrace reference; ///< with the profile
    StepCapture gpu;
    std::vector<StepRow> rows;
    /// Not empty if the trace build's outputs are not those the frame had: what is traced may then not be what
    /// happened.
    std::string warning;

    /// The first row the GPU reached by no legal way; null if there is none.
    [[nodiscard]] const StepRow* first_divergent() const;
};

StepTable step_table(FrameRun& run, std::size_t particle);

/// The same of a particle by itself, up to where it is drawn; `frame` of the table is 0.
StepTable step_table(const JudgedFrame& frame, std::size_t particle, const StepCapture& capture);

/// The same of a particle by itself, up to where it is drawn. `capture`: null where nothing of the GPU's steps is
/// known; the table then ends with the particle's new state. Its number of the frame is 0.
StepTable step_table(const JudgedFrame& frame, std::size_t particle, const StepCapture* capture);

/// A texel: everybody who was drawn to it on either side, its owners and what is stored.
struct TexelTable {
    int frame = 0;
    std::size_t texel = 0;
    std::vector<StepRow> rows;
    std::vector<std::size_t> particles; ///< the owners' step tables tell more: the reference's, then the GPU's
};

TexelTable texel_table(FrameRun& run, std::size_t texel);

} // namespace lockstep
