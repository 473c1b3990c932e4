#include "reference/triangle_interpolation.hpp"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "reference/arithmetic.hpp"
#include "reference/portable.hpp"
#include "reference/subnormals.hpp"

namespace lockstep::test::triangle_interpolation_test {
namespace {

using Interpolation = TriangleInterpolation<Strict>;
using Exact = TriangleInterpolation<Portable>;

/// The same in double, from the definition: the shares for which the corners' sum projects to the pixel's centre.
glm::dvec3 exact_weights(const std::array<glm::vec4, 3>& clip, int x, int y, int width, int height) {
    glm::dmat3 corners;
    for (int i = 0; i < 3; ++i)
        corners[i] = glm::dvec3(clip[static_cast<std::size_t>(i)].x, clip[static_cast<std::size_t>(i)].y,
                                clip[static_cast<std::size_t>(i)].w);
    const glm::dvec3 centre((2.0 * x + 1.0) / width - 1.0, (2.0 * y + 1.0) / height - 1.0, 1.0);
    const glm::dvec3 shares = glm::inverse(corners) * centre;
    return shares / (shares.x + shares.y + shares.z);
}

} // namespace

TEST_CASE("triangle interpolation: shares of a triangle parallel to the image", "[triangle_interpolation]") {
    // 4 x 4 pixels, right angle at the lower left corner of the image, legs as long as the image: pixel (1, 0) has its
    // centre at 1.5 / 4 of the first leg and 0.5 / 4 of the second.
    const Interpolation interpolation(
        Strict(), {glm::vec4(-1, -1, 0, 1), glm::vec4(1, -1, 0.5F, 1), glm::vec4(-1, 1, 1, 1)}, 4, 4);
    const auto weights = interpolation.weights(1, 0);
    CHECK(weights.second == 0.375F);
    CHECK(weights.third == 0.125F);
    CHECK(interpolation.depth(weights) == 0.5F + 0.5F * (0.375F * 0.5F + 0.125F));
    CHECK(Interpolation::mix(Strict(), {glm::vec3(0), glm::vec3(8, 0, 0), glm::vec3(0, 8, 1)}, weights) ==
          glm::vec3(3.0F, 1.0F, 0.125F));
}

TEST_CASE("triangle interpolation: shares are perspective-correct", "[triangle_interpolation]") {
    // From w = 1 at the left border to w = 3 at the right: in the middle of the image 3 / 4 of the near end is seen.
    const Interpolation interpolation(Strict(),
                                      {glm::vec4(-1, -1, 0, 1), glm::vec4(3, -3, 0, 3), glm::vec4(-1, 1, 0, 1)}, 1, 1);
    CHECK(interpolation.weights(0, 0).second == 0.25F);
}

TEST_CASE("triangle interpolation: a centre beyond the triangle gets shares inside it", "[triangle_interpolation]") {
    const Interpolation interpolation(
        Strict(), {glm::vec4(0, 0, 0, 1), glm::vec4(0.1F, 0, 0, 1), glm::vec4(0, 0.1F, 0, 1)}, 8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            const auto weights = interpolation.weights(x, y);
            CHECK(weights.second >= 0.0F);
            CHECK(weights.third >= 0.0F);
            CHECK(weights.second + weights.third <= 1.0F);
        }
}

TEST_CASE("triangle interpolation: a triangle seen edge-on answers its first corner", "[triangle_interpolation]") {
    const Interpolation interpolation(Strict(), {glm::vec4(0, 0, 0, 1), glm::vec4(1, 1, 0, 1), glm::vec4(-1, -1, 0, 1)},
                                      8, 8);
    const auto weights = interpolation.weights(3, 3);
    CHECK(weights.second == 0.0F);
    CHECK(weights.third == 0.0F);
}

TEST_CASE("triangle interpolation: depth stays in 0..1", "[triangle_interpolation]") {
    const Interpolation interpolation(Strict(),
                                      {glm::vec4(-1, -1, 5, 1), glm::vec4(1, -1, 5, 1), glm::vec4(-1, 1, -5, 1)}, 4, 4);
    CHECK(interpolation.depth({0.0F, 0.0F}) == 1.0F);
    CHECK(interpolation.depth({0.0F, 1.0F}) == 0.0F);
}

TEST_CASE("triangle interpolation: accurate where triangles are as small as pixels", "[triangle_interpolation]") {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> place(-0.9F, 0.9F);
    std::uniform_real_distribution<float> pixel(-0.004F, 0.004F);
    std::uniform_real_distribution<float> distance(0.5F, 5.0F);
    constexpr int size = 500;
    double worst = 0.0;
    for (int round = 0; round < 20000; ++round) {
        const glm::vec2 middle(place(random), place(random));
        const float w = distance(random);
        std::array<glm::vec4, 3> clip{};
        for (glm::vec4& corner : clip) {
            const float corner_w = w * (1.0F + pixel(random));
            corner = {(middle.x + pixel(random)) * corner_w, (middle.y + pixel(random)) * corner_w, 0.0F, corner_w};
        }
        const int x = static_cast<int>((middle.x + 1.0F) * 0.5F * size);
        const int y = static_cast<int>((middle.y + 1.0F) * 0.5F * size);
        const glm::dvec3 exact = exact_weights(clip, x, y, size, size);
        if (exact.x < 0.0 || exact.y < 0.0 || exact.z < 0.0)
            continue;
        const auto weights = Interpolation(Strict(), clip, size, size).weights(x, y);
        // The error of a share times the length of a side, in pixels: where the answer lies on the image.
        const double longest = std::sqrt(2.0) * 0.008 * 0.5 * size;
        worst = std::max(
            {worst, longest * std::abs(weights.second - exact.y), longest * std::abs(weights.third - exact.z)});
    }
    CHECK(worst < 1.0 / 256);
}

TEST_CASE("triangle interpolation: the exact preset's own coverage has its sides in", "[triangle_interpolation]") {
    // Image of 4 x 4, corners on the centres of pixels (0, 0), (2, 0) and (0, 2), either way round.
    const glm::vec4 a(-0.75F, -0.75F, 0, 1), b(0.25F, -0.75F, 0, 1), c(-0.75F, 0.25F, 0, 1);
    for (const auto& clip : {std::array{a, b, c}, std::array{a, c, b}})
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) {
                INFO(x << ' ' << y);
                CHECK(Exact(Portable(), clip, 4, 4).fragment(x, y).has_value() == (x + y <= 2));
            }
    const auto corner = Exact(Portable(), {a, b, c}, 4, 4).fragment(2, 0);
    REQUIRE(corner);
    CHECK(corner->weights.second == 1.0F);
    CHECK(corner->weights.third == 0.0F);
    CHECK(corner->depth == 0.5F);
}

