#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "crosscheck/text/examination.hpp"
#include "crosscheck/text/made_up_world.hpp"
#include "crosscheck/text/stage_text.hpp"
#include "reference/text/stage_run.hpp"

namespace lockstep {

/// Which names of a reference's text are which of another text: blocks by name, else by binding; images, inputs and
/// outputs by name, or by location where they have none. Nothing: the text has it not.
struct MatchedNames {
    std::vector<std::optional<std::size_t>> blocks, images, outputs; ///< of each of the reference's

    /// A place that the reference wrote or read, as the other text has it. Nothing: it has none.
    [[nodiscard]] std::optional<text::WrittenPlace> place(const StageText& text, const StageText& reference,
                                                          text::WrittenPlace place) const;
};

/// Throws Error naming the first difference between the interfaces of two texts: it and what is expected. `by_host`: a
/// host runs both, whichever they are: what they have in common counts, and has to be alike. Outputs that differ in
/// what lies before the first underscore are one then (v_Speed, out_Speed).
MatchedNames matched_names(const Examination& of, const StageText& text, const StageText& reference,
                           bool by_host = false);

/// What the reference is bound to where the other text is bound to `world`. `own_world`: what it is bound to in a run
/// of its own, for what the other has not; null: there is none.
MadeUpWorld world_of_reference(const Examination& of, const MatchedNames& names, const StageText& text,
                               const StageText& reference, const MadeUpWorld& world,
                               const MadeUpWorld* own_world = nullptr);

/// What runs of the reference where `run` is what runs of the other text.
text::StageRun run_of_reference(const Examination& of, const StageText& reference, const text::StageRun& run);

} // namespace lockstep
