#pragma once
#include <array>
#include <cstddef>

#include <glm/vec3.hpp>

#include "reference/lights/sampling.hpp"
#include "reference/system/lane_items.hpp"

namespace lockstep::lights {

/// What SamplingTwin has of one place, its eight channels on vectors, and what samples have in common computed once.
/// `u`: the place; `made`: (C, count) and (D, W).
void sample(const PlainLanes&, const Host& host, const SystemView& state, const glm::vec3& u,
            std::array<float, lane_count>& made);
void sample(const PortableLanes&, const Host& host, const SystemView& state, const glm::vec3& u,
            std::array<float, lane_count>& made);

/// Of lanes one after the other: they lie in voxels of their own, the samples of one beside each other.
template <class F> class SamplingTwin<Lanes<F>> {
  public:
    SamplingTwin(Lanes<F>& r, const Host& host, const SystemView& state) : r_(r), host_(host), state_(state) {}

    [[nodiscard]] Sample<Lanes<F>> mean_at(const Vec3<LaneReal<F>>& u) const {
        std::array<std::array<float, lane_count>, lane_count> of_lane{};
        for (int lane = 0; lane < lane_count; ++lane)
            if ((r_.active() >> lane & 1U) != 0)
                sample(r_.arithmetic(), host_, state_, {u.x.v[lane], u.y.v[lane], u.z.v[lane]},
                       of_lane[static_cast<std::size_t>(lane)]);
        Sample<Lanes<F>> made;
        for (std::size_t c = 0; c < made.size(); ++c)
            for (int lane = 0; lane < lane_count; ++lane)
                made[c].v[lane] = of_lane[static_cast<std::size_t>(lane)][c];
        return made;
    }

  private:
    Lanes<F>& r_;
    const Host& host_;
    const SystemView& state_;
};

} // namespace lockstep::lights