TEST_CASE("triangle interpolation: a shared side has one edge function but for its sign", "[triangle_interpolation]") {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(-2.0F, 2.0F);
    const auto corner = [&] { return glm::vec4(place(random), place(random), place(random), place(random)); };
    for (int round = 0; round < 1000; ++round) {
        const glm::vec4 a = corner(), b = corner();
        const auto here = Exact(Portable(), {a, b, corner()}, 100, 70).edges(30, 20);
        const auto there = Exact(Portable(), {corner(), b, a}, 100, 70).edges(30, 20);
        CHECK(here.third == -there.first);
    }
}

TEST_CASE("triangle interpolation: nothing is covered behind the camera or beyond near and far plane",
          "[triangle_interpolation]") {
    const auto covered = [](float z, float w) {
        return Exact(Portable(), {glm::vec4(-w, -w, z, w), glm::vec4(3 * w, -w, z, w), glm::vec4(-w, 3 * w, z, w)}, 1,
                     1)
            .fragment(0, 0)
            .has_value();
    };
    CHECK(covered(0, 2));
    CHECK(covered(2, 2));
    CHECK(covered(-2, 2));
    CHECK_FALSE(covered(2.001F, 2));
    CHECK_FALSE(covered(-2.001F, 2));
    CHECK_FALSE(covered(0, -2));
    CHECK_FALSE(covered(0, 0));
}

