#include <catch2/catch.hpp>

#include <array>
#include <cstdint>
#include <vector>

#include "reference/arithmetic.hpp"
#include "reference/portable.hpp"
#include "reference/system/item_twin.hpp"

using namespace lockstep;

/// Of an int that is the twin's own, and of the reading's.
template <class R> void keeps_signs() {
    using Int = typename R::Int;
    CHECK(item_twin::set_of(R::real(-3)).as_float() == -3.0F);
    CHECK(item_twin::set_of(R::real(Int(-3))).as_float() == -3.0F);
    CHECK(item_twin::set_of(R::real(std::uint32_t{0x80000000U})).as_float() == 2147483648.0F);
}

TEST_CASE("readings: a whole number below 0 becomes a float below 0 in each of them") {
    keeps_signs<Values<Strict>>();
    keeps_signs<Values<Portable>>();
    keeps_signs<Recording<Portable>>();
    keeps_signs<Mistaken<Strict>>();
    keeps_signs<Mistaken<Portable>>();
    keeps_signs<Mistaken<FusedProducts<Strict>>>();
    keeps_signs<Following<Strict>>();
    keeps_signs<Worlds<Strict>>();
}

namespace {

constexpr Site turns{"turns"}, test{"test"};

std::vector<int> taken(Change change, int first, int last) {
    const std::array made{mistake_at(turns, change)};
    Mistaken<Strict> r(Strict{}, made);
    std::vector<int> all;
    for (const auto i : r.range(turns, first, last))
        all.push_back(i);
    return all;
}

/// Of a < b, a <= b and a == b.
std::array<bool, 3> answers(Change change, float a, float b) {
    const std::array made{mistake_at(test, change, 0)};
    Mistaken<Strict> r(Strict{}, made);
    using Real = Mistaken<Strict>::Real;
    const Real left(a), right(b);
    return {r.decide(test, left < right), r.decide(test, left <= right), r.decide(test, left == right)};
}

} // namespace

TEST_CASE("readings: a mistaken loop takes the turns that its change says") {
    using Turns = std::vector<int>;
    CHECK(taken(Change::none, -2, 2) == Turns{-2, -1, 0, 1, 2});
    CHECK(taken(Change::first_skipped, -2, 2) == Turns{-1, 0, 1, 2});
    CHECK(taken(Change::last_skipped, -2, 2) == Turns{-2, -1, 0, 1});
    CHECK(taken(Change::first_alone, -2, 2) == Turns{-2});
    CHECK(taken(Change::last_alone, -2, 2) == Turns{2});
    CHECK(taken(Change::first_half, -2, 2) == Turns{-2, -1, 0});
    CHECK(taken(Change::last_half, -2, 2) == Turns{0, 1, 2});
    CHECK(taken(Change::every_second, -2, 2) == Turns{-2, 0, 2});
    CHECK(taken(Change::every_second, 0, 3) == Turns{0, 2});
    CHECK(taken(Change::backwards, -2, 2) == Turns{2, 1, 0, -1, -2});
}

TEST_CASE("readings: a mistaken loop without turns has none") {
    for (const Change change : {Change::none, Change::first_skipped, Change::last_skipped, Change::first_alone,
                                Change::last_alone, Change::first_half, Change::last_half, Change::every_second})
        for (const int last : {-1, -2, -3}) {
            INFO(change_name(change) << ", 0 to " << last);
            CHECK(taken(change, 0, last).empty());
        }
}

TEST_CASE("readings: a mistaken comparison answers as its change says") {
    using Answers = std::array<bool, 3>;
    CHECK(answers(Change::none, 1.0F, 1.0F) == Answers{false, true, true});
    CHECK(answers(Change::or_equal, 1.0F, 1.0F) == Answers{true, false, true});
    CHECK(answers(Change::reversed, 1.0F, 2.0F) == Answers{false, false, true});
    CHECK(answers(Change::differs, 2.0F, 1.0F) == Answers{true, true, false});
    CHECK(answers(Change::differs, 1.0F, 1.0F) == Answers{false, false, true});
    CHECK(answers(Change::at_most, 1.0F, 2.0F) == Answers{true, true, true});
    CHECK(answers(Change::at_least, 1.0F, 2.0F) == Answers{true, true, false});
    CHECK(answers(Change::left_zero, 3.0F, 2.0F) == Answers{true, true, false});
    CHECK(answers(Change::right_zero, 1.0F, 2.0F) == Answers{false, false, false});
    CHECK(answers(Change::right_doubled, 3.0F, 2.0F) == Answers{true, true, false});
    CHECK(answers(Change::right_halved, 1.0F, 2.0F) == Answers{false, true, true});
}
