#pragma once
#include <string>
#include <string_view>

namespace lockstep {

bool have_gnuplot();

inline constexpr std::string_view no_gnuplot = "gnuplot is not installed (Debian package gnuplot-nox)";

/// What gnuplot writes to its standard output for a script. Throws Error if it fails, or is not installed.
std::string run_gnuplot(const std::string& script);

/// A text as gnuplot reads it back.
std::string gnuplot_quoted(std::string_view text);

} // namespace lockstep
