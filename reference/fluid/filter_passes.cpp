#include "reference/fluid/depth_filter_twin.hpp"
#include "reference/fluid/passes.hpp"

namespace lockstep::fluid {

void add_filter_passes(const HostPtr& host, Passes& all) {
    for (const FilterStep& step : host->filter_steps())
        all.push_back(item_pass(options_of(*host, "depth_filter_pass", smooth_depth_image, PassStage::compute),
                                DepthFilterTwin{host, step}));
}

} // namespace lockstep::fluid
