#include <string>
#include <vector>

#include "tests/fluid/fluid_run.hpp"
#include "tests/item_bits.hpp"

using namespace lockstep;
using namespace lockstep::test;
namespace fluid = lockstep::fluid;

namespace {

using Strings = std::vector<std::string>;

} // namespace

TEST_CASE("fluid lanes: every pixel of every pass is that of the twin by itself") {
    const std::string preset = GENERATE("exact", "corrected", "paper");
    const Strings values =
        GENERATE(Strings{"filter=gaussian", "filter_shape=full2d"}, Strings{"filter=bilateral"},
                 Strings{"filter=bilateral", "transcendentals=builtin", "filter_constants=published"},
                 Strings{"filter=narrow_range", "depth_value=window"},
                 Strings{"filter=narrow_range", "narrow_cleanup=quadrants", "narrow_weights=texcoord",
                         "depth_value=view", "depth_format=r32f", "unproject=stored"},
                 Strings{"filter=curvature_flow", "scene_fetch=nearest", "depth_value=view", "depth_format=r32f",
                         "unproject=stored", "depth_fetch=texel"});
    CAPTURE(preset, values);
    fluid::Settings s = with(in_preset(heap(4), preset), values);
    s.width = 21; // no multiple of the lanes
    s.height = 13;
    s.filter_radius = 2;
    s.flow_iterations = 1;
    const fluid::HostPtr host = host_of(s);
    check_item_bits(fluid::system(host), Profile{}, 1);
}

TEST_CASE("fluid lanes: orders of sums are the driver's") {
    Profile profile;
    profile.dot =
        GENERATE(DotOrder::left_to_right, DotOrder::right_to_left, DotOrder::fused_chain, DotOrder::middle_last);
    fluid::Settings s = in_preset(heap(3), "corrected");
    s.width = 21;
    s.height = 13;
    s.filter_radius = 2;
    s.flow_iterations = 1;
    const fluid::HostPtr host = host_of(s);
    check_item_bits(fluid::system(host), profile, 1);
}
