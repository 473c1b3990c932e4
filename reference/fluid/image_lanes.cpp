#include "reference/fluid/depth_filter_twin.hpp"
#include "reference/fluid/linear_lanes.hpp"
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

} // namespace

bool DepthFilterTwin::fast(const FastRun& run) const {
    return lanes_filter(*host) && fast_by_lanes(*this, run, make_all);
}
bool NormalTwin::fast(const FastRun& run) const { return lanes_filter(*host) && fast_by_lanes(*this, run, make_all); }
bool ShadeTwin::fast(const FastRun& run) const {
    return lanes_filter(*host, host->switches().scene_fetch == SceneFetch::linear) &&
           fast_by_lanes(*this, run, make_all);
}
bool SceneTwin::fast(const FastRun& run) const {
    SceneTwin seeing = *this;
    seeing.seen = view->seen(run.in.before);
    return fast_by_lanes(seeing, run, make_all);
}

} // namespace lockstep::fluid
