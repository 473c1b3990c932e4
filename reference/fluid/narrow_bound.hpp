#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "reference/interval.hpp"
#include "reference/readings/mean_of_some.hpp"

namespace lockstep::fluid {

/// The ranges by which pairs of samples are judged: one for all, or the second of each pair has its own.
template <class Range> struct PairRanges {
    std::array<Range, 2> all;
    bool are_two = false;
    Range& of(std::size_t sample) { return all[are_two && sample == 1 ? 1 : 0]; }
};

/// A sample of the narrow-range filter: its depth where it is not empty, m, and which of both it may be.
struct NarrowSample {
    Interval z;
    bool may_be_empty = false, may_be_full = true;
};

/// What the narrow-range filter may give of samples that are sets, whichever numbers of these they are. Of each sample
/// it keeps what it may count as, of the range the sets of both ends; which sample led to which range is forgotten, so
/// that it holds more than every choice tried by itself.
class NarrowBound {
  public:
    /// `two_ranges`: the second of a pair is judged by a range of its own.
    NarrowBound(const Interval& z, float delta, float mu, bool two_ranges)
        : delta_(delta), drawn_in_(rounded(interval::add(z, Interval(-mu)))), terms_{{z, Interval(1.0F), false}} {
        const Range range{widened(z, delta_), widened(z, -delta_)};
        ranges_ = {{range, range}, two_ranges};
    }

    /// Samples in the order in which they are judged. The partner of the first is the last.
    template <std::size_t n> void take(const std::array<NarrowSample, n>& samples, const Interval& weight) {
        std::array<Judged, n> judged;
        for (std::size_t k = 0; k < n; ++k)
            judged[k] = judge(samples[k], ranges_.of(k));
        for (std::size_t k = 0; k < n; ++k) {
            const Judged &own = judged[k], &partner = judged[n - 1 - k];
            if (own.may_count && partner.may_count)
                terms_.push_back({own.value, weight, own.may_be_refused || partner.may_be_refused});
        }
    }
    /// How many ways the samples so far leave: of each, whether it is empty, refused, drawn in or taken.
    [[nodiscard]] double ways() const { return ways_; }
    [[nodiscard]] Interval mean() const { return mean_of_some(terms_); }

  private:
    struct Range {
        Interval high, low;
    };
    struct Judged {
        Interval value; ///< where it counts
        bool may_count = false, may_be_refused = false;
    };

    Judged judge(const NarrowSample& sample, Range& range) {
        const Interval& z = sample.z;
        if (z.any || range.high.any || range.low.any) {
            ways_ = HUGE_VAL;
            range = {Interval::anything(), Interval::anything()};
            return {Interval::anything(), true, true};
        }
        const bool full = sample.may_be_full, near = full && z.high > range.high.low,
                   inside = full && z.low <= range.high.high && z.high >= range.low.low,
                   too_far = full && z.low < range.low.high, far = sample.may_be_empty || too_far;
        ways_ *= int{sample.may_be_empty} + int{near} + int{too_far} + int{inside};
        Judged found{drawn_in_, inside || far, near};
        if (inside) {
            const Interval taken(std::max(z.low, range.low.low), std::min(z.high, range.high.high));
            found.value = far ? interval::hull(taken, drawn_in_) : taken;
            widen(range, taken, !near && !far);
        }
        return found;
    }
    void widen(Range& range, const Interval& by, bool surely) const {
        const Interval high = widened(by, delta_), low = widened(by, -delta_);
        if (high.any || low.any) {
            range = {Interval::anything(), Interval::anything()};
            return;
        }
        range.high.high = std::max(range.high.high, high.high);
        range.low.low = std::min(range.low.low, low.low);
        if (surely) {
            range.high.low = std::max(range.high.low, high.low);
            range.low.high = std::min(range.low.high, low.high);
        }
    }
    static Interval widened(const Interval& z, float by) { return rounded(interval::add(z, Interval(by))); }
    /// To a float nearby: additions may be cut.
    static Interval rounded(const Interval& sum) { return interval::widen(sum, 1.0); }

    float delta_;
    Interval drawn_in_;
    PairRanges<Range> ranges_;
    std::vector<WeightedTerm> terms_;
    double ways_ = 1.0;
};

} // namespace lockstep::fluid
