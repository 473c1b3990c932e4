#include "reference/portable.hpp"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "reference/arithmetic.hpp"
#include "reference/subnormals.hpp"

namespace lockstep::test::portable_test {

using lockstep::Portable;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();
constexpr float smallest = std::numeric_limits<float>::min();
constexpr float largest = std::numeric_limits<float>::max();

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }
float from_bits(std::uint32_t x) { return std::bit_cast<float>(x); }

std::uint32_t draw(std::mt19937& random) { return static_cast<std::uint32_t>(random()); }

/// The rule for tiny values, from bits: an oracle for Portable's comparison.
float without_tiny(float x) { return (bits(x) & 0x7fffffffU) <= 0x00800000U ? 0.0F : x; }

/// Units in the last place of `value` that `result` is off.
double ulps(float result, double value) {
    const double unit = std::ldexp(1.0, std::max(std::ilogb(value), -126) - 23);
    return std::abs(static_cast<double>(result) - value) / unit;
}

/// Every significand in [1, 4): both parities of the exponent.
template <class Visit> void each_significand(Visit visit) {
    for (std::uint32_t x = bits(1.0F); x < bits(4.0F); ++x)
        visit(from_bits(x));
}

/// A double result rounded to float is the correctly rounded one for / and sqrt of floats: 53 >= 2 * 24 + 2.
float rounded_quotient(float a, float b) {
    return without_tiny(static_cast<float>(static_cast<double>(a) / static_cast<double>(b)));
}
float rounded_root(float a) { return without_tiny(static_cast<float>(std::sqrt(static_cast<double>(a)))); }

/// a / b a hair from halfway between two floats: a 2^k = q b + (b +- 1) / 2 for an odd significand b.
std::pair<float, float> near_halfway(std::mt19937& random) {
    const std::uint64_t b = (draw(random) & 0x7fffffU) | 0x800001U;
    for (const int k : {23, 24}) {
        std::uint64_t half = (b + (draw(random) % 2 != 0U ? 1U : b - 1U)) / 2 % b; // (b +- 1) / 2
        for (int i = 0; i < k; ++i)                                                // divided by 2^k, modulo b
            half = half % 2 == 0 ? half / 2 : (half + b) / 2;
        const std::uint64_t a = half < 0x800000U ? half + b : half;
        if (a >= 0x800000U && a < 0x1000000U && (a < b) == (k == 24))
            return {static_cast<float>(a), static_cast<float>(b)};
    }
    return {static_cast<float>(b), 3.0F};
}

/// Floats of every kind: any bits, special ones, near 1, near the smallest normal.
std::vector<float> samples(std::size_t count, unsigned seed) {
    const std::vector<float> special{
        0.0F,    smallest,  from_bits(1), from_bits(0x007fffff), from_bits(0x00800001), infinity,
        largest, nan_value, 1.0F,         from_bits(0x3f7fffff)};
    std::mt19937 random(seed);
    std::vector<float> values(count);
    for (float& value : values) {
        const std::uint32_t any = draw(random);
        switch (draw(random) % 4) {
        case 0:
            value = from_bits(any);
            break;
        case 1:
            value = std::copysign(special[any % special.size()], any % 2 != 0U ? -1.0F : 1.0F);
            break;
        case 2:
            value = from_bits((any & 0x807fffffU) | ((120U + draw(random) % 16U) << 23U));
            break;
        default:
            value = from_bits((any & 0x807fffffU) | ((draw(random) % 4U) << 23U));
        }
    }
    return values;
}

/// Everything Portable computes from three floats, as bits; any NaN is one.
std::vector<std::uint32_t> all_results(const std::vector<float>& values, bool flush) {
    const lockstep::FlushSubnormals guard(flush);
    std::vector<std::uint32_t> results;
    const auto add = [&](float x) { results.push_back(std::isnan(x) ? 0x7fc00000U : bits(x)); };
    for (std::size_t i = 0; i + 16 <= values.size(); i += 3) {
        const glm::vec3 v(values[i], values[i + 1], values[i + 2]);
        glm::mat4 m;
        for (int k = 0; k < 16; ++k)
            m[k / 4][k % 4] = values[i + k];
        for (const float x : {Portable::divide(v.x, v.y), Portable::reciprocal(v.x), Portable::sqrt(v.x),
                              Portable::inverse_sqrt(v.x), Portable::multiply(v.x, v.y), Portable::length(v),
                              Portable::add(Portable::flush(v.x), Portable::flush(v.y))})
            add(x);
        const glm::vec3 n = Portable::normalize(v);
        const glm::vec4 t = Portable::transform(m, v);
        for (const float x : {n.x, n.y, n.z, t.x, t.y, t.z, t.w})
            add(x);
    }
    return results;
}

} // namespace

