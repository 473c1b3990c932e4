#include "reference/model/profile.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {

std::span<const std::string_view> dot_order_names() {
    static constexpr std::array<std::string_view, 11> names{
        "(x+y)+z",         "x+(y+z)",    "fma(z,fma(y,x))", "(x+z)+y",    "fma(x,fma(y,z))", "fma(z,fma(x,y))",
        "fma(x,fma(z,y))", "fma(z,x+y)", "fma(x,y+z)",      "fma(y,x)+z", "x+fma(y,z)"};
    return names;
}

namespace {

/// The rows not followed of the stages that draw; what the compute stage does otherwise has no part in a name, nor what
/// becomes of functions, nor what only some systems' images rest on.
std::vector<std::string> drawing_rows(const Profile& profile) {
    std::vector<std::string> rows = profile.not_followed;
    std::erase_if(rows, [](const std::string& row) {
        return row.starts_with("compute:") || row.starts_with("image: ") || row.ends_with(", in functions");
    });
    return rows;
}

} // namespace

bool Profile::follows(std::string_view row) const { return std::ranges::find(not_followed, row) == not_followed.end(); }

bool computes_alike(const Profile& a, const Profile& b) {
    const auto same = [&](std::int64_t OperationErrors::*error) {
        return (a.errors.*error == 0) == (b.errors.*error == 0);
    };
    return a.dot == b.dot && a.length_order() == b.length_order() && a.normalize_order() == b.normalize_order() &&
           a.other_orders == b.other_orders && a.normalize_divides == b.normalize_divides &&
           a.flush_subnormals == b.flush_subnormals && a.raster == b.raster && drawing_rows(a) == drawing_rows(b) &&
           same(&OperationErrors::divide) && same(&OperationErrors::reciprocal) && same(&OperationErrors::sqrt) &&
           same(&OperationErrors::inverse_sqrt) && same(&OperationErrors::length) &&
           same(&OperationErrors::normalize) && same(&OperationErrors::fragment_divide) &&
           same(&OperationErrors::fragment_reciprocal);
}

Profile named_profile(std::string_view name) {
    Profile profile;
    profile.name = name;
    if (name == "strict")
        return profile;
    if (name == "llvmpipe") {
        profile.dot = DotOrder::right_to_left;
        profile.compute_flush_subnormals = false;
        profile.point_sizes = {1.0F, 255.0F};
        return profile;
    }
    if (name == "nvidia") {
        profile.dot = DotOrder::fused_chain;
        profile.errors = {2, 1, 3, 2, 3, 4, 2, 1};
        profile.raster.point_snap = SnapRounding::half_to_even;
        profile.raster.viewport = profile.raster.vertex_viewport = ViewportRounding::scaled;
        profile.raster.depth_by_driver_reciprocal = true;
        profile.point_sizes = {1.0F, 2047.0F};
        profile.point_window_accurate = profile.corner_window_accurate = true;
        profile.not_followed = {"points: viewport", "triangles: viewport"};
        return profile;
    }
    throw Error(fmt::format("unknown profile '{}'; the profiles are strict, llvmpipe, nvidia", name));
}

} // namespace lockstep
