#include "reference/lights/lighting_twin.hpp"
#include "reference/lights/sampling_lanes.hpp"
#include "reference/lights/volume_twin.hpp"
#include "reference/system/lane_items.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep::lights {
namespace {

LOCKSTEP_MAKE_LANES(DrawnTwin)
LOCKSTEP_MAKE_LANES(DeferredTwin)
LOCKSTEP_MAKE_LANES(ResolveTwin)

constexpr auto make_all = [](const auto& twin, const auto& fp, const FastRun& run) { make(twin, fp, run); };

} // namespace

bool DrawnTwin::fast(const FastRun& run) const {
    DrawnTwin seeing = *this;
    seeing.seen = view->seen(run.in.before);
    return fast_by_lanes(seeing, run, make_all);
}
bool DeferredTwin::fast(const FastRun& run) const { return fast_by_lanes(*this, run, make_all); }
bool ResolveTwin::fast(const FastRun& run) const { return fast_by_lanes(*this, run, make_all); }

} // namespace lockstep::lights
