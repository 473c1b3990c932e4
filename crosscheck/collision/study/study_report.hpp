#pragma once
#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "crosscheck/collision/study/study.hpp"

namespace lockstep {

/// The sums of all frames.
SearchCounts total(std::span<const StudyFrame> frames);

/// At most 20 frames, evenly, and the totals; then misses and false hits by cause.
std::string study_text(std::span<const StudyFrame> frames);

/// One line a frame, every number of it; the first line names the columns. A rate of nothing is left empty.
std::string study_csv(std::span<const StudyFrame> frames);

/// The same as an object: frames, total. A rate of nothing is null.
nlohmann::json study_json(std::span<const StudyFrame> frames);

} // namespace lockstep
