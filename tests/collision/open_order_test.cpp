#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "reference/arithmetic.hpp"
#include "reference/legal_arithmetic.hpp"
#include "reference/readings/any_order.hpp"
#include "reference/readings/append.hpp"
#include "tests/collision/collision_scenes.hpp"

namespace lockstep::test::open_order_test {

namespace {

std::vector<float> terms(Random& random, std::size_t count) {
    std::vector<float> some(count);
    for (float& x : some)
        x = std::ldexp(random.between(-1.0F, 1.0F), static_cast<int>(random.below(20)) - 10);
    return some;
}

float added_up(const std::vector<float>& some) { return std::accumulate(some.begin(), some.end(), 0.0F); }

Interval legal_sum(const std::vector<float>& some) {
    const std::vector<Interval> sets(some.begin(), some.end());
    return any_order_sum(LegalArithmetic(Strict(), KnownOperations{.subnormals = true}), sets);
}

} // namespace

TEST_CASE("sums in any order: up to ten terms, the ends of all orders and nothing beyond") {
    Random random(3);
    int differ = 0;
    for (int i = 0; i < 200; ++i) {
        std::vector<float> some = terms(random, 1 + static_cast<std::size_t>(i) % 6);
        const Interval legal = legal_sum(some);
        std::sort(some.begin(), some.end());
        float least = added_up(some), most = least;
        do {
            least = std::min(least, added_up(some));
            most = std::max(most, added_up(some));
        } while (std::next_permutation(some.begin(), some.end()));
        CHECK(legal.low == double{least});
        CHECK(legal.high == double{most});
        differ += least != most;
    }
    CHECK(differ > 50);
}

TEST_CASE("sums in any order: beyond, every order lies inside a bound that is not far") {
    Random random(5);
    for (int i = 0; i < 100; ++i) {
        std::vector<float> some = terms(random, 11 + random.below(500));
        const Interval legal = legal_sum(some);
        REQUIRE_FALSE(legal.any);
        double magnitude = 0.0;
        for (const float x : some)
            magnitude += std::abs(x);
        CHECK(legal.high - legal.low < magnitude * static_cast<double>(some.size()) * 0x1.8p-23);
        for (int order = 0; order < 20; ++order) {
            for (std::size_t k = some.size(); k > 1; --k)
                std::swap(some[k - 1], some[random.below(static_cast<std::uint32_t>(k))]);
            CHECK(legal.contains(added_up(some)));
        }
        CHECK_FALSE(legal.contains(added_up(some) + static_cast<float>(magnitude) * 0.01F));
    }
}

TEST_CASE("appended in any order: every permutation is legal; lost, doubled and made-up items are not") {
    // Invocation i appends i if it is even, and may if it is a multiple of 3.
    const auto found = [](const std::vector<int>& items) {
        Appended appended{.invocations = 10, .must = {}, .may = {}};
        for (std::uint32_t i = 0; i < 10; i += 2)
            appended.must.push_back(i);
        for (const int item : items)
            appended.may.push_back(item % 2 == 0 || item % 3 == 0
                                       ? std::vector<std::uint32_t>{static_cast<std::uint32_t>(item)}
                                       : std::vector<std::uint32_t>{});
        return wrong_append(appended);
    };
    CHECK_FALSE(found({8, 2, 0, 6, 4}));
    CHECK_FALSE(found({3, 8, 2, 9, 0, 6, 4}));
    REQUIRE(found({8, 2, 0, 6}));
    CHECK(found({8, 2, 0, 6})->missing == 4U);
    REQUIRE(found({8, 2, 0, 6, 4, 2}));
    CHECK(found({8, 2, 0, 6, 4, 2})->item == 5U);
    CHECK(found({8, 2, 0, 5, 6, 4})->item == 3U);
}

TEST_CASE("appended in any order: items that several may have made are given round until each has one") {
    // Items 0 and 1 can both be of invocation 0 or 1, item 2 of 1 or 2: a greedy choice would run out.
    Appended appended{.invocations = 3, .must = {0, 1, 2}, .may = {{1, 0}, {1, 0}, {1, 2}}};
    CHECK_FALSE(wrong_append(appended));
    appended.may[2] = {1};
    REQUIRE(wrong_append(appended));
    CHECK(wrong_append(appended)->item == 2U);
}

TEST_CASE("sums in any order: of multiples of one power of two that cannot be rounded there is one, however many") {
    Random random(9);
    std::vector<float> some;
    for (int i = 0; i < 4000; ++i)
        some.push_back(std::ldexp(static_cast<float>(static_cast<int>(random.below(2001)) - 1000), -10));
    const Interval legal = legal_sum(some);
    CHECK(legal.is_point());
    CHECK(legal.low == std::accumulate(some.begin(), some.end(), 0.0));
    some.back() = 0x1p14F; // and one unit in the last place of the sums above it is more than theirs
    CHECK_FALSE(legal_sum(some).is_point());
    CHECK(exact_sum(std::vector<Interval>(20, 1.0F)) == 20.0F);
    CHECK_FALSE(exact_sum(std::vector<Interval>{1.0F, 0x1p-24F}));
    CHECK_FALSE(exact_sum(std::vector<Interval>{1.0F, Interval(0.5, 1.0)}));
}

} // namespace lockstep::test::open_order_test
