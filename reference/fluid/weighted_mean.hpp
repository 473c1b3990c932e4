#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "reference/fluid/depth_map.hpp"
#include "reference/readings/mean_of_some.hpp"
#include "reference/readings/unspecified.hpp"

namespace lockstep::fluid {

/// The gaussian and the bilateral filter at a pixel. Twin of shaders/fluid/weighted_mean.glsl.
template <class R> class WeightedMean {
    using Real = typename R::Real;
    using Index = IndexOf<R>;

  public:
    /// `weights`: what weight() gives, from the middle on; null where it is to compute them itself, as all but lanes
    /// do.
    WeightedMean(R& r, const Host& host, const DepthMap<R>& map, const std::vector<float>* weights = nullptr)
        : r_(r), host_(host), map_(map), weights_(weights) {}

    /// Of a number that the pixel itself has.
    [[nodiscard]] Real at(const Index& x, int y, const FilterStep& step, const Real& centre) const {
        Sums sums{r_.setting(site::sum_from_0, true) ? Real(0.0F) : centre,
                  Real(r_.setting(site::weights_from_0, true) ? 0.0F : 1.0F)};
        if constexpr (requires { centre.legal(); }) {
            std::vector<Sample> samples;
            for_each_sample(x, y, step, [&](const Real& stored, const Real& w) { samples.push_back({stored, w}); });
            if (std::ranges::count_if(samples, [&](const Sample& one) { return may_be_either(one.stored); }) >
                most_open)
                return bounded(samples, centre);
            for (const Sample& one : samples)
                add(sums, one.stored, one.weight, centre);
        } else {
            for_each_sample(x, y, step, [&](const Real& stored, const Real& w) { add(sums, stored, w, centre); });
        }
        return r_.note(site::mean, r_.divide(site::mean, sums.weighted, sums.weights));
    }

    /// Of a sample so many pixels aside.
    [[nodiscard]] Real weight(int j) const {
        if constexpr (HasLanes<R>)
            return r_.uniform(site::weight, (*weights_)[static_cast<std::size_t>(std::abs(j))]);
        if (host_.switches().transcendentals == Transcendentals::portable)
            return r_.uniform(site::weight, host_.weights()[static_cast<std::size_t>(std::abs(j))]);
        const Real q = r_.real(j) * r_.uniform(site::blur_scale, host_.blur_scale());
        return r_.note(site::weight, exponential_of(r_, host_, r_.note(site::exponent, -(q * q))));
    }
    [[nodiscard]] bool is_metric() const { return host_.switches().filter_constants == FilterConstants::metric; }

  private:
    struct Sums {
        Real weighted, weights;
    };
    struct Sample {
        Real stored, weight;
    };
    static constexpr std::ptrdiff_t most_open = 3; ///< samples of which each may or may not be empty, tried every way

    template <class Visit>
    void for_each_sample(const Index& x, int y, const FilterStep& step, const Visit& visit) const {
        const int reach = host_.settings().filter_radius;
        if (step.shape == FilterStep::Shape::along) {
            const auto direction = r_.uniform(site::blur_direction, step.direction);
            for (const auto j : r_.range(site::samples, -reach, reach)) {
                const int at = static_cast<int>(j), dx = static_cast<int>(direction.x) * at,
                          dy = static_cast<int>(direction.y) * at;
                if (at == 0 && !takes_centre())
                    continue;
                visit(sample(x + dx, y + dy), weight(at));
            }
        } else {
            for (const auto row : r_.range(site::rows, -reach, reach))
                for (const auto column : r_.range(site::samples, -reach, reach)) {
                    const int dx = static_cast<int>(column), dy = static_cast<int>(row);
                    if (dx == 0 && dy == 0 && !takes_centre())
                        continue;
                    visit(sample(x + dx, y + dy), weight(dx) * r_.note(site::row_weight, weight(dy)));
                }
        }
    }
    [[nodiscard]] bool takes_centre() const { return r_.setting(site::takes_centre, true); }
    [[nodiscard]] bool may_be_either(const Real& stored) const {
        const Interval set = item_twin::set_of(stored);
        return set.any || (!set.is_point() && set.contains(map_.code().empty()));
    }
    /// Of samples of which many may or may not be empty: what no choice among them leaves.
    [[nodiscard]] Real bounded(const std::vector<Sample>& samples, const Real& centre) const {
        std::vector<WeightedTerm> terms;
        for (const Sample& one : samples) {
            const bool open = may_be_either(one.stored);
            if (!open && map_.is_empty(site::empty, one.stored))
                continue;
            const Term term = term_of(one.stored, one.weight, centre);
            terms.push_back({item_twin::set_of(term.s), item_twin::set_of(term.share), open});
        }
        return r_.note(site::mean, unspecified_within(r_, site::mean, centre, mean_of_some(terms)));
    }

    [[nodiscard]] Real sample(const Index& x, int y) const { return map_.at(site::sample, x, y); }
    void add(Sums& sums, const Real& stored, const Real& w, const Real& centre) const {
        const bool skips = r_.setting(site::skips_empty, true);
        const auto empty = map_.has_nothing(site::empty, stored);
        if (skips && everywhere(empty)) {
            if (r_.setting(site::empty_weighs, false))
                sums.weights = sums.weights + w;
            return;
        }
        const Term term = term_of(stored, w, centre);
        const auto left_out = skips && empty;
        sums.weighted = r_.note(site::weighted_sum, choose(left_out, sums.weighted, sums.weighted + term.part));
        sums.weights = r_.note(site::sum_of_weights, choose(left_out, sums.weights, sums.weights + term.share));
    }

    struct Term {
        Real s, part, share;
    };
    [[nodiscard]] Term term_of(const Real& stored, const Real& w, const Real& centre) const {
        const Real s = is_metric() ? map_.code().decoded(stored) : stored;
        if (host_.switches().filter != Filter::bilateral)
            return {s, s * w, w};
        const Real part = s * w,
                   q = r_.note(site::range_step, (s - centre) * r_.uniform(site::range_scale, host_.range_scale()));
        const Real power = r_.setting(site::range_is_squared, true) ? q * q : q;
        const Real v = r_.note(site::range_weight, exponential_of(r_, host_, r_.note(site::exponent, -power)));
        return {s, r_.setting(site::range_in_sum, true) ? part * v : part,
                r_.setting(site::range_in_weights, true) ? w * v : w};
    }

    R& r_;
    const Host& host_;
    const DepthMap<R>& map_;
    const std::vector<float>* weights_;
};

} // namespace lockstep::fluid
