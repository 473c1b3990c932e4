#include <bit>
#include <cmath>
#include <cstring>

#include <catch2/catch.hpp>

#include "reference/arithmetic.hpp"
#include "reference/lifecycle/packing.hpp"
#include "reference/model/lifecycle/layout.hpp"
#include "reference/model/lifecycle/schema.hpp"
#include "reference/readings/values.hpp"

namespace lockstep::test::packing_test {

using namespace lockstep::lifecycle;

namespace {

/// What a half means, in double.
double meaning(std::uint32_t code) {
    const double sign = (code & 0x8000U) != 0 ? -1.0 : 1.0;
    const auto exponent = static_cast<int>(code >> 10U & 31U);
    const double fraction = code & 0x3ffU;
    return exponent == 0 ? sign * std::ldexp(fraction, -24) : sign * std::ldexp(1024.0 + fraction, exponent - 25);
}

bool is_nan(std::uint32_t code) { return (code & 0x7fffU) > 0x7c00U; }

/// Floats of all exponents, each with what its last bits may be: 13 bits at least are cut off.
template <class Visit> void for_floats(const Visit& visit) {
    for (std::uint32_t high = 0; high < 1U << 16U; ++high)
        for (const std::uint32_t low : {0U, 1U, 0xfffU, 0x1000U, 0x1001U, 0x1fffU, 0x2000U, 0x8000U, 0xf000U, 0xffffU})
            visit(std::bit_cast<float>(high << 16U | low));
}

} // namespace

TEST_CASE("packing: every half is decoded exactly, and encoded to itself in every rounding") {
    for (std::uint32_t code = 0; code < 1U << 16U; ++code) {
        const float value = half_value(code);
        if (is_nan(code)) {
            CHECK(std::isnan(value));
            continue;
        }
        if ((code & 0x7fffU) == 0x7c00U)
            CHECK(std::isinf(value));
        else if (double{value} != meaning(code))
            FAIL_CHECK(code << " is decoded as " << value);
        for (const auto rounding : {HalfRounding::toward_zero, HalfRounding::nearest_even, HalfRounding::dithered})
            if (half_code(value, rounding, 0xffffffffU) != code)
                FAIL_CHECK(code << " becomes " << half_code(value, rounding, 0xffffffffU));
    }
}

TEST_CASE("packing: nearest halves are the compiler's own, but finite numbers stay finite") {
    for_floats([](float x) {
        const auto expected = static_cast<_Float16>(x);
        std::uint16_t bits = 0;
        std::memcpy(&bits, &expected, sizeof bits);
        std::uint32_t right = std::isnan(x) ? 0x7e00U : bits;
        if ((right & 0x7fffU) == 0x7c00U && !std::isinf(x))
            right -= 1;
        if (half_code(x, HalfRounding::nearest_even) != right)
            FAIL_CHECK(x << " becomes " << half_code(x, HalfRounding::nearest_even) << ", not " << right);
    });
}

TEST_CASE("packing: halves toward zero and dithered lie where they should, within the stated bounds") {
    for_floats([](float x) {
        if (!std::isfinite(x) || std::abs(x) > 65504.0F)
            return;
        const double exact = x, size = std::abs(exact);
        const double down = meaning(half_code(x, HalfRounding::toward_zero));
        const double near = meaning(half_code(x, HalfRounding::nearest_even));
        const double bound = size < 0x1p-14 ? 0x1p-24 : size * 0x1p-10;
        bool right = std::abs(down) <= size && size - std::abs(down) < bound && std::abs(near - exact) <= bound / 2;
        for (const std::uint32_t dither : {0U, 0xfffU, 0x1fffU, 0xffffffffU}) {
            const double one = std::abs(meaning(half_code(x, HalfRounding::dithered, dither)));
            right = right && one >= (size < 0x1p-24 ? 0.0 : std::abs(down)) && one <= std::abs(down) + bound;
        }
        if (!right)
            FAIL_CHECK(x << ": " << down << ", " << near);
    });
}

TEST_CASE("packing: halves rise with their numbers, so that an interval is one of codes") {
    for (const auto rounding : {HalfRounding::toward_zero, HalfRounding::nearest_even}) {
        float last = -1e9F;
        for (std::uint32_t step = 0; step < 1U << 17U; ++step) {
            const std::uint32_t magnitude = (step & 0xffffU) << 15U;
            if (magnitude > 0x7f800000U)
                continue;
            const float x =
                std::bit_cast<float>(step >> 16U == 0 ? 0x80000000U | (0x7f800000U - magnitude) : magnitude);
            const float code = ordered_half(half_code(x, rounding));
            if (code < last)
                FAIL_CHECK(x << " has code " << code << " after " << last);
            CHECK(half_of_ordered(static_cast<int>(code)) == half_code(x, rounding));
            last = code;
        }
    }
}

TEST_CASE("packing: eight bits of a colour are within 1/510, ten within 1/2046, and NaN is 0") {
    static constexpr Site site{"test"};
    Values<Strict> r{Strict{}};
    const auto code = [&](float c, float steps) { return unorm_of(r, site, c, steps); };
    for (const float steps : {255.0F, 1023.0F, 3.0F}) {
        for (int k = 0; k <= 1 << 16; ++k) {
            const float c = static_cast<float>(k) * 0x1p-16F;
            if (std::abs(static_cast<double>(code(c, steps)) / double{steps} - double{c}) > 0.5 / double{steps} + 1e-7)
                FAIL_CHECK(c << " becomes " << code(c, steps));
        }
        for (std::uint32_t k = 0; k <= static_cast<std::uint32_t>(steps); ++k)
            CHECK(code(static_cast<float>(k) / steps, steps) == k);
        CHECK(code(-1.0F, steps) == 0);
        CHECK(code(2.0F, steps) == static_cast<std::uint32_t>(steps));
        CHECK(code(std::bit_cast<float>(0x7fc00000U), steps) == 0);
        CHECK(code(HUGE_VALF, steps) == static_cast<std::uint32_t>(steps));
    }
}

TEST_CASE("packing: sixteen bits of ticks or of a box are clamped, and say so") {
    static constexpr Site site{"test"};
    Values<Strict> r{Strict{}};
    const auto code = [&](float x) {
        bool clamped = false;
        const std::uint32_t made = ticks_of(r, site, x, &clamped);
        return std::pair(made, clamped);
    };
    for (int k = 0; k < 1 << 16; ++k) {
        CHECK(code(static_cast<float>(k)) == std::pair(static_cast<std::uint32_t>(k), false));
        if (k > 0)
            CHECK(code(static_cast<float>(k) - 0.5F).first == static_cast<std::uint32_t>(k));
    }
    CHECK(code(-0.6F) == std::pair(0U, true));
    CHECK(code(65536.0F) == std::pair(65535U, true));
    CHECK(code(1e30F) == std::pair(65535U, true));
    CHECK(code(-HUGE_VALF) == std::pair(0U, true));
    CHECK(code(std::bit_cast<float>(0x7fc00000U)) == std::pair(0U, true));
}

TEST_CASE(
    "packing: every layout of the ladder is as many words as it is called, with floats where its schema has them") {
    const std::size_t bytes[] = {112, 80, 72, 64, 48, 44, 40};
    for (std::size_t k = 0; k < 7; ++k) {
        lifecycle::Switches s;
        s.layout = static_cast<Layout>(k);
        const LayoutPlan& plan = plan_of(s.layout);
        const Resource& particles = schema(s).resources[particle_buffer];
        CHECK(plan.words * 4 == bytes[k]);
        CHECK(item_bytes(particles) == bytes[k]);
        std::size_t word = 0;
        for (const Field& field : particles.fields)
            for (int c = 0; c < field.components; ++c)
                CHECK(plan.is_float(word++) == (field.scalar == Scalar::float32));
    }
}

} // namespace lockstep::test::packing_test
