#include "reference/fluid/image_lanes.hpp"
#include "reference/fluid/motion_twin.hpp"
#include "reference/fluid/passes.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::fluid {

void add_scene_passes(const HostPtr& host, Passes& all) {
    if (host->moves())
        all.push_back(
            item_pass(options_of(*host, "motion_pass", particle_buffer, PassStage::compute), MotionTwin{host}));
    all.push_back(
        lane_pass(options_of(*host, "scene_pass", scene_image, PassStage::fragment), SceneTwin{host, Drawn::colour}));
    ItemPassOptions second = options_of(*host, "scene_pass_depth", scene_depth_image, PassStage::fragment);
    second.continues = true;
    all.push_back(lane_pass(second, SceneTwin{host, Drawn::depth}));
}

} // namespace lockstep::fluid
