#pragma once
#include <array>
#include <cstddef>

#include "reference/lights/sampling.hpp"
#include "reference/system/lane_items.hpp"

namespace lockstep::lights {

using LanePlaces = std::array<FloatLanes, 3>;           ///< x, y and z of each lane's place
using LaneSamples = std::array<FloatLanes, lane_count>; ///< of each lane its channels, (C, count) and (D, W)

/// What SamplingTwin has of the places of active lanes, their eight channels on vectors.
void sample(const PlainLanes&, const Host& host, const SystemView& state, const LanePlaces& places, unsigned active,
            LaneSamples& made);
void sample(const PortableLanes&, const Host& host, const SystemView& state, const LanePlaces& places, unsigned active,
            LaneSamples& made);

/// Of lanes one after the other: they lie in voxels of their own, the samples of one beside each other.
template <class F> class SamplingTwin<Lanes<F>> {
  public:
    SamplingTwin(Lanes<F>& r, const Host& host, const SystemView& state) : r_(r), host_(host), state_(state) {}

    [[nodiscard]] Sample<Lanes<F>> mean_at(const Vec3<LaneReal<F>>& u) const {
        LaneSamples of_lane{};
        sample(r_.arithmetic(), host_, state_, {u.x.v, u.y.v, u.z.v}, r_.active(), of_lane);
        lanes::transpose(of_lane);
        Sample<Lanes<F>> made;
        for (std::size_t c = 0; c < made.size(); ++c)
            made[c] = of_lane[c];
        return made;
    }

  private:
    Lanes<F>& r_;
    const Host& host_;
    const SystemView& state_;
};

} // namespace lockstep::lights
