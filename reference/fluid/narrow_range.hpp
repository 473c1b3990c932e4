#pragma once
#include <array>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include "reference/fluid/depth_map.hpp"
#include "reference/fluid/narrow_bound.hpp"
#include "reference/readings/unspecified.hpp"

namespace lockstep::fluid {

/// Pixels that a narrow-range filter reaches at most.
inline constexpr int most_narrow_reach = 20;

/// NarrowRange::weight of every sample, where it was computed beforehand.
class KnownNarrowWeights {
  public:
    /// `weight(dx, dy, n)`
    template <class Weight> explicit KnownNarrowWeights(const Weight& weight) : all_(side * side * side) {
        for (int n = 1; n < side; ++n)
            for (int dx = 0; dx <= n; ++dx)
                for (int dy = 0; dy <= n; ++dy)
                    all_[place(dx, dy, n)] = weight(dx, dy, n);
    }
    [[nodiscard]] float of(int dx, int dy, int n) const { return all_[place(std::abs(dx), std::abs(dy), n)]; }

  private:
    static constexpr int side = most_narrow_reach + 1;
    static std::size_t place(int dx, int dy, int n) { return static_cast<std::size_t>((n * side + dx) * side + dy); }
    std::vector<float> all_;
};

/// The narrow-range filter (Truong and Yuksel, "A Narrow-Range Filter for Screen-Space Fluid Rendering", 2018) at a
/// pixel, of depths in view space. Twin of shaders/fluid/narrow_range.glsl.
template <class R> class NarrowRange {
    using Real = typename R::Real;
    using Index = IndexOf<R>;

  public:
    /// `weights`: what weight() gives; null where it is to compute them itself, as all but lanes do.
    NarrowRange(R& r, const Host& host, const DepthMap<R>& map, const KnownNarrowWeights* weights = nullptr)
        : r_(r), host_(host), map_(map), weights_(weights) {}

    [[nodiscard]] Real at(const Index& x, int y, const FilterStep& step, const Real& z) const {
        const int n = reach(z);
        if constexpr (requires { z.legal(); }) {
            const NarrowBound bound = bound_at(x, y, step, n, z);
            if (bound.ways() > most_ways)
                return r_.note(site::mean, unspecified_within(r_, site::mean, z, bound.mean()));
        }
        Sums sums{z, Real(1.0F)};
        if (!r_.setting(site::takes_centre, true))
            sums = {Real(0.0F), Real(0.0F)};
        const bool is_line = step.shape == FilterStep::Shape::along;
        const Range range = around(z);
        Ranges ranges{{range, range}, is_line && r_.setting(site::two_ranges, true)};
        for_each_group(step, n, [&](const auto& offsets) { take(sums, ranges, offsets, x, y, n, z); });
        return r_.note(site::mean, r_.divide(site::mean, sums.weighted, sums.weights));
    }

    /// Of a sample so many pixels aside, of a filter of n.
    [[nodiscard]] Real weight(int dx, int dy, int n) const {
        if constexpr (HasLanes<R>)
            return weights_->of(dx, dy, n);
        const Real twice_squared = r_.real(2 * n * n);
        const int up = r_.setting(site::weighs_rows, true) ? dy : 0;
        Real nine_times = r_.real(9 * (dx * dx + up * up));
        if (host_.switches().narrow_weights == NarrowWeights::texcoord) {
            const auto squared = [&](int d) {
                const Real u = r_.divide(site::screen_width, r_.real(d),
                                         r_.uniform(site::screen_width, static_cast<float>(host_.settings().width)));
                return u * u;
            };
            nine_times = (squared(dx) + squared(up)) * Real(9.0F);
        }
        const Real x = r_.note(site::exponent, r_.divide(site::exponent, nine_times, twice_squared));
        return r_.note(site::weight, exponential_of(r_, host_, -x));
    }

  private:
    struct Sums {
        Real weighted, weights;
    };
    /// What samples are taken as they are: those farther are drawn in, those nearer refused.
    struct Range {
        Real high, low;
    };
    using Ranges = PairRanges<Range>;
    static constexpr double most_ways = 8.0; ///< tried one by one
    template <class Empty> struct SampleAt {
        Empty is_empty;
        Real z, weight;
    };
    using Sample = SampleAt<decltype(std::declval<const DepthMap<R>&>().has_nothing(site::empty, Real{}))>;

    [[nodiscard]] Real delta() const { return r_.uniform(site::delta, host_.narrow_delta()); }
    [[nodiscard]] Range around(const Real& z) const {
        return {r_.note(site::high, z + delta()), r_.note(site::low, z - delta())};
    }
    [[nodiscard]] int reach(const Real& z) const {
        const Real pixels = r_.divide(site::reach, r_.uniform(site::narrow_scale, host_.narrow_scale()), r_.abs(z));
        const Real most = r_.uniform(site::most_reach, static_cast<float>(most_narrow_reach));
        const Real whole = r_.setting(site::reach_is_ceiling, true) ? -r_.floor(-pixels) : r_.floor(pixels);
        return static_cast<int>(r_.to_int(site::reach, r_.note(site::reach, r_.min(most, whole))));
    }
    [[nodiscard]] Sample sample(const Index& x, int y, const Real& w) const {
        const Real stored = map_.at(site::sample, x, y);
        const auto empty = map_.has_nothing(site::empty, stored);
        if (everywhere(empty))
            return {empty, stored, w};
        return {empty, map_.code().decoded(stored), w};
    }
    /// Draws a sample in, widens the range by it, or refuses it with its partner.
    void judge(Sample& own, Sample& partner, Range& range, const Real& z) const {
        if constexpr (HasLanes<R>) {
            judge_lanes(own, partner, range, z);
        } else {
            const bool refuses_near = r_.setting(site::refuses_near, true);
            if (own.is_empty && !r_.setting(site::empty_is_far, true)) {
                own.weight = partner.weight = Real(0.0F);
            } else if (!own.is_empty &&
                       r_.decide(site::too_near, refuses_near ? own.z > range.high : own.z < range.low)) {
                if (!r_.setting(site::near_is_refused, true)) {
                    own.z = range.high;
                    return;
                }
                own.weight = r_.note(site::own_weight, Real(0.0F));
                if (r_.setting(site::partner_weight, true))
                    partner.weight = Real(0.0F);
            } else if (own.is_empty ||
                       r_.decide(site::too_far, refuses_near ? own.z < range.low : own.z > range.high)) {
                const Real drawn_in = z - r_.uniform(site::mu, host_.narrow_mu());
                own.z = r_.note(site::clamped_sample, r_.setting(site::drawn_to_centre, true) ? drawn_in : range.low);
                if (!r_.setting(site::far_is_kept, true))
                    own.weight = partner.weight = Real(0.0F);
            } else {
                widen(range, own.z);
            }
        }
    }
    void widen(Range& range, const Real& by) const {
        const bool keeps = r_.setting(site::range_is_kept, true);
        const Real high = by + delta(), low = by - delta();
        if (r_.setting(site::widens_high, true))
            range.high = r_.note(site::high, keeps ? r_.max(range.high, high) : high);
        if (r_.setting(site::widens_low, true))
            range.low = r_.note(site::low, keeps ? r_.min(range.low, low) : low);
    }
    /// The same, lane by lane.
    void judge_lanes(Sample& own, Sample& partner, Range& range, const Real& z) const {
        const auto near = !own.is_empty && own.z > range.high, far = own.is_empty || own.z < range.low,
                   drawn_in = !near && far, inside = !(near || far);
        own.weight = choose(near, Real(0.0F), own.weight);
        partner.weight = choose(near, Real(0.0F), partner.weight);
        range.high = choose(inside, r_.max(range.high, own.z + delta()), range.high);
        range.low = choose(inside, r_.min(range.low, own.z - delta()), range.low);
        own.z = choose(drawn_in, z - r_.uniform(site::mu, host_.narrow_mu()), own.z);
    }
    template <std::size_t n> void add(Sums& sums, const std::array<Sample, n>& samples) const {
        Real weighted = samples[0].z * samples[0].weight, weights = samples[0].weight;
        for (std::size_t i = 1; i < n; ++i) {
            weighted = weighted + samples[i].z * samples[i].weight;
            weights = weights + samples[i].weight;
        }
        sums.weighted = r_.note(site::weighted_sum, sums.weighted + weighted);
        sums.weights = r_.note(site::sum_of_weights, sums.weights + weights);
    }

    template <std::size_t n> void take(Sums& sums, Ranges& ranges, const std::array<glm::ivec2, n>& offsets,
                                       const Index& x, int y, int reach, const Real& z) const {
        const Real w = weight(offsets[0].x, offsets[0].y, reach);
        std::array<Sample, n> samples;
        for (std::size_t k = 0; k < n; ++k)
            samples[k] = sample(x + offsets[k].x, y + offsets[k].y, w);
        const bool from_first = r_.setting(site::judges_from_first, true);
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t k = from_first ? i : n - 1 - i;
            judge(samples[k], samples[n - 1 - k], ranges.of(k), z);
        }
        add(sums, samples);
    }
    [[nodiscard]] NarrowBound bound_at(const Index& x, int y, const FilterStep& step, int reach, const Real& z) const {
        NarrowBound bound(item_twin::set_of(z), host_.narrow_delta(), host_.narrow_mu(),
                          step.shape == FilterStep::Shape::along);
        for_each_group(step, reach, [&]<std::size_t n>(const std::array<glm::ivec2, n>& offsets) {
            const Real w = weight(offsets[0].x, offsets[0].y, reach);
            std::array<NarrowSample, n> samples;
            for (std::size_t k = 0; k < n; ++k)
                samples[k] = as_set(map_.at(site::sample, x + offsets[k].x, y + offsets[k].y));
            bound.take(samples, item_twin::set_of(w));
        });
        return bound;
    }
    [[nodiscard]] NarrowSample as_set(const Real& stored) const {
        const Interval set = item_twin::set_of(stored);
        const bool may_be_empty = set.contains(map_.code().empty());
        return {item_twin::set_of(map_.code().decoded(stored)), may_be_empty, !(may_be_empty && set.is_point())};
    }

