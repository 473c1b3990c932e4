#include "reference/fluid/image_lanes.hpp"
#include "reference/fluid/passes.hpp"

namespace lockstep::fluid {

void add_filter_passes(const HostPtr& host, Passes& all) {
    std::shared_ptr<const KnownNarrowWeights> weights;
    if (host->switches().filter == Filter::narrow_range)
        weights = narrow_weights(*host);
    for (const FilterStep& step : host->filter_steps())
        all.push_back(lane_pass(options_of(*host, "depth_filter_pass", smooth_depth_image, PassStage::compute),
                                DepthFilterTwin{host, step, weights}));
}

} // namespace lockstep::fluid
