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

/// Of twins that read an image around the pixels they make.
template <class Twin> bool fast_around(const Twin& twin, const FastRun& run) {
    const auto row_of = [&](std::size_t item) { return Pixel::of(twin.host->settings().width, item).y; };
    if (!lanes_filter(*twin.host))
        return false;
    if (twin.image != nullptr)
        twin.image->make_around(run.in.before, row_of(run.first), row_of(run.last - 1));
    return fast_by_lanes(twin, run, make_all);
}

} // namespace

bool DepthFilterTwin::fast(const FastRun& run) const { return fast_around(*this, run); }
bool NormalTwin::fast(const FastRun& run) const { return fast_around(*this, run); }
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