    /// Calls `visit` with the offsets of samples whose partners are each other's: the first one's is the last.
    template <class Visit> void for_each_group(const FilterStep& step, int n, const Visit& visit) const {
        if (step.shape == FilterStep::Shape::along)
            along(step, n, visit);
        else if (host_.switches().narrow_cleanup == NarrowCleanup::quadrants)
            quadrants(n, visit);
        else
            plane(n, visit);
    }
    template <class Visit> void along(const FilterStep& step, int n, const Visit& visit) const {
        const auto direction = r_.uniform(site::blur_direction, step.direction);
        for (const auto i : r_.range(site::samples, 1, n)) {
            const int j = static_cast<int>(i);
            const glm::ivec2 offset(j * static_cast<int>(direction.x), j * static_cast<int>(direction.y));
            visit(std::array{offset, -offset});
        }
    }
    /// The four samples of each offset, but never those straight above or beside the pixel.
    template <class Visit> void quadrants(int n, const Visit& visit) const {
        const bool columns_first = r_.setting(site::columns_first, true);
        for (const auto outer : r_.range(site::rows, 1, n))
            for (const auto inner : r_.range(site::samples, 1, n)) {
                const int i = static_cast<int>(outer), j = static_cast<int>(inner), dx = columns_first ? i : j,
                          dy = columns_first ? j : i;
                visit(std::array{glm::ivec2(dx, dy), glm::ivec2(dx, -dy), glm::ivec2(-dx, dy), glm::ivec2(-dx, -dy)});
            }
    }
    /// Every sample of the square, in pairs through the pixel.
    template <class Visit> void plane(int n, const Visit& visit) const {
        for (const auto row : r_.range(site::rows, -n, 0))
            for (const auto column : r_.range(site::samples, -n, n)) {
                const glm::ivec2 offset(static_cast<int>(column), static_cast<int>(row));
                if (offset.y < 0 || offset.x < 0)
                    visit(std::array{offset, -offset});
            }
    }

    R& r_;
    const Host& host_;
    const DepthMap<R>& map_;
    const KnownNarrowWeights* weights_;
};

} // namespace lockstep::fluid
