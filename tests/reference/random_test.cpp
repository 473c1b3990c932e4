#include <catch2/catch.hpp>

#include "reference/model/random.hpp"

namespace lockstep::test::random_test {

TEST_CASE("random: splitmix64 gives the published numbers of seed 1234567") {
    std::uint64_t state = 1234567;
    for (const std::uint64_t expected : {6457827717110365317U, 3203168211198807973U, 9817491932198370423U,
                                         4593380528125082431U, 16408922859458223821U}) {
        CHECK(splitmix64(state) == expected);
        state += 0x9e3779b97f4a7c15U;
    }
}

TEST_CASE("random: the numbers of a particle are fixed by seed and index") {
    Random random(1, 0);
    CHECK(random.next() == 0xb18a02f46d8d86c3U);
    CHECK(random.next() == 0xf8c5b62c83f707e8U);
    CHECK(Random(1, 1).next() == 0x5775264a9a7e1b09U);
    CHECK(Random(2, 0).next() == 0x1956ecd1a275ec95U);
    CHECK(Random(7, 3'999'999).unit() == 0xf8b8b1p-24);
}

TEST_CASE("random: units are multiples of 2^-24 in [0, 1), evenly spread") {
    double sum = 0.0;
    double squares = 0.0;
    constexpr int count = 100000;
    for (int i = 0; i < count; ++i) {
        const double u = Random(42, static_cast<std::uint64_t>(i)).unit();
        REQUIRE((u >= 0.0 && u < 1.0));
        REQUIRE(static_cast<double>(static_cast<float>(u)) == u);
        sum += u;
        squares += u * u;
    }
    CHECK(sum / count == Approx(0.5).margin(0.005));
    CHECK(squares / count == Approx(1.0 / 3.0).margin(0.005));
}

TEST_CASE("random: symmetric numbers lie in [-1, 1) on both sides of 0") {
    Random random(3, 5);
    int below = 0;
    for (int i = 0; i < 1000; ++i) {
        const double s = random.symmetric();
        REQUIRE((s >= -1.0 && s < 1.0));
        below += s < 0.0 ? 1 : 0;
    }
    CHECK(below > 400);
    CHECK(below < 600);
}

} // namespace lockstep::test::random_test
