#include "reference/known_operations.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <string_view>

namespace lockstep {
namespace {

/// Whether every row whose name starts with one of these is followed.
bool followed(const Profile& profile, std::initializer_list<std::string_view> names) {
    return std::none_of(profile.not_followed.begin(), profile.not_followed.end(), [&](const std::string& row) {
        return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return row.starts_with(name); });
    });
}

/// Rows about what no operation rests on: of the first kind nothing does, of the second some passes, which say so
/// themselves (reference/system/pass_by_driver.hpp), on the third divisions by constants
/// (Worlds::open_constant_divisors).
constexpr std::array told_only{std::string_view("transform feedback order"), std::string_view("image: "),
                               std::string_view("a/c, c constant")};

constexpr std::array sums{std::string_view("mat4*vec4"), std::string_view("x*x+y*y+z*z"), std::string_view("a*b+c"),
                          std::string_view("x*a+x*b"), std::string_view("cross")};
constexpr std::array others{
    std::string_view("fragment a*b+c"), std::string_view("dot(vec3)"),  std::string_view("length"),
    std::string_view("v*s*t"),          std::string_view("v*s/t"),      std::string_view("v/s*t"),
    std::string_view("normalize"),      std::string_view("subnormal"),  std::string_view("compute:"),
    std::string_view("points:"),        std::string_view("triangles:"), std::string_view("equal depth")};

bool all_names_known(const Profile& profile) {
    return std::all_of(profile.not_followed.begin(), profile.not_followed.end(), [](const std::string& row) {
        const auto starts = [&](std::string_view name) { return row.starts_with(name); };
        return std::any_of(sums.begin(), sums.end(), starts) || std::any_of(others.begin(), others.end(), starts) ||
               std::any_of(told_only.begin(), told_only.end(), starts);
    });
}

KnownRaster measured_raster(const Profile& profile) {
    KnownRaster known;
    known.point_window = followed(profile, {"points: viewport"});
    known.point_grid = followed(profile, {"points: sub-pixel bits", "points: snap"});
    known.point_edges = followed(profile, {"points: edge"});
    known.point_depth = followed(profile, {"points: depth"}) &&
                        (!profile.raster.depth_by_driver_reciprocal || profile.roots != nullptr);
    known.triangle_window = followed(profile, {"triangles: viewport"});
    known.triangle_grid = followed(profile, {"triangles: sub-pixel bits", "triangles: snap"});
    known.triangle_sides = followed(
        profile, {"triangles: left side", "triangles: right side", "triangles: lower side", "triangles: upper side"});
    known.equal_depth = followed(profile, {"equal depth"});
    known.point_window_accurate = profile.point_window_accurate == true;
    known.corner_window_accurate = profile.corner_window_accurate == true;
    known.gl_grid = known.point_grid && known.triangle_grid;
    return known;
}

} // namespace

KnownOperations measured_operations(const Profile& profile) {
    if (!all_names_known(profile))
        return {.sums = false, .converts = profile.converts};
    const OperationErrors& errors = profile.errors;
    // With the driver's own tables, the reference has the driver's quotients and roots.
    const bool tables = profile.roots != nullptr;
    KnownOperations known;
    known.sums = std::all_of(sums.begin(), sums.end(), [&](std::string_view row) { return followed(profile, {row}); });
    known.divide = tables || (errors.divide == 0 && errors.reciprocal == 0);
    known.interpolation = (tables || (errors.fragment_divide == 0 && errors.fragment_reciprocal == 0)) &&
                          followed(profile, {"fragment a*b+c"});
    known.converts = profile.converts;
    known.square_root = (tables || (errors.sqrt == 0 && errors.length == 0)) && followed(profile, {"length"});
    known.dot = followed(profile, {"dot(vec3)"});
    known.normalize = (tables || errors.normalize == 0) && followed(profile, {"normalize"});
    known.subnormals = followed(profile, {"subnormal"});
    known.factors_reordered = !followed(profile, {"v*s*t", "v*s/t", "v/s*t"});
    if (profile.any_order)
        known.sums = known.divide = known.square_root = known.dot = known.normalize = false;
    known.raster = measured_raster(profile);
    known.points = known.raster.points() && known.raster.triangles();
    return known;
}

KnownOperations in_fragment_stage(KnownOperations known) {
    known.divide = known.divide && known.interpolation;
    known.square_root = known.dot = known.normalize = false;
    return known;
}

KnownOperations in_compute_stage(KnownOperations known, const Profile& profile) {
    known.sums = known.sums && followed(profile, {"compute: a*b+c", "compute: c-a*b"});
    known.factors_reordered =
        known.factors_reordered || !followed(profile, {"compute: v*s*t", "compute: v*s/t", "compute: v/s*t"});
    known.divide = known.divide && followed(profile, {"compute: a/b", "compute: 1/b"});
    known.square_root =
        known.square_root && followed(profile, {"compute: sqrt", "compute: inversesqrt", "compute: length"});
    known.dot = known.dot && followed(profile, {"compute: dot"});
    // A stage that keeps subnormal operands and flushes results (Mesa 26) compares them with 0 either way.
    known.subnormals = known.subnormals && !profile.compute_flush_results && followed(profile, {"compute: subnormal"});
    known.normalize = known.normalize && followed(profile, {"compute: normalize"});
    return known;
}

} // namespace lockstep
