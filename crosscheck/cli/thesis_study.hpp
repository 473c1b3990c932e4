#pragma once
#include <filesystem>
#include <vector>

#include "crosscheck/cli/run_options.hpp"

namespace lockstep {

/// `lockstep study --thesis`: what is measured, and where it goes.
struct ThesisStudy {
    RunOptions run;
    std::filesystem::path scenes;
    std::filesystem::path csv, json, chart; ///< empty: not wanted
    std::filesystem::path from;             ///< a file --json wrote: told and drawn again instead of measured
    std::vector<std::size_t> counts{50'000, 100'000, 150'000, 200'000};
    double seconds = 5.0;
};

void run_thesis_study(const ThesisStudy& study);

} // namespace lockstep
