#include "reference/fluid/image_lanes.hpp"

#include <memory>
#include <utility>

#include "reference/system/lane_items.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep::fluid {
namespace {

LOCKSTEP_VECTOR_CLONES void make(const DepthFilterTwin& twin, const PlainLanes& fp, const LaneRun& run) {
    make_lanes(twin, fp, run);
}
LOCKSTEP_VECTOR_CLONES void make(const DepthFilterTwin& twin, const PortableLanes& fp, const LaneRun& run) {
    make_lanes(twin, fp, run);
}
LOCKSTEP_VECTOR_CLONES void make(const NormalTwin& twin, const PlainLanes& fp, const LaneRun& run) {
    make_lanes(twin, fp, run);
}
LOCKSTEP_VECTOR_CLONES void make(const NormalTwin& twin, const PortableLanes& fp, const LaneRun& run) {
    make_lanes(twin, fp, run);
}
LOCKSTEP_VECTOR_CLONES void make(const ShadeTwin& twin, const PlainLanes& fp, const LaneRun& run) {
    make_lanes(twin, fp, run);
}
LOCKSTEP_VECTOR_CLONES void make(const ShadeTwin& twin, const PortableLanes& fp, const LaneRun& run) {
    make_lanes(twin, fp, run);
}

LOCKSTEP_VECTOR_CLONES void make(const SceneTwin& twin, const PlainLanes& fp, const LaneRun& run) {
    make_lanes(twin, fp, run);
}
LOCKSTEP_VECTOR_CLONES void make(const SceneTwin& twin, const PortableLanes& fp, const LaneRun& run) {
    make_lanes(twin, fp, run);
}

/// Whether lanes have what the switches ask.
bool has_lanes(const Switches& s) { return s.depth_fetch == DepthFetch::texel && s.scene_fetch != SceneFetch::linear; }

/// `at(in)`: the twin of an input.
template <class Twin, class At> ItemPassOptions with(ItemPassOptions options, const Twin& twin, const At& at) {
    const Settings& s = twin.host->settings();
    if (has_lanes(s.switches))
        options.fast = fast_by_lanes(s.arithmetic, s.width, at,
                                     [](const auto& of, const auto& fp, const LaneRun& run) { make(of, fp, run); });
    return options;
}

/// By the twin of one item.
template <class A> KnownNarrowWeights weights_in(const Host& host, A arithmetic) {
    Values<A> r(arithmetic);
    const SystemView nothing;
    const DepthMap<Values<A>> map(r, host, nothing, field::depth);
    const NarrowRange<Values<A>> filter(r, host, map);
    return KnownNarrowWeights([&](int dx, int dy, int n) { return static_cast<float>(filter.weight(dx, dy, n)); });
}

} // namespace

std::shared_ptr<const KnownNarrowWeights> narrow_weights(const Host& host) {
    return std::make_shared<const KnownNarrowWeights>(host.settings().arithmetic == ArithmeticSwitch::exact
                                                          ? weights_in(host, Portable{})
                                                          : weights_in(host, Strict{}));
}

ItemPassOptions by_lanes(ItemPassOptions options, const DepthFilterTwin& twin) {
    return with(std::move(options), twin, always(twin));
}
ItemPassOptions by_lanes(ItemPassOptions options, const NormalTwin& twin) {
    return with(std::move(options), twin, always(twin));
}
ItemPassOptions by_lanes(ItemPassOptions options, const ShadeTwin& twin) {
    return with(std::move(options), twin, always(twin));
}
ItemPassOptions by_lanes(ItemPassOptions options, const SceneTwin& twin) {
    return with(std::move(options), twin, while_same(twin, field::corner_position.resource));
}

} // namespace lockstep::fluid
