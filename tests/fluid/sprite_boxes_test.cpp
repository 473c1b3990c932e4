#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "reference/fluid/sprite.hpp"
#include "reference/readings/values.hpp"
#include "tests/fluid/fluid_run.hpp"

namespace lockstep::test::sprite_boxes_test {

/// The boxes outside of which a sphere is not tried.
namespace fluid = lockstep::fluid;

namespace {

/// Spheres of many sizes before a camera that stands `away` from the world's middle.
fluid::Settings scattered(float away, std::uint64_t seed) {
    fluid::Settings s;
    s.width = 72;
    s.height = 56;
    s.radius = 0.05F;
    s.camera = {.eye = {away, -away, 0.5F * away}, .near_plane = 0.125F, .far_plane = 100.0F};
    s.camera.target = s.camera.eye + glm::vec3(0.3F, -0.2F, -1.0F);
    Random random(seed, 0);
    for (int i = 0; i < 200; ++i) {
        const auto depth = static_cast<float>(0.13 + 4.0 * random.unit() * random.unit());
        const auto beside = [&] { return static_cast<float>(depth * random.symmetric()); };
        s.particles.push_back(s.camera.eye + glm::vec3(beside(), beside(), -depth));
    }
    return s;
}

/// The least square that a coordinate's place may have, by any driver's points.
double least_square(float pixel, float middle, float half) {
    const Interval place =
        fluid::point_place(fluid::PointCoord::open, {Interval(pixel), Interval(middle), Interval(half)});
    return interval::square(place).low;
}

struct Covered {
    std::size_t pixels = 0, outside = 0, boxed = 0; ///< covered; of them beside the box; in boxes
};

Covered covered_by(const fluid::Settings& settings, bool by_points) {
    const fluid::HostPtr host = host_of(settings);
    const System system = fluid::system(host);
    ReferenceRun run(system, named_profile("strict"));
    run_up_to(run, system, "sphere_depth_pass");
    const SystemView state = run.state().view();
    const fluid::Spheres spheres{fluid::Sphere::flat, settings.radius};
    const BoxesByTile boxes = fluid::sprite_boxes(*host, state, spheres);
    Values<Strict> r{Strict{}};
    const fluid::SpriteTwin<Values<Strict>> sprite(r, *host, state, spheres);
    Covered found;
    for (std::uint32_t i = 0; i < settings.particles.size(); ++i) {
        const auto ball = sprite.ball(i);
        if (!ball)
            continue;
        const PixelRect& box = boxes.box(i);
        found.boxed +=
            static_cast<std::size_t>(std::max(box.x1 - box.x0, 0)) * static_cast<std::size_t>(box.y1 - box.y0);
        for (int y = 0; y < settings.height; ++y)
            for (int x = 0; x < settings.width; ++x) {
                const auto centre = [](int pixel) { return static_cast<float>(pixel) + 0.5F; };
                const bool covered = by_points ? least_square(centre(x), ball->x, ball->half) +
                                                         least_square(centre(y), ball->y, ball->half) <=
                                                     1.0
                                               : sprite.squared(*ball, Pixel{x, y}) <= 1.0F;
                found.pixels += covered ? 1U : 0U;
                found.outside += covered && !Pixel{x, y}.is_in(box) ? 1U : 0U;
            }
    }
    return found;
}

} // namespace

TEST_CASE("sprite boxes: hold every pixel that a sphere may cover, and hardly more than the disc's square") {
    for (const std::uint64_t seed : {1U, 2U, 3U})
        for (const float away : {0.0F, 30.0F, 3000.0F, 40000.0F}) {
            const fluid::Settings s = scattered(away, seed);
            const Covered quads = covered_by(with(s, {"sprite=quad"}), false),
                          points = covered_by(with(s, {"sprite=points"}), true);
            INFO("away " << away << ": " << quads.outside << " of " << quads.pixels << ", " << points.outside << " of "
                         << points.pixels);
            CHECK(quads.pixels > 10000);
            CHECK(quads.outside == 0);
            CHECK(points.outside == 0);
            if (away < 100.0F)
                CHECK(20 * quads.boxed < 28 * quads.pixels);
        }
}

} // namespace lockstep::test::sprite_boxes_test
