#include "reference/fluid/passes.hpp"
#include "reference/fluid/sphere_depth_twin.hpp"

namespace lockstep::fluid {

void add_sphere_pass(const HostPtr& host, Passes& all) {
    all.push_back(
        item_pass(options_of(*host, "sphere_depth_pass", depth_image, PassStage::fragment), SphereDepthTwin{host}));
}

} // namespace lockstep::fluid
