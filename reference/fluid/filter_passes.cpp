#include "reference/fluid/depth_filter_twin.hpp"
#include "reference/fluid/passes.hpp"

namespace lockstep::fluid {
namespace {

/// By the twin of one item.
template <class A> KnownNarrowWeights weights_in(const Host& host, A arithmetic) {
    Values<A> r(arithmetic);
    const SystemView nothing;
    const DepthMap<Values<A>> map(r, host, nothing, field::depth);
    const NarrowRange<Values<A>> filter(r, host, map);
    return KnownNarrowWeights([&](int dx, int dy, int n) { return static_cast<float>(filter.weight(dx, dy, n)); });
}

/// Of the host's arithmetic; in the plain one for drivers without tables of roots.
std::shared_ptr<const KnownNarrowWeights> narrow_weights(const Host& host) {
    return std::make_shared<const KnownNarrowWeights>(host.settings().arithmetic == ArithmeticSwitch::exact
                                                          ? weights_in(host, Portable{})
                                                          : weights_in(host, Strict{}));
}

} // namespace

void add_filter_passes(const HostPtr& host, Passes& all) {
    std::shared_ptr<const KnownNarrowWeights> weights;
    if (host->switches().filter == Filter::narrow_range)
        weights = narrow_weights(*host);
    for (const FilterStep& step : host->filter_steps())
        all.push_back(item_pass(options_of(*host, "depth_filter_pass", smooth_depth_image, PassStage::compute),
                                DepthFilterTwin{host, step, weights}));
}

} // namespace lockstep::fluid
