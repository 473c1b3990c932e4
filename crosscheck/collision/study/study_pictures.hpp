#pragma once
#include <span>
#include <string>
#include <string_view>

#include "crosscheck/collision/study/study.hpp"

namespace lockstep {

/// The CDT's texels by what became of the searches of the particles there, in false colours; missed particles lie on
/// top, of several causes the last in the order of Miss, then recalled ones, then those without a neighbour.
ColorImage study_picture(const StudiedState& state, const Profile& profile);

/// The colour of a cause in these pictures.
Rgba8 miss_color(Miss miss);

/// What the colours mean, one line.
std::string_view picture_legend();

/// Recall and misses by cause over the frames as an SVG file, drawn by gnuplot. Throws Error if it fails.
std::string chart_svg(std::span<const StudyFrame> frames, std::string_view title);

} // namespace lockstep
