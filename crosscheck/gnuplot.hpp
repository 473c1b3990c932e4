#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace lockstep {

/// What gnuplot writes to its standard output for a script; nothing where gnuplot is not installed. Throws Error if it
/// fails.
std::optional<std::string> run_gnuplot(const std::string& script);

inline constexpr std::string_view no_gnuplot = "no chart: gnuplot is not installed (Debian package gnuplot-nox)";

/// A text as gnuplot reads it back.
std::string gnuplot_quoted(std::string_view text);

} // namespace lockstep
