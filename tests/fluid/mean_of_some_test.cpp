#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <catch2/catch.hpp>

#include "reference/model/random.hpp"
#include "reference/readings/mean_of_some.hpp"

namespace lockstep::test::mean_of_some_test {

namespace {

struct Ends {
    double low = 1e9, high = -1e9;
};

/// Every choice of what is left out, at the ends of each value's and weight's set, added up in floats.
Ends by_every_choice(const std::vector<WeightedTerm>& terms) {
    Ends ends;
    const std::size_t n = terms.size();
    for (std::uint32_t out = 0; out < 1U << n; ++out)
        for (std::uint32_t heavy = 0; heavy < 1U << n; ++heavy)
            for (const bool high : {false, true}) {
                float weighted = 0.0F, weights = 0.0F;
                for (std::size_t i = 0; i < n; ++i) {
                    const WeightedTerm& term = terms[i];
                    if (term.open && (out >> i & 1U) != 0)
                        continue;
                    const auto weight = static_cast<float>((heavy >> i & 1U) != 0 ? term.weight.high : term.weight.low);
                    weighted += static_cast<float>(high ? term.value.high : term.value.low) * weight;
                    weights += weight;
                }
                const double mean = double{weighted / weights};
                ends.low = std::min(ends.low, mean);
                ends.high = std::max(ends.high, mean);
            }
    return ends;
}

} // namespace

TEST_CASE("mean of some: holds what every choice gives, and hardly more") {
    Random random(5, 0);
    for (int turn = 0; turn < 50; ++turn) {
        std::vector<WeightedTerm> terms;
        for (int i = 0; i < 6; ++i) {
            const auto value = static_cast<float>(0.9 + 0.1 * random.unit()),
                       weight = static_cast<float>(random.unit());
            terms.push_back({{double{value}, double{value + 0.001F}}, {double{weight}, double{weight * 1.01F}}, i > 1});
        }
        const Ends ends = by_every_choice(terms);
        const Interval set = mean_of_some(terms);
        CHECK(set.low <= ends.low);
        CHECK(set.high >= ends.high);
        CHECK(ends.low - set.low < 1e-5);
        CHECK(set.high - ends.high < 1e-5);
    }
}

TEST_CASE("mean of some: anything, where nothing must be there or a term is no number") {
    CHECK(mean_of_some({}).any);
    CHECK(mean_of_some(std::vector<WeightedTerm>{{Interval(1.0F), Interval(1.0F), true}}).any);
    CHECK(mean_of_some(std::vector<WeightedTerm>{{Interval::anything(), Interval(1.0F), false}}).any);
    CHECK_FALSE(mean_of_some(std::vector<WeightedTerm>{{Interval(1.0F), Interval(1.0F), false}}).any);
}

} // namespace lockstep::test::mean_of_some_test