TEST_CASE("triangle interpolation: the part before the camera of a triangle that reaches behind it is covered",
          "[triangle_interpolation]") {
    // The floor y = -1 from w = 4, as wide as the image there, to behind the camera: seen from y / w = -1 / 4
    // downwards.
    const Exact floor(Portable(), {glm::vec4(-4, -1, 0, 4), glm::vec4(4, -1, 0, 4), glm::vec4(0, -1, 0, -4)}, 16, 16);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            INFO(x << ' ' << y);
            CHECK(floor.fragment(x, y).has_value() == (y < 6));
        }
}

TEST_CASE("triangle interpolation: nothing is covered without area or where areas overflow",
          "[triangle_interpolation]") {
    CHECK_FALSE(Exact(Portable(), {glm::vec4(0, 0, 0, 1), glm::vec4(1, 1, 0, 1), glm::vec4(-1, -1, 0, 1)}, 8, 8)
                    .fragment(4, 4));
    CHECK_FALSE(Exact(Portable(), {glm::vec4(0), glm::vec4(0), glm::vec4(0)}, 8, 8).fragment(4, 4));
    const float huge = 1e30F;
    CHECK_FALSE(Exact(Portable(),
                      {glm::vec4(-huge, -huge, 0, huge), glm::vec4(huge, -huge, 0, huge), glm::vec4(0, huge, 0, huge)},
                      8, 8)
                    .fragment(4, 4));
}

TEST_CASE("triangle interpolation: in exact arithmetic it does not matter whether subnormals are flushed",
          "[triangle_interpolation]") {
    // Round the middle of one pixel, corners of such magnitudes that products and differences are tiny.
    std::mt19937 random(4);
    std::uniform_real_distribution<float> value(-1.0F, 1.0F);
    std::uniform_int_distribution<int> exponent(-6, 3);
    int covered = 0;
    for (int round = 0; round < 100000; ++round) {
        std::array<glm::vec4, 3> clip{};
        for (glm::vec4& corner : clip)
            corner = {std::ldexp(value(random), exponent(random) - (round % 2 == 0 ? 63 : 122)),
                      std::ldexp(value(random), exponent(random) - (round % 2 == 0 ? 63 : 2)), value(random), 1.0F};
        for (glm::vec4& corner : clip)
            corner.x = Portable::flush(corner.x);
        const auto fragment = [&](bool flush) {
            const FlushSubnormals guard(flush);
            return Exact(Portable(), clip, 1, 1).fragment(0, 0);
        };
        const auto flushed = fragment(true);
        const auto kept = fragment(false);
        REQUIRE(flushed.has_value() == kept.has_value());
        if (!flushed)
            continue;
        ++covered;
        CHECK(flushed->weights.second == kept->weights.second);
        CHECK(flushed->weights.third == kept->weights.third);
        CHECK(flushed->depth == kept->depth);
    }
    CHECK(covered > 1000);
}

TEST_CASE("triangle interpolation: the bound covers a division off by 2.5 ULP", "[triangle_interpolation]") {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> share(0.0F, 1.0F);
    std::uniform_real_distribution<float> coordinate(-2.0F, 2.0F);
    const auto mix = [](float a, float b, float c, float second, float third) {
        return (a + second * (b - a)) + third * (c - a);
    };
    for (int round = 0; round < 100000; ++round) {
        const float a = coordinate(random), b = coordinate(random), c = coordinate(random);
        const float second = share(random);
        const float third = share(random) * (1.0F - second);
        const float bound = interpolation_bound(a, b, c);
        for (const float slip : {-0x1.8p-22F, 0x1.8p-22F}) // 3 * 2^-23
            CHECK(std::abs(mix(a, b, c, second * (1.0F + slip), third * (1.0F - slip)) - mix(a, b, c, second, third)) <=
                  bound);
    }
}

} // namespace lockstep::test::triangle_interpolation_test
