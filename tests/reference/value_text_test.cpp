#include <catch2/catch.hpp>

#include <limits>

#include "crosscheck/report/row_text.hpp"
#include "crosscheck/report/value_text.hpp"
#include "reference/model/ulp.hpp"

namespace lockstep::test::value_text_test {

namespace {

std::string distance(float reference, float gpu) {
    return distance_text(Difference{{}, 0, 0, reference, gpu, ulp_distance(reference, gpu)});
}

} // namespace

TEST_CASE("value text: floats of the same sign, or close to 0, are ULP apart; others have another sign") {
    CHECK(distance(1.0F, 1.0000001F) == "1 ULP");
    CHECK(distance(1.0F, 3.0e8F).ends_with(" ULP"));
    CHECK(distance(-1e-45F, 1e-45F) == "2 ULP");
    CHECK(distance(0.0F, -0.0F) == "sign of zero");
    CHECK(distance(-0.48F, 0.97F) == "other sign");
    CHECK(distance(0.0F, 0.97F).ends_with(" ULP"));
    CHECK(distance(1.0F, std::numeric_limits<float>::quiet_NaN()) == "NaN on one side");
}

TEST_CASE("value text: decimals of nine digits, or the bits, never both") {
    CHECK(value_text(0.1F, NumberFormat::decimal) == "0.100000001");
    CHECK(value_text(0.1F, NumberFormat::hexadecimal) == "0x1.99999ap-4");
}

} // namespace lockstep::test::value_text_test
