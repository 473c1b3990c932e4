#include "crosscheck/profiles.hpp"

#include <fmt/format.h>

#include "gpu/context.hpp"

namespace lockstep {

Profile measured_profile(const Context&) { return named_profile("llvmpipe"); }

std::string describe(const Profile& profile) {
    const auto dot = [&] {
        switch (profile.dot) {
        case DotOrder::left_to_right:
            return "(x + y) + z";
        case DotOrder::right_to_left:
            return "x + (y + z)";
        case DotOrder::fused_chain:
            return "fma(z, fma(y, x))";
        }
        return "";
    };
    return fmt::format("{}: dot {}, subnormals {}, {} sub-pixel bits, points on an edge to the {} pixel", profile.name,
                       dot(), profile.flush_subnormals ? "flushed" : "kept", profile.raster.subpixel_bits,
                       profile.raster.point_edge_to_lower ? "lower" : "upper");
}

} // namespace lockstep
