#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <glm/vec2.hpp>

#include "tests/lights/lit_points.hpp"

namespace lockstep::test::figures_test {

/// The figures that another program had found beforehand for a floor under random lights (16^3 voxels, ranges of 4 m):
/// of these lights here they are to be figures like any others, between the least and the greatest of some draws. Where
/// its lights and its 400 pixels were is not known. A floor at 1.3 m and lights from 2 m upwards, seen along 12 m for
/// one light and over the whole floor for many, give all that it found.
namespace lights = lockstep::lights;

namespace {

using Way = lights::Interpolation;
using S = lights::Supersample;

constexpr float floor_height = 1.3F;

lights::Settings drawn(std::uint32_t seed, std::size_t count, float from, float to) {
    lights::Settings s = one_light();
    s.lights.clear();
    for (std::size_t i = 0; i < count; ++i) {
        Random random(seed, i);
        const auto along = [&](float low, float high) {
            return low + (high - low) * static_cast<float>(random.unit());
        };
        const float x = along(count == 1 ? 4.0F : 0.0F, count == 1 ? 12.0F : 16.0F), y = along(from, to),
                    z = along(count == 1 ? 4.0F : 0.0F, count == 1 ? 12.0F : 16.0F);
        s.lights.push_back({.position = {x, y, z}});
    }
    return s;
}

struct Figures {
    double rms = 0.0;  ///< of lit against light without a grid, as a share of that
    double step = 0.0; ///< the largest between neighbours
};

/// Four hundred points of the floor.
using Pixels = std::array<glm::vec2, 400>; ///< x, z, m

/// Along x, 12 m from wall to wall but for 2 m at each end.
Pixels line(float z) {
    Pixels all;
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = {2.0F + 12.0F * (static_cast<float>(i) + 0.5F) / 400.0F, z};
    return all;
}
/// Twenty by twenty of all of it.
Pixels whole_floor() {
    Pixels all;
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = 0.8F * glm::vec2(static_cast<float>(i % 20) + 0.5F, static_cast<float>(i / 20) + 0.5F);
    return all;
}

Figures seen(const Pixels& pixels, lights::Settings s, Way way, S samples,
             lights::Shading shading = lights::Shading::single) {
    s.switches.interpolation = way;
    s.switches.supersample = samples;
    s.switches.shading = shading;
    s.width = s.height = 2;
    LitPoints points(std::move(s));
    points.step();
    double error = 0.0, all = 0.0, step = 0.0, before = 0.0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const glm::vec3 p(pixels[i].x, floor_height, pixels[i].y);
        const double is = double{points.lit(p, {0, 1, 0}, 1.0F).x}, right = points.truth(glm::dvec3(p));
        error += (is - right) * (is - right);
        all += right * right;
        step = i == 0 ? 0.0 : std::max(step, std::abs(is - before));
        before = is;
    }
    return {std::sqrt(error / all), step};
}

/// The least and the greatest of a figure in some draws.
struct Spread {
    double least = HUGE_VAL, greatest = -HUGE_VAL;
    void add(double x) {
        least = std::min(least, x);
        greatest = std::max(greatest, x);
    }
    [[nodiscard]] bool has(double x) const { return least <= x && x <= greatest; }
    [[nodiscard]] std::string text(double times = 1.0) const {
        return fmt::format("{:.4g} to {:.4g}", times * least, times * greatest);
    }
};

} // namespace

TEST_CASE("lights figures: steps and errors of one light over a floor, by interpolation") {
    constexpr std::array ways{std::pair(Way::nearest, S::one), std::pair(Way::nearest, S::two),
                              std::pair(Way::trilinear, S::one), std::pair(Way::tricubic, S::one)};
    constexpr std::array rms{0.315, 0.207, 0.044, 0.030}, step{0.124, 0.068, 0.0037, 0.0034};
    std::array<Spread, 4> of_rms, of_step;
    Spread interpolated, supersampled, both;
    for (std::uint32_t seed = 0; seed < 16; ++seed) {
        const lights::Settings s = drawn(seed, 1, 2.0F, 4.0F);
        const Pixels pixels = line(s.lights[0].position.z);
        std::array<Figures, 4> found;
        for (std::size_t w = 0; w < ways.size(); ++w) {
            found[w] = seen(pixels, s, ways[w].first, ways[w].second);
            of_rms[w].add(found[w].rms);
            of_step[w].add(found[w].step);
        }
        interpolated.add(found[0].step / found[2].step);
        supersampled.add(found[0].step / found[1].step);
        both.add(found[2].step / seen(pixels, s, Way::trilinear, S::two).step);
    }
    for (std::size_t w = 0; w < ways.size(); ++w) {
        INFO(fmt::format("way {}: rms {} %, step {}", w, of_rms[w].text(100.0), of_step[w].text()));
        CHECK(of_rms[w].has(rms[w]));
        CHECK(of_step[w].has(step[w]));
    }
    INFO(fmt::format("steps: {} times smaller by trilinear, {} by S = 2 of nearest, {} by S = 2 of trilinear",
                     interpolated.text(), supersampled.text(), both.text()));
    CHECK(interpolated.has(0.124 / 0.0037)); // 30-fold
    CHECK(supersampled.has(0.124 / 0.068));  // half
    CHECK(both.greatest < 2.0);              // little more
}

TEST_CASE("lights figures: one summed direction is off by 43 % under 1,024 lights, directionality by 11 %") {
    const Pixels pixels = whole_floor();
    Spread nearest, single, twice, remedy;
    for (std::uint32_t seed = 0; seed < 5; ++seed) {
        const lights::Settings s = drawn(seed, 1024, 2.0F, 15.0F);
        nearest.add(seen(pixels, s, Way::nearest, S::one).rms);
        single.add(seen(pixels, s, Way::trilinear, S::one).rms);
        twice.add(seen(pixels, s, Way::trilinear, S::two).rms);
        remedy.add(seen(pixels, s, Way::trilinear, S::one, lights::Shading::directionality).rms);
    }
    INFO(fmt::format("rms nearest {}, trilinear {}, S = 2 of it {}, directionality {} %", nearest.text(100.0),
                     single.text(100.0), twice.text(100.0), remedy.text(100.0)));
    CHECK(nearest.has(0.67));
    CHECK(single.has(0.428));
    CHECK(twice.has(0.439));
    CHECK(remedy.has(0.112));
    CHECK(single.least > 3.0 * remedy.greatest);
}

} // namespace lockstep::test::figures_test
