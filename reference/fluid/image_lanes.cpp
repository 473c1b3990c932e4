#include "reference/fluid/depth_filter_twin.hpp"
#include "reference/fluid/normal_twin.hpp"
#include "reference/fluid/scene_twin.hpp"
#include "reference/fluid/shade_twin.hpp"
#include "reference/system/lane_items.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep::fluid {
namespace {

LOCKSTEP_MAKE_LANES(DepthFilterTwin)
LOCKSTEP_MAKE_LANES(NormalTwin)
LOCKSTEP_MAKE_LANES(ShadeTwin)
LOCKSTEP_MAKE_LANES(SceneTwin)

constexpr auto make_all = [](const auto& twin, const auto& fp, const FastRun& run) { make(twin, fp, run); };

/// Where lanes have what the switches ask.
template <class Twin> bool by_lanes(const Twin& twin, const FastRun& run) {
    const Switches& on = twin.host->switches();
    return on.depth_fetch == DepthFetch::texel && on.scene_fetch != SceneFetch::linear &&
           fast_by_lanes(twin, run, make_all);
}

} // namespace

bool DepthFilterTwin::fast(const FastRun& run) const { return by_lanes(*this, run); }
bool NormalTwin::fast(const FastRun& run) const { return by_lanes(*this, run); }
bool ShadeTwin::fast(const FastRun& run) const { return by_lanes(*this, run); }
bool SceneTwin::fast(const FastRun& run) const {
    SceneTwin seeing = *this;
    seeing.seen = view->seen(run.in.before);
    return fast_by_lanes(seeing, run, make_all);
}

} // namespace lockstep::fluid