TEST_CASE("portable: sqrt and reciprocal are correctly rounded for every significand", "[portable]") {
    int wrong_roots = 0;
    int wrong_reciprocals = 0;
    each_significand([&](float x) {
        wrong_roots += bits(Portable::sqrt(x)) != bits(rounded_root(x)) ? 1 : 0;
        wrong_reciprocals += bits(Portable::reciprocal(x)) != bits(rounded_quotient(1.0F, x)) ? 1 : 0;
    });
    CHECK(wrong_roots == 0);
    CHECK(wrong_reciprocals == 0);
}

TEST_CASE("portable: sqrt, reciprocal and division are correctly rounded for every exponent", "[portable]") {
    std::mt19937 random(1);
    int wrong = 0;
    for (std::uint32_t exponent = 0; exponent < 255; ++exponent) {
        for (int i = 0; i < 4096; ++i) {
            const float a = from_bits((exponent << 23U) | (draw(random) & 0x7fffffU));
            const float b = from_bits(draw(random) % bits(infinity));
            if (without_tiny(a) == 0.0F || without_tiny(b) == 0.0F)
                continue;
            wrong += bits(Portable::sqrt(a)) != bits(rounded_root(a)) ? 1 : 0;
            wrong += bits(Portable::reciprocal(a)) != bits(rounded_quotient(1.0F, a)) ? 1 : 0;
            wrong += bits(Portable::divide(a, b)) != bits(rounded_quotient(a, b)) ? 1 : 0;
            wrong += bits(Portable::divide(b, a)) != bits(rounded_quotient(b, a)) ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("portable: division is correctly rounded close to halfway", "[portable]") {
    std::mt19937 random(2);
    int wrong = 0;
    int hard = 0;
    for (int i = 0; i < 1 << 20; ++i) {
        const auto [a, b] = near_halfway(random);
        hard += b != 3.0F ? 1 : 0;
        wrong += bits(Portable::divide(a, b)) != bits(rounded_quotient(a, b)) ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(hard > 1 << 19);
}

TEST_CASE("portable: 2^30 divisions are correctly rounded", "[portable][.long]") {
    std::mt19937 random(3);
    int wrong = 0;
    for (int i = 0; i < 1 << 30; ++i) {
        const float a = from_bits((draw(random) & 0x7fffffU) | bits(1.0F));
        const float b = from_bits((draw(random) & 0x7fffffU) | bits(1.0F));
        wrong += bits(Portable::divide(a, b)) != bits(rounded_quotient(a, b)) ? 1 : 0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("portable: inverse_sqrt, length and normalize keep their bounds", "[portable]") {
    double worst = 0.0;
    each_significand([&](float x) {
        worst = std::max(worst, ulps(Portable::inverse_sqrt(x), 1.0 / std::sqrt(static_cast<double>(x))));
    });
    CHECK(worst < 1.5);

    std::mt19937 random(4);
    std::uniform_real_distribution<float> exponent(-40.0F, 60.0F);
    std::uniform_real_distribution<float> component(-1.0F, 1.0F);
    double worst_length = 0.0;
    double worst_component = 0.0;
    for (int i = 0; i < 1 << 20; ++i) {
        const float size = std::exp2(exponent(random));
        const glm::vec3 v(component(random) * size, component(random) * size, component(random) * size);
        const double length = std::hypot(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
        worst_length = std::max(worst_length, ulps(Portable::length(v), length));
        const glm::vec3 n = Portable::normalize(v);
        for (int k = 0; k < 3; ++k)
            worst_component = std::max(worst_component, ulps(n[k], static_cast<double>(v[k]) / length));
    }
    CHECK(worst_length < 2.0);
    CHECK(worst_component < 4.0);
}

TEST_CASE("portable: agrees with the strict arithmetic where nothing is tiny", "[portable]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> component(1e-3F, 10.0F);
    const auto vector = [&] { return glm::vec3(component(random), -component(random), component(random)); };
    for (int i = 0; i < 10000; ++i) {
        const glm::mat4 m(glm::vec4(vector(), 0.5F), glm::vec4(vector(), -2.0F), glm::vec4(vector(), 1.5F),
                          glm::vec4(vector(), 0.25F));
        const glm::vec3 v = vector();
        REQUIRE(Portable::transform(m, v) == lockstep::Strict::transform(m, v));
        REQUIRE(Portable::normalize(v) == lockstep::Strict::normalize(v));
        REQUIRE(Portable::length(v) == lockstep::Strict::length(v));
        REQUIRE(Portable::dot(v, m[0]) == lockstep::Strict::dot(v, m[0]));
        REQUIRE(Portable::scale(v, m[0].x) == lockstep::Strict::scale(v, m[0].x));
    }
}

TEST_CASE("portable: a magnitude of 2^-126 or less is +0, as operand and as result", "[portable]") {
    const float above = from_bits(0x00800001);
    for (const float tiny : {0.0F, from_bits(1), from_bits(0x007fffff), smallest}) {
        for (const float x : {tiny, -tiny}) {
            CHECK(bits(Portable::flush(x)) == 0);
            CHECK(bits(Portable::sqrt(x)) == 0);
            CHECK(bits(Portable::divide(x, 1e-30F)) == 0);
            CHECK(bits(Portable::multiply(x, 1e30F)) == 0);
            CHECK(Portable::divide(1.0F, x) == infinity);
            CHECK(Portable::divide(-1.0F, x) == -infinity);
            CHECK(std::isnan(Portable::divide(x, 0.0F)));
            CHECK(bits(Portable::length({x, x, x})) == 0);
            CHECK(Portable::transform(glm::mat4(x), {1e30F, 1e30F, 1e30F}) == glm::vec4(0.0F));
        }
    }
    CHECK(Portable::flush(above) == above);
    CHECK(Portable::flush(-above) == -above);
    CHECK(Portable::flush(glm::vec3(above, smallest, -1.0F)) == glm::vec3(above, 0.0F, -1.0F));
    CHECK(bits(Portable::add(above, -from_bits(0x00800002))) == 0);
    CHECK(bits(Portable::divide(smallest * 2, 2.0F)) == 0);
    // Rounds up to 2^-126, or is flushed before rounding.
    CHECK(bits(Portable::multiply(0x1p-63F, 0x1.fffffep-64F)) == 0);
    CHECK(bits(Portable::multiply(-0x1p-63F, 0x1.fffffep-64F)) == 0);
    CHECK(Portable::multiply(0x1p-63F, 0x1.000002p-63F) == above);
}

TEST_CASE("portable: infinities and NaN follow IEEE 754, NaN with one set of bits", "[portable]") {
    for (const float x :
         {Portable::divide(0.0F, 0.0F), Portable::divide(infinity, -infinity), Portable::divide(-nan_value, 1.0F),
          Portable::divide(1.0F, from_bits(0x7f800001)), Portable::sqrt(-1.0F), Portable::sqrt(-infinity),
          Portable::sqrt(-nan_value), Portable::reciprocal(nan_value), Portable::inverse_sqrt(-2.0F)})
        CHECK(bits(x) == 0x7fc00000U);
    CHECK(Portable::divide(-infinity, 2.0F) == -infinity);
    CHECK(bits(Portable::divide(-2.0F, infinity)) == 0);
    CHECK(Portable::divide(largest, 0.5F) == infinity);
    CHECK(Portable::divide(-largest, from_bits(0x3f7fffff)) == -infinity);
    CHECK(Portable::sqrt(infinity) == infinity);
    CHECK(Portable::inverse_sqrt(-0.0F) == infinity);
    CHECK(bits(Portable::inverse_sqrt(infinity)) == 0);
}

TEST_CASE("portable: a vector without a direction normalizes to NaN", "[portable]") {
    for (const glm::vec3 v : {glm::vec3(0.0F), glm::vec3(1e-30F, 0.0F, 0.0F), glm::vec3(1e30F, 1.0F, 0.0F),
                              glm::vec3(0.0F, infinity, 0.0F), glm::vec3(1.0F, nan_value, 0.0F)}) {
        const glm::vec3 n = Portable::normalize(v);
        for (int k = 0; k < 3; ++k)
            CHECK(bits(n[k]) == 0x7fc00000U);
    }
    CHECK(Portable::normalize({0.0F, -3.0F, -0.0F}) == glm::vec3(0.0F, -1.0F, 0.0F));
}

TEST_CASE("portable: the same bits whether the processor flushes subnormals or keeps them", "[portable]") {
    const std::vector<float> values = samples(1 << 20, 6);
    const bool same = all_results(values, false) == all_results(values, true); // not in CHECK, which prints both
    CHECK(same);
}

} // namespace lockstep::test::portable_test
