#pragma once
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "crosscheck/collision/study/thesis.hpp"

namespace lockstep {

/// What the cells were measured with and on.
struct ThesisRun {
    std::string context;
    std::vector<ThesisCell> cells;
};

/// One line a cell, as it comes, under two lines of head.
std::string thesis_cell_head();
std::string thesis_cell_text(const ThesisCell& cell);

/// Tables 4-1 and 5-1, figures 5-3 and 5-5, recall, and how time grows, the thesis's figures beside.
std::string thesis_text(const ThesisRun& run);

/// One line a cell; the first line names the columns. What was not measured is left empty.
std::string thesis_csv(const ThesisRun& run);

nlohmann::json thesis_json(const ThesisRun& run);

/// What thesis_json wrote. Throws Error: `FILE: /json/pointer: what is wrong`.
ThesisRun read_thesis_json(const std::filesystem::path& file);

/// gnuplot's script for both tables and both figures as one SVG.
std::string thesis_chart(const ThesisRun& run);

} // namespace lockstep
