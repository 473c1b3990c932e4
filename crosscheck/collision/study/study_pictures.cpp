#include "crosscheck/collision/study/study_pictures.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "crosscheck/report/gnuplot.hpp"
#include "reference/collision/collision_pass.hpp"

namespace lockstep {
namespace {

constexpr Rgba8 no_rank{18, 20, 26, 255};
constexpr Rgba8 alone{70, 74, 84, 255};
constexpr Rgba8 recalled{90, 190, 110, 255};
constexpr std::array<Rgba8, miss_names.size()> miss_colors{{
    {150, 90, 40, 255},   // outside_image
    {250, 200, 60, 255},  // own_texel
    {230, 60, 50, 255},   // occluded
    {170, 70, 200, 255},  // hidden
    {60, 140, 240, 255},  // outside_window
    {70, 220, 220, 255},  // stale
    {255, 255, 255, 255}, // coincident
    {255, 150, 200, 255}, // rounded
    {120, 110, 60, 255},  // cooling_down
}};

int rank(const Finding& finding) {
    return finding.kind == Finding::Kind::missed ? 2 + static_cast<int>(finding.miss) : static_cast<int>(finding.kind);
}

Rgba8 color(int rank) {
    return rank == 0 ? alone : rank == 1 ? recalled : miss_colors[static_cast<std::size_t>(rank - 2)];
}

std::string chart_script(std::span<const StudyFrame> frames, std::string_view title) {
    std::string script = "$data << EOD\n";
    for (const StudyFrame& frame : frames) {
        const SearchCounts& n = frame.counts;
        const double whole = n.with_neighbour == 0 ? 1.0 : static_cast<double>(n.with_neighbour) / 100.0;
        script += fmt::format("{} {:.6g}", frame.frame, static_cast<double>(n.recalled) / whole);
        for (const std::size_t missed : n.missed_particles)
            script += fmt::format(" {:.6g}", static_cast<double>(missed) / whole);
        script += '\n';
    }
    script += fmt::format("EOD\nset terminal svg size 900,500 noenhanced background rgb 'white'\n"
                          "set title {}\nset xlabel 'frame'\n"
                          "set ylabel 'particles with an exact neighbour, %'\nset yrange [0:100]\n"
                          "set key outside right\nset grid\nplot $data using 1:2 with lines lw 2 lc rgb '#2a8040' "
                          "title 'recalled'",
                          gnuplot_quoted(title));
    for (std::size_t m = 0; m < miss_names.size(); ++m) {
        bool any = false;
        for (const StudyFrame& frame : frames)
            any = any || frame.counts.missed_particles[m] > 0;
        const Rgba8 c = miss_color(static_cast<Miss>(m));
        if (any)
            script += fmt::format(", $data using 1:{} with lines lw 2 lc rgb '#{:02x}{:02x}{:02x}' title 'missed: {}'",
                                  m + 3, c.r, c.g, c.b, miss_names[m]);
    }
    return script + "\n";
}

} // namespace

Rgba8 miss_color(Miss miss) { return miss_colors[static_cast<std::size_t>(miss)]; }

ColorImage study_picture(const StudiedState& state, const Profile& profile) {
    Image<int> ranks(state.params.width, state.params.height, -1);
    const auto texels = drawn_texels(state.particles.position, state.params, profile);
    for (std::size_t i = 0; i < texels.size(); ++i)
        if (texels[i] != no_texel) {
            int& top = ranks.texels[static_cast<std::size_t>(texels[i])];
            top = std::max(top, rank(state.findings[i]));
        }
    ColorImage image(ranks.width, ranks.height, no_rank);
    for (std::size_t t = 0; t < ranks.texels.size(); ++t)
        if (ranks.texels[t] >= 0)
            image.texels[t] = color(ranks.texels[t]);
    return image;
}

std::string_view picture_legend() {
    return "grey no neighbour, green recalled; missed: brown outside_image, yellow own_texel, red occluded, violet "
           "hidden, "
           "blue outside_window, cyan stale, white coincident, pink rounded, olive cooling_down";
}

std::string chart_svg(std::span<const StudyFrame> frames, std::string_view title) {
    return run_gnuplot(chart_script(frames, title));
}

} // namespace lockstep
