#include "reference/lights/image_lanes.hpp"

#include <utility>

#include "reference/lights/sampling_lanes.hpp"
#include "reference/system/lane_items.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep::lights {
namespace {

LOCKSTEP_VECTOR_CLONES void make(const DrawnTwin& twin, const PlainLanes& fp, const LaneRun& run) {
    make_lanes(twin, fp, run);
}
LOCKSTEP_VECTOR_CLONES void make(const DrawnTwin& twin, const PortableLanes& fp, const LaneRun& run) {
    make_lanes(twin, fp, run);
}
LOCKSTEP_VECTOR_CLONES void make(const DeferredTwin& twin, const PlainLanes& fp, const LaneRun& run) {
    make_lanes(twin, fp, run);
}
LOCKSTEP_VECTOR_CLONES void make(const DeferredTwin& twin, const PortableLanes& fp, const LaneRun& run) {
    make_lanes(twin, fp, run);
}

/// `at(in)`: the twin of an input.
template <class Twin, class At> ItemPassOptions with(ItemPassOptions options, const Twin& twin, const At& at) {
    const Settings& s = twin.host->settings();
    options.fast = fast_by_lanes(s.arithmetic, s.width, at,
                                 [](const auto& of, const auto& fp, const LaneRun& run) { make(of, fp, run); });
    return options;
}

} // namespace

ItemPassOptions by_lanes(ItemPassOptions options, const DrawnTwin& twin) {
    return with(std::move(options), twin, while_same(twin, field::corner_position.resource));
}
ItemPassOptions by_lanes(ItemPassOptions options, const DeferredTwin& twin) {
    return with(std::move(options), twin, always(twin));
}

} // namespace lockstep::lights
