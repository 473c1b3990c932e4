#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <ios>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "reference/fluid/point_coord.hpp"

namespace lockstep::test::point_coord_test {

/// What a driver makes of points, held to gl_PointCoord as measured (data/results/h200/points.txt: the size and the
/// middle of a point, a pixel's centre, the coordinate there).
using namespace lockstep::fluid;

namespace {

struct Measured {
    float size = 0.0F, middle[2] = {}, pixel[2] = {}, coord[2] = {};
};

std::vector<Measured> measured() {
    std::vector<Measured> all;
    std::ifstream file("data/results/h200/points.txt");
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        words >> std::hex;
        Measured one;
        for (float* number :
             {&one.size, &one.middle[0], &one.middle[1], &one.pixel[0], &one.pixel[1], &one.coord[0], &one.coord[1]}) {
            std::uint32_t bits = 0;
            words >> bits;
            *number = std::bit_cast<float>(bits);
        }
        REQUIRE(words);
        all.push_back(one);
    }
    REQUIRE(all.size() == 408);
    return all;
}

/// How many of them, of two coordinates each, lie in what `law` takes for legal of points so much larger or aside.
int legal(PointCoord law, float larger = 0.0F, float aside = 0.0F) {
    int count = 0;
    for (const Measured& one : measured())
        for (int axis = 0; axis < 2; ++axis) {
            const Interval half(0.5F * (one.size + larger));
            const Interval set =
                point_place(law, {Interval(one.pixel[axis]), Interval(one.middle[axis] + aside), half});
            const float place = 2.0F * one.coord[axis] - 1.0F;
            count += set.contains(axis == 0 ? place : -place) ? 1 : 0; // counted from above
        }
    return count;
}

} // namespace

TEST_CASE("point coord: an H200's come of a middle on 256ths and a size cut to 32nds") {
    CHECK(legal(PointCoord::cut) == 816);
    CHECK(legal(PointCoord::cut, 1.0F / 32.0F) < 200);
    CHECK(legal(PointCoord::cut, 0.0F, 1.0F / 256.0F) < 100);
}

TEST_CASE(
    "point coord: where no driver is followed, a size in steps of an eighth is legal, and a quarter more is not") {
    CHECK(legal(PointCoord::open) == 816);
    CHECK(legal(PointCoord::open, 0.25F) < 700);
    CHECK(legal(PointCoord::open, 0.0F, 0.125F) < 200);
    CHECK(legal(PointCoord::accurate) < 816);
}

} // namespace lockstep::test::point_coord_test
