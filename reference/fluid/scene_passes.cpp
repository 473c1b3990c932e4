#include "reference/fluid/motion_twin.hpp"
#include "reference/fluid/passes.hpp"
#include "reference/fluid/scene_twin.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::fluid {

void add_scene_passes(const HostPtr& host, Passes& all) {
    if (host->moves())
        all.push_back(
            item_pass(options_of(*host, "motion_pass", particle_buffer, PassStage::compute), MotionTwin{host}));
    const Settings& s = host->settings();
    const auto triangles = std::make_shared<const LatestTriangles>(
        TriangleCamera{field::corner_position, host->view_projection(), s.width, s.height, s.arithmetic});
    all.push_back(item_pass(options_of(*host, "scene_pass", scene_image, PassStage::fragment),
                            SceneTwin{host, Drawn::colour, triangles}));
    ItemPassOptions second = options_of(*host, "scene_pass_depth", scene_depth_image, PassStage::fragment);
    second.continues = true;
    all.push_back(item_pass(second, SceneTwin{host, Drawn::depth, triangles}));
}

} // namespace lockstep::fluid
