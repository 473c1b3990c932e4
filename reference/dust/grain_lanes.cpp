#include <numeric>

#include "reference/dust/blow_wind_twin.hpp"
#include "reference/dust/explode_twin.hpp"
#include "reference/dust/tools_fast.hpp"
#include "reference/dust/update_fast.hpp"
#include "reference/dust/update_twin.hpp"
#include "reference/dust/vacuum_up_twin.hpp"
#include "reference/system/lane_items.hpp"
#include "reference/vector_loops.hpp"

// The fast ways of kernels: what surely flies or stays as it is, by blocks; what is left, the twin by lanes.
namespace lockstep::dust {
namespace {

LOCKSTEP_MAKE_ITEMS(UpdateTwin)
LOCKSTEP_MAKE_ITEMS(VacuumUpTwin)
LOCKSTEP_MAKE_ITEMS(BlowWindTwin)
LOCKSTEP_MAKE_ITEMS(ExplodeTwin)

/// Lanes take entries of matrices as they are.
bool has_tiny(const std::vector<ColliderMatrices>& colliders) {
    const auto in = [](const glm::mat4& m) {
        for (int k = 0; k < 16; ++k)
            if (m[k / 4][k % 4] != 0.0F && Portable::flush(m[k / 4][k % 4]) == 0.0F)
                return true;
        return false;
    };
    return std::any_of(colliders.begin(), colliders.end(),
                       [&](const ColliderMatrices& one) { return in(one.local_to_world) || in(one.world_to_local); });
}

template <class Twin> bool by_lanes(const Twin& twin, const FastRun& run, const std::vector<std::size_t>& grains) {
    const bool made = fast_by_lanes(
        twin, run, [&](const Twin& of, const auto& fp, const FastRun& how) { make(of, fp, how, grains); });
    if (!made)
        run.left.insert(run.left.end(), grains.begin(), grains.end());
    return true;
}

template <class Twin> bool within(const Twin& twin, const Reach& reach, const FastRun& run) {
    std::vector<std::size_t> grains;
    reach_fast(*twin.host, reach, run.in, run.first, run.last, run.after, grains);
    return by_lanes(twin, run, grains);
}

} // namespace

bool UpdateTwin::fast(const FastRun& run) const {
    if (has_tiny(host->colliders().boxes))
        return false;
    std::vector<std::size_t> grains;
    if (has_update_fast(*host)) {
        update_fast(*host, run.in, run.profile, run.first, run.last, run.after, grains);
    } else {
        grains.resize(run.last - run.first);
        std::iota(grains.begin(), grains.end(), run.first);
    }
    return by_lanes(*this, run, grains);
}

bool VacuumUpTwin::fast(const FastRun& run) const { return within(*this, vacuum_reach(*host, run.in.frame), run); }
bool BlowWindTwin::fast(const FastRun& run) const { return within(*this, cone_of(values), run); }
bool ExplodeTwin::fast(const FastRun& run) const { return within(*this, blast_reach(*host, run.in.frame, ball), run); }

} // namespace lockstep::dust
