#include <algorithm>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "tests/fluid/fluid_run.hpp"
#include "tests/item_bits.hpp"
#include "tests/uneven_roots.hpp"

namespace lockstep::test::lanes_test {

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

TEST_CASE("fluid lanes: spheres that hide one another, from the back and from the front, far and up to the camera") {
    const Strings values = GENERATE(Strings{"sprite=points", "sphere=flat"}, Strings{"sprite=quad", "sphere=ray"},
                                    Strings{"sprite=quad", "depth_value=view", "depth_format=r32f", "unproject=stored"},
                                    Strings{"sprite=quad", "depth_value=ndc"});
    const float away = GENERATE(1.0F, 0.25F); // from the middle, of the scene's
    const bool reversed = GENERATE(false, true);
    CAPTURE(values, away, reversed);
    fluid::Settings s = with(in_preset(heap(6), "corrected"), values);
    s.switches.filter = fluid::Filter::off;
    s.width = 53;
    s.height = 43;
    s.radius = 0.18F;
    s.camera.eye = s.camera.target + away * (s.camera.eye - s.camera.target);
    // Larger than they are far: what is nearest of these lies behind the camera.
    const glm::vec3 ahead = glm::normalize(s.camera.target - s.camera.eye);
    for (const float far : {0.14F, 0.15F, 0.17F})
        s.particles.push_back(s.camera.eye + far * ahead + glm::vec3(0.04F * (far - 0.14F), 0.0F, 0.0F));
    if (reversed)
        std::ranges::reverse(s.particles);
    check_item_bits(fluid::system(host_of(s)), Profile{}, 1);
}

TEST_CASE("fluid lanes: quotients and roots by a driver's tables") {
    const Profile profile = profile_with_roots();
    fluid::Settings s = in_preset(heap(3), GENERATE("corrected", "paper"));
    s.width = 21;
    s.height = 13;
    s.filter_radius = 2;
    s.flow_iterations = 1;
    check_item_bits(fluid::system(host_of(s)), profile, 1);
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

} // namespace lockstep::test::lanes_test
