#pragma once
#include <cstdint>
#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "crosscheck/judge/verdict_summary.hpp"
#include "reference/model/state_view.hpp"

namespace lockstep {

/// 4812 as "4,812".
std::string grouped(std::uint64_t value);

/// Whether a cause is told of anything: what explains all of a buffer's or image's divergence, and nothing contradicts.
bool tells_cause(const VerdictSummary& summary);

/// Whether one that is told is a mistake with a name.
bool names_cause(const VerdictSummary& summary);

/// "texel (70, 294) is 0.25 away ... and nearest; the GPU took (72, 296), 0.5 away (collision_twin.hpp:128)".
std::string wrong_step_text(const WrongStep& wrong);

/// The lines of a report about verdicts: classes, ties, cause, first divergence. `extents`: of each
/// buffer and image.
std::string verdict_text(const VerdictSummary& summary, const Schema& schema, std::span<const Extent> extents);

/// The same as data.
nlohmann::json verdict_json(const VerdictSummary& summary, const Schema& schema, std::span<const Extent> extents);

} // namespace lockstep
