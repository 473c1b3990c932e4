#include "reference/fluid/by_driver.hpp"
#include "reference/fluid/passes.hpp"
#include "reference/fluid/sphere_depth_twin.hpp"

namespace lockstep::fluid {

void add_sphere_pass(const HostPtr& host, Passes& all) {
    all.push_back(by_points(host, [](const HostPtr& by) {
        return item_pass(options_of(*by, "sphere_depth_pass", depth_image, PassStage::fragment), SphereDepthTwin{by});
    }));
}

} // namespace lockstep::fluid
