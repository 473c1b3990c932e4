#include "reference/legal_interpolation.hpp"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "reference/arithmetic.hpp"

namespace lockstep::test::legal_interpolation_test {
namespace {

constexpr int width = 61, height = 47;
constexpr double step = 1.0 / 256.0;

using Clip = std::array<glm::vec4, 3>;
using Positions = std::array<glm::vec3, 3>;

/// In double, over corners that were put on the grid: the position at a pixel's centre, where the triangle covers it.
struct OnGrid {
    bool covered = false;
    glm::dvec3 position{0.0};
    double ndc = 0.0;
};

OnGrid on_grid(const Clip& clip, const Positions& positions, int x, int y, bool rounds) {
    glm::dmat3 corners;
    for (int k = 0; k < 3; ++k) {
        const glm::vec4& c = clip[static_cast<std::size_t>(k)];
        const auto snapped = [&](float along, int size) {
            const double window = (double{along} / double{c.w} * 0.5 + 0.5) * size;
            const double steps = window / step;
            return ((rounds ? std::round(steps) : std::floor(steps)) * step / size * 2.0 - 1.0) * double{c.w};
        };
        corners[k] = glm::dvec3(snapped(c.x, width), snapped(c.y, height), c.w);
    }
    if (std::abs(glm::determinant(corners)) < 1e-12)
        return {};
    const glm::dvec3 centre((2.0 * x + 1.0) / width - 1.0, (2.0 * y + 1.0) / height - 1.0, 1.0);
    glm::dvec3 shares = glm::inverse(corners) * centre;
    shares /= shares.x + shares.y + shares.z;
    OnGrid at{shares.x >= 0.0 && shares.y >= 0.0 && shares.z >= 0.0};
    double z = 0.0, w = 0.0;
    for (int k = 0; k < 3; ++k) {
        const auto corner = static_cast<std::size_t>(k);
        at.position += shares[k] * glm::dvec3(positions[corner]);
        z += shares[k] * double{clip[corner].z};
        w += shares[k] * double{clip[corner].w};
    }
    at.ndc = z / w;
    return at;
}

/// A corner at a window position, `w` from the camera.
glm::vec4 corner(double x, double y, double z, double w) {
    return {static_cast<float>((x / width * 2.0 - 1.0) * w), static_cast<float>((y / height * 2.0 - 1.0) * w),
            static_cast<float>(z * w), static_cast<float>(w)};
}

} // namespace

TEST_CASE("legal interpolation: corners on the driver's grid are legal, of slivers too", "[legal_interpolation]") {
    std::mt19937 random(7);
    const auto from_to = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    int covered = 0, narrow = 0;
    for (int round = 0; round < 20000; ++round) {
        // Along a line of any direction, from 0.001 to 10 pixels wide.
        const glm::dvec2 from(from_to(0.0, width), from_to(0.0, height)), to(from_to(0.0, width), from_to(0.0, height));
        const double breadth = std::pow(10.0, from_to(-3.0, 1.0));
        const glm::dvec2 aside = from + from_to(0.2, 0.8) * (to - from) + breadth * glm::dvec2(from_to(-1, 1), 1.0);
        const Clip clip{corner(from.x, from.y, from_to(-0.9, 0.9), from_to(0.5, 4.0)),
                        corner(to.x, to.y, from_to(-0.9, 0.9), from_to(0.5, 4.0)),
                        corner(aside.x, aside.y, from_to(-0.9, 0.9), from_to(0.5, 4.0))};
        const Positions positions{glm::vec3(glm::dvec3(from_to(-1, 1))),
                                  glm::vec3(glm::dvec3(from_to(-1, 1), 0.5, from_to(-1, 1))),
                                  glm::vec3(glm::dvec3(from_to(-1, 1)))};
        const glm::dvec2 inside = (from + to + aside) / 3.0;
        const int x = static_cast<int>(inside.x), y = static_cast<int>(inside.y);
        const TriangleInterpolation<Strict> exact(Strict(), clip, width, height);
        const glm::dvec3 here = TriangleInterpolation<Strict>::mix(Strict(), positions, exact.weights(x, y));
        const DriverInterpolation most = driver_interpolation(Strict(), clip, positions, x, y, width, height, {}, step);
        for (const bool rounds : {false, true}) {
            const OnGrid there = on_grid(clip, positions, x, y, rounds);
            if (!there.covered)
                continue;
            ++covered;
            narrow += breadth < 0.1;
            INFO("round " << round << " pixel " << x << ", " << y << " breadth " << breadth);
            for (int k = 0; k < 3; ++k)
                CHECK(std::abs(there.position[k] - here[k]) <= double{most.position[k]});
            CHECK(std::abs(there.ndc * 0.5 + 0.5 - double{exact.depth(exact.weights(x, y))}) <= most.depth);
        }
    }
    CHECK(covered > 5000);
    CHECK(narrow > 100);
}

TEST_CASE("legal interpolation: of a large triangle a grid step is a small share", "[legal_interpolation]") {
    const Clip clip{corner(1, 1, 0.0, 1.0), corner(60, 2, 0.5, 1.0), corner(3, 46, -0.5, 1.0)};
    const Positions positions{glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)};
    const DriverInterpolation most = driver_interpolation(Strict(), clip, positions, 20, 15, width, height, {}, step);
    // A grid step is 1/256 of a pixel, and the triangle 59 by 45 pixels.
    CHECK(most.position.x < 1.2 * (2.0 * step / 59 + 1e-5));
    CHECK(most.position.y < 1.2 * (2.0 * step / 45 + 1e-5));
    CHECK(most.position.z == 0.0F);
    CHECK(most.depth < 1.2 * (step / 59 + step / 45 + 1e-5));
}

} // namespace lockstep::test::legal_interpolation_test
