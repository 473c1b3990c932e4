#include "reference/lights/passes.hpp"

#include "reference/lights/step_twin.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::lights {

std::vector<std::unique_ptr<ItemPass>> twins(const HostPtr& host) {
    std::vector<std::unique_ptr<ItemPass>> all;
    all.push_back(item_pass({.name = "light_step_pass",
                             .resource = light_buffer,
                             .stage = PassStage::compute,
                             .arithmetic = host->settings().arithmetic},
                            StepTwin{host}));
    if (scatters(host->switches().accumulate))
        add_scatter_passes(host, all);
    else
        add_gather_passes(host, all);
    add_surface_passes(host, all);
    add_image_passes(host, all);
    return all;
}

} // namespace lockstep::lights
