#include <catch2/catch.hpp>

#include <limits>
#include <type_traits>

#include <glm/mat4x4.hpp>

#include "reference/arithmetic.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep::test::arithmetic_test {

namespace {

// Squares 0x1.41840d2p+2, 0x1.7f6270c8p+1 and 0x1.05ac1d2p+0: each order of the sum rounds to a dot, a length and a
// direction of its own. Values from exact rational arithmetic, rounded to 24 bits after each operation.
const glm::vec3 v{9181.0F / 4096.0F, 7089.0F / 4096.0F, 4141.0F / 4096.0F};

template <class A> void check_sums(float dot, float length, glm::vec3 direction) {
    CHECK(A::dot(v, v) == dot);
    CHECK(A::length(v) == length);
    CHECK(A::normalize(v) == direction);
}

} // namespace

TEST_CASE("arithmetic: each policy sums in its own order") {
    check_sums<Strict>(0x1.2154a0p+3F, 0x1.80e2d2p+1F, {0x1.7da93ap-1F, 0x1.26b1eep-1F, 0x1.5849f8p-2F});
    check_sums<RightToLeft>(0x1.2154a2p+3F, 0x1.80e2d4p+1F, {0x1.7da938p-1F, 0x1.26b1ecp-1F, 0x1.5849f6p-2F});
    check_sums<FusedChain>(0x1.2154a4p+3F, 0x1.80e2d6p+1F, {0x1.7da936p-1F, 0x1.26b1eap-1F, 0x1.5849f4p-2F});
}

TEST_CASE("arithmetic: only the fused chain keeps what a product rounds away") {
    // y: (1 + 2^-12)^2 = 1 + 2^-11 + 2^-24; rounded to float, the last term is lost.
    const glm::vec3 a{1.0F, 1.0F + 0x1p-12F, 0.0F};
    const glm::vec3 b{-1.0F - 0x1p-11F, 1.0F + 0x1p-12F, 0.0F};
    CHECK(Strict::dot(a, b) == 0.0F);
    CHECK(RightToLeft::dot(a, b) == 0.0F);
    CHECK(FusedChain::dot(a, b) == 0x1p-24F);
}

TEST_CASE("arithmetic: a direction is the vector times the rounded reciprocal of its length") {
    // 1/5 rounds to 13421773 * 2^-26; times 3 it rounds to 10066330 * 2^-24, times 4 it is exact.
    CHECK(Strict::normalize({3.0F, 0.0F, -4.0F}) == glm::vec3(10066330.0F * 0x1p-24F, 0.0F, -13421773.0F * 0x1p-24F));
}

TEST_CASE("arithmetic: a vector without length has no direction") {
    const glm::vec3 none = Strict::normalize(glm::vec3(0.0F));
    CHECK(none.x != none.x);
    CHECK(none.y != none.y);
    CHECK(none.z != none.z);
    CHECK(Strict::length(glm::vec3(0.0F)) == 0.0F);
}

TEST_CASE("arithmetic: a matrix product sums its columns from left to right") {
    // Row 0: ((2^24 + 1) - 2^24) + 1, of which 2^24 + 1 ties to 2^24. Any other order gives 0 or 2.
    glm::mat4 m(0.0F);
    m[0][0] = 0x1p24F;
    m[1][0] = 1.0F;
    m[2][0] = -0x1p24F;
    m[3][0] = 1.0F;
    // Row 1: 2 * x + 3 * y + 4 * z + 5, row 3: the constant alone.
    m[0][1] = 2.0F;
    m[1][1] = 3.0F;
    m[2][1] = 4.0F;
    m[3][1] = 5.0F;
    m[3][3] = 7.0F;
    CHECK(Strict::transform(m, glm::vec3(1.0F)) == glm::vec4(1.0F, 14.0F, 0.0F, 7.0F));
    CHECK(Strict::transform(m, {0.0F, 10.0F, 100.0F}).y == 435.0F);
}

TEST_CASE("arithmetic: a profile names its policy") {
    const auto name = [](DotOrder order) {
        Profile profile;
        profile.dot = order;
        return with_arithmetic(profile, ArithmeticSwitch::plain, []<class A>(A) {
            return std::is_same_v<A, Strict> ? 0 : std::is_same_v<A, RightToLeft> ? 1 : 2;
        });
    };
    CHECK(name(DotOrder::left_to_right) == 0);
    CHECK(name(DotOrder::right_to_left) == 1);
    CHECK(name(DotOrder::fused_chain) == 2);
}

TEST_CASE("arithmetic: a driver's tables belong to the value, not to the program") {
    const auto of_one = [](float reciprocal) {
        Profile profile;
        profile.roots = std::make_shared<const RootTables>(RootTables{{reciprocal}, {1.0F}});
        return profile;
    };
    const Profile a = of_one(1.0F), b = of_one(0.75F);
    const auto reciprocal = [](auto fp) { return fp.divide(1.0F, 1.0F); };
    CHECK(with_arithmetic(a, ArithmeticSwitch::plain, [&](auto fp) {
              return with_arithmetic(b, ArithmeticSwitch::plain, reciprocal) + reciprocal(fp);
          }) == 1.75F);
}

} // namespace lockstep::test::arithmetic_test
