#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "reference/collision/collision_code.hpp"

namespace lockstep::test::collision_code_test {

namespace {

CollisionCode half_code() {
    FrameParams params;
    params.switches.cdt_format = CdtFormat::rgba16f;
    return CollisionCode(params);
}

float half(float x) { return half_code().encode({x, 0.0F, 0.0F}).x; }

/// Code c stands for low + c * step, step = 1/128 in x, 1/16 in y, 1 in z.
FrameParams byte_params() {
    FrameParams params;
    params.switches.cdt_format = CdtFormat::rgba8;
    params.cdt_box = {{-1.0F, -8.0F, 0.0F}, {-1.0F + 255.0F / 128.0F, -8.0F + 255.0F / 16.0F, 255.0F}};
    return params;
}

/// The value of a half's 16 bits: IEEE 754, binary16.
double half_value(unsigned bits) {
    const int exponent = static_cast<int>(bits >> 10U & 31U);
    const double fraction = (bits & 1023U) / 1024.0;
    if (exponent == 31)
        return fraction == 0.0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
    return exponent == 0 ? std::ldexp(fraction, -14) : std::ldexp(1.0 + fraction, exponent - 15);
}

} // namespace

TEST_CASE("collision code: rgba32f stores the position itself, valid") {
    const CollisionCode code{FrameParams{}};
    const glm::vec3 p{0.1F, -1e-30F, 1e30F};
    CHECK(code.encode(p) == glm::vec4(p, 1.0F));
    CHECK(code.decode(code.encode(p)) == p);
}

TEST_CASE("collision code: halves worked out by hand") {
    CHECK(half(0.1F) == 1638.0F / 16384.0F);  // 0.1 = 1638.4 * 2^-14
    CHECK(half(-0.3F) == -1229.0F / 4096.0F); // 0.3 = 1228.8 * 2^-12
    CHECK(half(2049.0F) == 2048.0F);          // ties to even
    CHECK(half(2051.0F) == 2052.0F);
    CHECK(half_code().encode({1.0F, 2.0F, 3.0F}) == glm::vec4(1.0F, 2.0F, 3.0F, 1.0F));
}

TEST_CASE("collision code: every half keeps itself, and every midpoint goes to the even of its neighbours") {
    std::uint32_t wrong = 0;
    for (unsigned bits = 0; bits < 0x10000U; ++bits) {
        const double sign = (bits & 0x8000U) != 0 ? -1.0 : 1.0;
        const unsigned magnitude = bits & 0x7fffU;
        const double value = half_value(magnitude);
        const auto x = static_cast<float>(sign * value);
        if (std::isnan(value))
            continue;
        if (magnitude < 0x0400U) { // subnormal halves
            wrong += half(x) != 0.0F || std::signbit(half(x));
            continue;
        }
        if (magnitude >= 0x7bffU) { // 65504, and infinity
            wrong += half(x) != static_cast<float>(sign * 65504.0);
            continue;
        }
        const auto next = static_cast<float>(sign * half_value(magnitude + 1));
        const auto middle = static_cast<float>(0.5 * (static_cast<double>(x) + next)); // exact
        wrong += half(x) != x;
        wrong += half(middle) != (magnitude % 2 == 0 ? x : next);
        wrong += half(std::nextafter(middle, x)) != x;
        wrong += half(std::nextafter(middle, next)) != next;
    }
    CHECK(wrong == 0);
}

TEST_CASE("collision code: halves end at 2^-14 below and at 65504 above") {
    const float smallest = 0x1p-14F;
    const float below = std::nextafter(smallest, 0.0F);
    CHECK(half(smallest) == smallest);
    CHECK(half(below) == 0.0F);
    CHECK_FALSE(std::signbit(half(-below)));
    CHECK(half(65519.0F) == 65504.0F);
    CHECK(half(65520.0F) == 65504.0F); // would round to infinity
    CHECK(half(-1e30F) == -65504.0F);
    CHECK(half(std::numeric_limits<float>::infinity()) == 65504.0F);
}

TEST_CASE("collision code: rgba8 stores the nearest of 256 codes across the box, valid") {
    const CollisionCode code(byte_params());
    // x: (0.1 + 1) * 128 = 140.8; y: (0 + 8) * 16; z: 0.5 lies between two codes and goes up.
    CHECK(code.encode({0.1F, 0.0F, 0.5F}) == glm::vec4(141.0F, 128.0F, 1.0F, 255.0F));
    CHECK(code.encode({0.0F, 0.0F, 0.49F}).z == 0.0F);
    CHECK(code.encode({0.0F, 0.0F, 253.5F}).z == 254.0F);
    CHECK(code.decode({141.0F, 128.0F, 1.0F, 255.0F}) == glm::vec3(13.0F / 128.0F, 0.0F, 1.0F));
}

TEST_CASE("collision code: rgba8 clamps to the box") {
    const CollisionCode code(byte_params());
    CHECK(code.encode({-2.0F, 1e30F, -0.4F}) == glm::vec4(0.0F, 255.0F, 0.0F, 255.0F));
    const float infinity = std::numeric_limits<float>::infinity();
    CHECK(code.encode({infinity, -infinity, 256.0F}) == glm::vec4(255.0F, 0.0F, 255.0F, 255.0F));
}

TEST_CASE("collision code: every rgba8 code survives the way to a position and back") {
    FrameParams params = byte_params();
    params.cdt_box = {{-0.3F, -1.7F, 0.01F}, {0.7F, 5.1F, 0.02F}};
    for (const FrameParams& p : {byte_params(), params}) {
        const CollisionCode code(p);
        for (int i = 0; i < 256; ++i) {
            const auto c = static_cast<float>(i);
            CHECK(code.encode(code.decode({c, c, c, 255.0F})) == glm::vec4(c, c, c, 255.0F));
        }
    }
}

TEST_CASE("collision code: NaN is code 0 in rgba8, and stays NaN in the float formats") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(CollisionCode(byte_params()).encode(glm::vec3(nan)) == glm::vec4(0.0F, 0.0F, 0.0F, 255.0F));
    for (const float x : {half(nan), half(-nan), CollisionCode{FrameParams{}}.encode(glm::vec3(nan)).x})
        CHECK(x != x);
}

} // namespace lockstep::test::collision_code_test
