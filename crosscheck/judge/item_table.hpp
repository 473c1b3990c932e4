#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "crosscheck/judge/step_row.hpp"
#include "crosscheck/judge/system.hpp"
#include "crosscheck/judge/text_steps.hpp"

namespace lockstep {

/// One item's step in a pass, value by value down its twin, each judged by what the GPU told before it. A turn of a
/// loop over texels is one row: what was offered to the choice, and how far it came; what led there has rows of its own
/// where the GPU's differs. Where a shader can tell of a twin's sites, those it cannot tell of have no row.
/// What the shader's text computes stands for what the GPU does not tell of.
std::vector<StepRow> item_rows(const JudgedPass& pass, std::size_t item, std::span<const ToldValue> told);
/// The same where steps_of_item is known already.
std::vector<StepRow> item_rows(const JudgedPass& pass, std::size_t item, std::span<const ToldValue> told,
                               const std::optional<ItemSteps>& text);

/// What the shader's text computes for an item; nothing: the pass has no text.
std::optional<ItemSteps> steps_of_item(const JudgedPass& pass, std::size_t item);

/// What the state that the GPU wrote tells by itself: its fields, by the outputs that the twin knows them by.
std::vector<ToldValue> told_by_state(const ItemPass& pass, const View& gpu, std::size_t item);

/// "collide time"
std::string field_label(const Field& field);

/// "3", "0.1 to 0.2", "anything"; integers with all their digits.
std::string legal_text(const Interval& legal, Scalar scalar);

} // namespace lockstep
