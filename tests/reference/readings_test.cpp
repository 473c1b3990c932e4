#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include "reference/arithmetic.hpp"
#include "reference/portable.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::test::readings_test {

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

namespace {

constexpr Site rows{"rows"}, columns{"columns"}, refuses{"refuses"}, least_of{"least of"}, offered{"offered"};

/// The turns of two loops, 1 to 3, that come by a condition, which is that both are 2, and go on where it holds.
std::vector<int> gone_through(Change change) {
    const std::array made{mistake_at(refuses, change)};
    Mistaken<Strict> r(Strict{}, made);
    std::vector<int> all;
    for (const int row : r.range(rows, 1, 3))
        for (const int column : r.range(columns, 1, 3)) {
            if (r.decide(refuses, row == 2 && column == 2))
                continue;
            all.push_back(10 * row + column);
        }
    return all;
}

/// A payload of one vector, its x the key.
struct Found {
    Mistaken<Strict>::Vec3 at;
    auto fields() { return std::tie(at); }
    auto fields() const { return std::tie(at); }
};
float chosen(Change change, const std::vector<float>& keys) {
    const std::array made{mistake_at(least_of, change)};
    Mistaken<Strict> r(Strict{}, made);
    auto nearest = least<Found>(r, least_of, 100.0F);
    for (const float key : keys)
        nearest.offer(offered, true, key, {{key, 0.0F, 0.0F}});
    return static_cast<float>(nearest.take()->at.x);
}

} // namespace

TEST_CASE("readings: a condition may end one loop or all that it stands in, and none after them") {
    using Turns = std::vector<int>;
    CHECK(gone_through(Change::none) == Turns{11, 12, 13, 21, 23, 31, 32, 33});
    CHECK(gone_through(Change::loop_left_if_so) == Turns{11, 12, 13, 21, 31, 32, 33});
    CHECK(gone_through(Change::loops_left_if_so) == Turns{11, 12, 13, 21});
    CHECK(gone_through(Change::loop_left_if_not) == Turns{11, 21, 31});
    CHECK(gone_through(Change::loops_left_if_not) == Turns{11});
}

TEST_CASE("readings: a mistaken choice takes what its change says") {
    const std::vector<float> keys{5.0F, 4.0F, 6.0F, 3.0F, 4.5F};
    CHECK(chosen(Change::none, keys) == 3.0F);
    CHECK(chosen(Change::last_taken, keys) == 4.5F);
    CHECK(chosen(Change::first_taken, keys) == 5.0F);
    CHECK(chosen(Change::greatest_taken, keys) == 6.0F);
    CHECK(chosen(Change::compared_with_first, keys) == 4.5F);
    CHECK(chosen(Change::compared_with_last, {5.0F, 4.0F, 6.0F, 5.5F, 7.0F}) == 5.5F);
    CHECK(chosen(Change::second_least, keys) == 4.0F);
    CHECK(chosen(Change::second_least, {3.0F, 5.0F, 4.0F}) == 4.0F);
    CHECK(chosen(Change::second_least, {3.0F}) == 3.0F);
    CHECK(chosen(Change::added_up, keys) == 22.5F);
    CHECK(chosen(Change::units_added_up, keys) == 5.0F);
    CHECK(chosen(Change::improving_added_up, keys) == 12.0F);
    CHECK(chosen(Change::improving_units_added_up, keys) == 3.0F);
}

TEST_CASE("readings: an offer that is refused or accepted may end its loop") {
    const auto nearest = [](Change change) {
        const std::array made{mistake_at(offered, change)};
        Mistaken<Strict> r(Strict{}, made);
        const std::array keys{5.0F, 4.0F, 1.0F, 3.0F, 6.0F, 2.0F};
        auto all = least<Found>(r, least_of, 100.0F);
        for (const int row : r.range(rows, 0, 1))
            for (const int column : r.range(columns, 0, 2)) {
                const Mistaken<Strict>::Real key(keys[static_cast<std::size_t>(3 * row + column)]);
                all.offer(offered, key < 4.5F && (false || key != 0.0F), key, {{key, 0.0F, 0.0F}});
            }
        return all.take() ? static_cast<float>(all.take()->at.x) : 0.0F;
    };
    CHECK(nearest(Change::none) == 1.0F);
    CHECK(nearest(Change::loop_left_if_not) == 3.0F);
    CHECK(nearest(Change::loop_left_if_so) == 3.0F);
    CHECK(nearest(Change::loops_left_if_so) == 4.0F);
    CHECK(nearest(Change::loops_left_if_not) == 0.0F);
}

TEST_CASE("readings: what is in a loop can leave it") {
    Mistaken<Strict> r(Strict{}, {});
    r.look_at_sites();
    (void)r.decide(test, true);
    for (const int row : r.range(rows, 1, 1))
        (void)r.decide(refuses, row == 2);
    const std::vector<Mistake> found = mistakes_at(r.sites());
    const auto has = [&](const Site& site, Change change) {
        return std::find(found.begin(), found.end(), mistake_at(site, change)) != found.end();
    };
    CHECK(has(refuses, Change::loop_left_if_so));
    CHECK_FALSE(has(refuses, Change::loops_left_if_so));
    CHECK_FALSE(has(test, Change::loop_left_if_so));
}

} // namespace lockstep::test::readings_test
