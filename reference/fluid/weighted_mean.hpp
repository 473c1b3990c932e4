#pragma once
#include <cstddef>
#include <cstdlib>

#include "reference/fluid/depth_map.hpp"

namespace lockstep::fluid {

/// The gaussian and the bilateral filter at a pixel. Twin of shaders/fluid/weighted_mean.glsl.
template <class R> class WeightedMean {
    using Real = typename R::Real;
    using Index = IndexOf<R>;

  public:
    WeightedMean(R& r, const Host& host, const DepthMap<R>& map) : r_(r), host_(host), map_(map) {}

    /// Of a number that the pixel itself has.
    [[nodiscard]] Real at(const Index& x, int y, const FilterStep& step, const Real& centre) const {
        Sums sums{Real(0.0F), Real(0.0F)};
        const int reach = host_.settings().filter_radius;
        if (step.shape == FilterStep::Shape::along) {
            const auto direction = r_.uniform(site::blur_direction, step.direction);
            for (const auto j : r_.range(site::samples, -reach, reach)) {
                const int at = static_cast<int>(j), dx = static_cast<int>(direction.x) * at,
                          dy = static_cast<int>(direction.y) * at;
                add(sums, sample(x + dx, y + dy), weight(at), centre);
            }
        } else {
            for (const auto row : r_.range(site::rows, -reach, reach))
                for (const auto column : r_.range(site::samples, -reach, reach)) {
                    const int dx = static_cast<int>(column), dy = static_cast<int>(row);
                    add(sums, sample(x + dx, y + dy), weight(dx) * r_.note(site::row_weight, weight(dy)), centre);
                }
        }
        return r_.note(site::mean, r_.divide(site::mean, sums.weighted, sums.weights));
    }

    [[nodiscard]] bool is_metric() const { return host_.switches().filter_constants == FilterConstants::metric; }

  private:
    struct Sums {
        Real weighted, weights;
    };

    [[nodiscard]] Real sample(const Index& x, int y) const { return map_.at(site::sample, x, y); }
    [[nodiscard]] Real weight(int j) const {
        if (host_.switches().transcendentals == Transcendentals::portable)
            return r_.uniform(site::weight, host_.weights()[static_cast<std::size_t>(std::abs(j))]);
        const Real q = r_.real(j) * r_.uniform(site::blur_scale, host_.blur_scale());
        return r_.note(site::weight, exponential_of(r_, host_, r_.note(site::exponent, -(q * q))));
    }
    void add(Sums& sums, const Real& stored, const Real& w, const Real& centre) const {
        const bool skips = r_.setting(site::skips_empty, true);
        const auto empty = map_.has_nothing(site::empty, stored);
        if (skips && everywhere(empty))
            return;
        const Real s = is_metric() ? map_.code().decoded(stored) : stored;
        Real part = s * w, share = w;
        if (host_.switches().filter == Filter::bilateral) {
            const Real q = r_.note(site::range_step, (s - centre) * r_.uniform(site::range_scale, host_.range_scale()));
            const Real v = r_.note(site::range_weight, exponential_of(r_, host_, r_.note(site::exponent, -(q * q))));
            part = part * v;
            share = w * v;
        }
        const auto left_out = skips && empty;
        sums.weighted = r_.note(site::weighted_sum, choose(left_out, sums.weighted, sums.weighted + part));
        sums.weights = r_.note(site::sum_of_weights, choose(left_out, sums.weights, sums.weights + share));
    }

    R& r_;
    const Host& host_;
    const DepthMap<R>& map_;
};

} // namespace lockstep::fluid
