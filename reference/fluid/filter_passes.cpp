#include "reference/fluid/by_driver.hpp"
#include "reference/fluid/depth_filter_twin.hpp"
#include "reference/fluid/passes.hpp"

namespace lockstep::fluid {
namespace {

// Weights by the twin of one item.
template <class A> void add_weights(DepthFilterTwin& twin, A arithmetic) {
    const Host& host = *twin.host;
    Values<A> r(arithmetic);
    const SystemView nothing;
    const DepthMap<Values<A>> map(r, host, nothing, field::depth);
    if (host.switches().filter == Filter::narrow_range) {
        const NarrowRange<Values<A>> filter(r, host, map);
        twin.narrow_weights = std::make_shared<const KnownNarrowWeights>(
            [&](int dx, int dy, int n) { return static_cast<float>(filter.weight(dx, dy, n)); });
    } else if (host.switches().filter != Filter::curvature_flow) {
        const WeightedMean<Values<A>> filter(r, host, map);
        std::vector<float> weights;
        for (int j = 0; j <= host.settings().filter_radius; ++j)
            weights.push_back(static_cast<float>(filter.weight(j)));
        twin.mean_weights = std::make_shared<const std::vector<float>>(std::move(weights));
    }
}

} // namespace

void add_filter_passes(const HostPtr& host, Passes& all) {
    DepthFilterTwin twin{.host = host, .step = {}};
    // Of the host's arithmetic; in the plain one for drivers without tables of roots.
    if (host->settings().arithmetic == ArithmeticSwitch::exact)
        add_weights(twin, Portable{});
    else
        add_weights(twin, Strict{});
    for (const FilterStep& step : host->filter_steps()) {
        twin.step = step;
        all.push_back(by_filter(host, [twin](const HostPtr& by) {
            DepthFilterTwin made = twin;
            made.host = by;
            return item_pass(options_of(*by, "depth_filter_pass", smooth_depth_image, PassStage::compute), made);
        }));
    }
}

} // namespace lockstep::fluid
