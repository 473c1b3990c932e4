#pragma once
#include <string>
#include <string_view>

namespace lockstep {

/// The page that scripts/build_report_page.sh builds, without data: $LOCKSTEP_DATA/report.html, else
/// share/lockstep/report.html of the installation the program is in, else of the package it was linked with, else
/// build/report_page/ of its source tree.
/// Throws Error saying what to run if there is none, or it has no place for data.
std::string report_page_template();

/// Where the data goes.
inline constexpr std::string_view page_data_marker = "<!-- lockstep data -->";

} // namespace lockstep
