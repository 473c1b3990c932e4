#include "crosscheck/scene/profile_text.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reference/known_operations.hpp"
#include "reference/legal_interpolation.hpp"
#include "reference/paired_rows.hpp"

namespace lockstep {
namespace {

std::string errors_text(const OperationErrors& e) {
    const std::pair<const char*, std::int64_t> all[] = {{"a/b", e.divide},
                                                        {"1/b", e.reciprocal},
                                                        {"sqrt", e.sqrt},
                                                        {"inversesqrt", e.inverse_sqrt},
                                                        {"length", e.length},
                                                        {"normalize", e.normalize},
                                                        {"fragment a/b", e.fragment_divide},
                                                        {"fragment 1/b", e.fragment_reciprocal}};
    std::vector<std::string> off;
    for (const auto& [name, ulp] : all)
        if (ulp > 0)
            off.push_back(fmt::format("{} {}", name, ulp == INT64_MAX ? "NaN" : std::to_string(ulp)));
    return off.empty() ? "division and roots rounded" : fmt::format("ULP off: {}", fmt::join(off, ", "));
}

std::string dot_text(DotOrder order) {
    if (order <= DotOrder::fused_chain)
        return std::array{"(x + y) + z", "x + (y + z)", "fma(z, fma(y, x))"}[static_cast<std::size_t>(order)];
    return std::string(dot_order_names()[static_cast<std::size_t>(order)]);
}

/// The orders of the sums, where they are not one.
std::string orders_text(const Profile& profile) {
    std::string text = dot_text(profile.dot);
    if (profile.length_dot)
        text += fmt::format(" (in length {})", dot_text(*profile.length_dot));
    if (profile.normalize_dot)
        text += fmt::format(" (in normalize {})", dot_text(*profile.normalize_dot));
    std::vector<std::string> others;
    for (const auto& orders : {profile.other_orders.dot, profile.other_orders.length, profile.other_orders.normalize})
        for (const DotOrder order : orders)
            if (std::string other = dot_text(order); std::find(others.begin(), others.end(), other) == others.end())
                others.push_back(std::move(other));
    if (!others.empty())
        text += fmt::format(", also {}", fmt::join(others, ", "));
    if (profile.normalize_divides)
        text += ", normalize by division";
    return text;
}

} // namespace

std::string describe(const Profile& profile) {
    std::string text =
        fmt::format("{}: dot {}, {}, subnormals {}, {} sub-pixel bits, points on an edge to the {} pixel", profile.name,
                    orders_text(profile),
                    profile.roots ? "division and roots by the driver's own tables" : errors_text(profile.errors),
                    profile.flush_subnormals ? "flushed" : "kept", profile.raster.subpixel_bits,
                    profile.raster.point_edge_to_lower ? "lower" : "upper");
    std::vector<std::string> not_followed = profile.not_followed;
    std::erase_if(not_followed, [](const std::string& row) { return row.starts_with("image: "); }); // told by passes
    if (!not_followed.empty())
        text += fmt::format("; not followed: {}", fmt::join(not_followed, ", "));
    if (profile.any_order)
        text += "; sums in any order, since a stage says no precise";
    if (profile.open_corners)
        text += "; corners of obstacles in any order, since gl_Position is not precise";
    if (const KnownRaster known = measured_operations(profile).raster; !known.points() || !known.triangles())
        text +=
            known.point_window_accurate && known.corner_window_accurate && known.point_grid && known.triangle_grid
                ? "; texels are held to the accuracy of GLSL's own operations for these (--preset exact leaves nothing "
                  "open)"
            : known.gl_grid
                ? "; texels are held to GL's own rules for these (--preset exact leaves nothing open)"
                : "; texels are judged to half a pixel, since no sub-pixel grid of GL's explains the driver's "
                  "(--preset exact leaves nothing open)";
    return text;
}

std::vector<std::string> conversion_notes(const Profile& profile, const Switches& switches) {
    std::vector<std::string> notes;
    const bool has_triangles = switches.obstacles_in_cdt == ObstaclesInCdt::triangles;
    if (has_triangles && !profile.follows(driver_interpolates_row))
        notes.emplace_back("obstacle_pass.frag takes what the driver interpolates, to which GL gives no accuracy: "
                           "positions are right within 1 part in 10^5 and a step of the driver's grid, and of a larger "
                           "difference lockstep cannot say whose it is; interpolate of triangle_interpolation.glsl "
                           "leaves nothing open");
    if (switches.cdt_format == CdtFormat::rgba32f)
        return notes;
    const bool halves = switches.cdt_format == CdtFormat::rgba16f;
    const bool of_triangles = has_triangles && profile.converts.triangles;
    const bool of_vertices = switches.obstacles_in_cdt == ObstaclesInCdt::vertices && profile.converts.vertices;
    const bool in_compute = switches.step == Step::compute;
    const std::pair<bool, const char*> stages[] = {
        {profile.converts.particles, in_compute ? "collision_texels.frag" : "collision_pass.frag"},
        {of_triangles, "obstacle_pass.frag"},
        {of_vertices, "obstacle_vertices.frag"}};
    const auto right = [&] {
        switch (measured_of(profile, halves ? drawn_half_rows : drawn_unorm8_rows)) {
        case OfPair::first:
            return "the nearest code is right, and of two as near either";
        case OfPair::second:
            return "the code toward zero, which it was measured to take, is right, too";
        case OfPair::open:
            break;
        }
        return "either of two neighbouring codes is right";
    };
    for (const auto& [converts, file] : stages)
        if (converts)
            notes.push_back(fmt::format("{} leaves the rounding to {} to the driver, so {}; encode_position of "
                                        "collision_code.glsl leaves nothing open",
                                        file, halves ? "rgba16f" : "rgba8", right()));
    return notes;
}

} // namespace lockstep
