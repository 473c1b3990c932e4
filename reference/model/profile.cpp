#include "reference/model/profile.hpp"

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {

bool computes_alike(const Profile& a, const Profile& b) {
    const auto same = [&](std::int64_t OperationErrors::*error) {
        return (a.errors.*error == 0) == (b.errors.*error == 0);
    };
    return a.dot == b.dot && a.flush_subnormals == b.flush_subnormals && a.raster == b.raster &&
           a.not_followed == b.not_followed && same(&OperationErrors::divide) && same(&OperationErrors::reciprocal) &&
           same(&OperationErrors::sqrt) && same(&OperationErrors::inverse_sqrt) && same(&OperationErrors::length) &&
           same(&OperationErrors::normalize);
}

Profile named_profile(std::string_view name) {
    Profile profile;
    profile.name = name;
    if (name == "strict")
        return profile;
    if (name == "llvmpipe") {
        profile.dot = DotOrder::right_to_left;
        profile.compute_flush_subnormals = false;
        return profile;
    }
    if (name == "nvidia") {
        profile.dot = DotOrder::fused_chain;
        profile.errors = {2, 1, 3, 2, 3, 4};
        profile.raster.point_snap = SnapRounding::half_to_even;
        profile.raster.viewport = ViewportRounding::scaled;
        profile.raster.depth_by_driver_reciprocal = true;
        profile.not_followed = {"points: viewport", "triangles: viewport"};
        return profile;
    }
    throw Error(fmt::format("unknown profile '{}'; the profiles are strict, llvmpipe, nvidia", name));
}

} // namespace lockstep
