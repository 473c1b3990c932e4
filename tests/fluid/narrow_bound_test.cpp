#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <catch2/catch.hpp>

#include "reference/fluid/narrow_bound.hpp"
#include "reference/model/random.hpp"

namespace lockstep::test::narrow_bound_test {

namespace {

constexpr float delta = 0.5F, mu = 0.05F, z = -4.0F;

struct Pair {
    std::array<fluid::NarrowSample, 2> samples;
    float weight;
};

/// Of one sample: none where it is empty.
using Chosen = std::optional<float>;

Chosen choice(const fluid::NarrowSample& sample, Random& random) {
    if (sample.may_be_empty && (!sample.may_be_full || random.unit() < 0.5))
        return {};
    const double where = std::floor(3.0 * random.unit()) * 0.5;
    return static_cast<float>(sample.z.low + where * (sample.z.high - sample.z.low));
}

/// The filter in plain floats, as the paper has it.
float narrow_mean(const std::vector<std::array<Chosen, 2>>& chosen, const std::vector<Pair>& pairs, bool two_ranges) {
    struct Range {
        float high = z + delta, low = z - delta;
    };
    std::array<Range, 2> ranges;
    float weighted = z, weights = 1.0F;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        std::array<float, 2> value{};
        bool counts = true;
        for (std::size_t k = 0; k < 2; ++k) {
            Range& range = ranges[two_ranges ? k : 0];
            const Chosen& one = chosen[i][k];
            if (one && *one > range.high) {
                counts = false;
            } else if (!one || *one < range.low) {
                value[k] = z - mu;
            } else {
                value[k] = *one;
                range.high = std::max(range.high, *one + delta);
                range.low = std::min(range.low, *one - delta);
            }
        }
        if (!counts)
            continue;
        weighted += value[0] * pairs[i].weight + value[1] * pairs[i].weight;
        weights += pairs[i].weight + pairs[i].weight;
    }
    return weighted / weights;
}

/// Sets as wide as `width`, around depths that lie on all sides of the range.
std::vector<Pair> random_pairs(Random& random, double width, bool some_open) {
    std::vector<Pair> pairs;
    for (int i = 0; i < 8; ++i) {
        Pair pair{{}, static_cast<float>(0.1 + random.unit())};
        for (fluid::NarrowSample& sample : pair.samples) {
            const auto middle = static_cast<float>(-4.0 + 2.5 * (random.unit() - 0.5));
            sample.z = {double{middle} - width, double{middle} + width};
            sample.may_be_empty = some_open && random.unit() < 0.3;
            sample.may_be_full = !sample.may_be_empty || random.unit() < 0.7;
        }
        pairs.push_back(pair);
    }
    return pairs;
}

fluid::NarrowBound bound_of(const std::vector<Pair>& pairs, bool two_ranges) {
    fluid::NarrowBound bound(Interval(z), delta, mu, two_ranges);
    for (const Pair& pair : pairs)
        bound.take(pair.samples, Interval(pair.weight));
    return bound;
}

} // namespace

TEST_CASE("narrow bound: holds what every choice of samples gives") {
    Random random(7, 0);
    for (int turn = 0; turn < 300; ++turn)
        for (const bool two_ranges : {false, true}) {
            const std::vector<Pair> pairs = random_pairs(random, 0.02 + 0.3 * random.unit(), true);
            const Interval set = bound_of(pairs, two_ranges).mean();
            REQUIRE_FALSE(set.any);
            for (int sample = 0; sample < 200; ++sample) {
                std::vector<std::array<Chosen, 2>> chosen;
                for (const Pair& pair : pairs)
                    chosen.push_back({choice(pair.samples[0], random), choice(pair.samples[1], random)});
                const float mean = narrow_mean(chosen, pairs, two_ranges);
                INFO(turn << ", " << mean << " of " << set.low << " to " << set.high);
                REQUIRE(set.contains(mean));
            }
        }
}

TEST_CASE("narrow bound: hardly more than the mean, where each sample is one thing") {
    Random random(8, 0);
    for (int turn = 0; turn < 300; ++turn) {
        const std::vector<Pair> pairs = random_pairs(random, 0.0, false);
        const fluid::NarrowBound bound = bound_of(pairs, false);
        std::vector<std::array<Chosen, 2>> chosen;
        for (const Pair& pair : pairs)
            chosen.push_back({choice(pair.samples[0], random), choice(pair.samples[1], random)});
        CHECK(bound.ways() == 1.0);
        CHECK(std::abs(bound.mean().low - double{narrow_mean(chosen, pairs, false)}) < 1e-4);
        CHECK(std::abs(bound.mean().high - double{narrow_mean(chosen, pairs, false)}) < 1e-4);
    }
}

TEST_CASE("narrow bound: an empty sample that may be full as well does not open what follows") {
    // Where the depth is metres, nothing is stored as 0, nearer than all: what a filtered texel beside it may be.
    const fluid::NarrowSample either{{-4.0, 0.0}, true, true}, plain{Interval(-4.1F), false, true},
        too_near{Interval(-2.0F), false, true};
    fluid::NarrowBound bound(Interval(z), delta, mu, false);
    bound.take(std::array{either, plain}, Interval(1.0F));
    const double ways = bound.ways();
    CHECK(ways == 3.0);
    bound.take(std::array{plain, plain}, Interval(1.0F));
    bound.take(std::array{too_near, plain}, Interval(1.0F));
    CHECK(bound.ways() == ways);
    CHECK_FALSE(bound.mean().contains(-2.0F));
}

TEST_CASE("narrow bound: anything, where a sample may be any number") {
    fluid::NarrowBound bound(Interval(z), delta, mu, false);
    bound.take(std::array{fluid::NarrowSample{Interval::anything(), false, true}, fluid::NarrowSample{Interval(z)}},
               Interval(1.0F));
    CHECK(bound.mean().any);
}

} // namespace lockstep::test::narrow_bound_test
