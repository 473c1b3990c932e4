#include "reference/collision/render_pass.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include <omp.h>

#include <catch2/catch.hpp>

namespace lockstep::test::render_pass_test {
namespace {

/// Camera at z = 3 looking down -z.
FrameParams view(int size) {
    FrameParams params;
    params.render_width = params.render_height = size;
    params.render_view = view_matrix(Camera{});
    params.render_projection = projection_matrix(Camera{}, 1.0F);
    params.constants.billboard_radius = 0.2F;
    return params;
}

Particles particles(const std::vector<glm::vec3>& positions, float speed = 0.0F, float collide_time = -1.0F) {
    Particles result;
    result.resize(positions.size());
    result.position = positions;
    std::fill(result.speed.begin(), result.speed.end(), speed);
    std::fill(result.collide_time.begin(), result.collide_time.end(), collide_time);
    return result;
}

ColorImage render(const Particles& p, const Mesh& m, const FrameParams& params) {
    return render_pass(p, m, params, Profile{});
}

} // namespace

TEST_CASE("render pass: an empty scene is an opaque background, alike in every column", "[render_pass]") {
    const ColorImage image = render({}, {}, view(16));
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            CHECK(image.at(x, y) == image.at(0, y));
            CHECK(image.at(x, y).a == 255);
        }
    // A sixteenth and a half of the way from (48, 52, 60) / 256 to (12, 14, 20) / 256, in 255 codes.
    CHECK(image.at(0, 0) == Rgba8{47, 51, 59, 255});
    CHECK(image.at(0, 15) == Rgba8{13, 15, 21, 255});
}

TEST_CASE("render pass: a particle is a disc round its projection", "[render_pass]") {
    FrameParams params = view(64);
    params.switches.arithmetic = GENERATE(ArithmeticSwitch::plain, ArithmeticSwitch::exact);
    const ColorImage empty = render({}, {}, params);
    const ColorImage image = render(particles({{0, 0, 0}}), {}, params);
    // Half side in pixels: 32 * 0.2 / (3 tan 22.5) = 5.15.
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const float dx = static_cast<float>(x) - 31.5F;
            const float dy = static_cast<float>(y) - 31.5F;
            INFO(x << ' ' << y);
            CHECK((image.at(x, y) != empty.at(x, y)) == (dx * dx + dy * dy < 5.15F * 5.15F));
        }
}

TEST_CASE("render pass: the nearer particle hides the farther, whatever the order", "[render_pass]") {
    const FrameParams params = view(64);
    Particles both = particles({{0, 0, 0}, {0, 0, 1}});
    both.speed = {0.0F, 2.0F};
    Particles swapped = particles({{0, 0, 1}, {0, 0, 0}});
    swapped.speed = {2.0F, 0.0F};
    CHECK(render(both, {}, params).texels == render(swapped, {}, params).texels);
    CHECK(render(both, {}, params).at(32, 32) == render(particles({{0, 0, 1}}, 2.0F), {}, params).at(32, 32));
}

TEST_CASE("render pass: a particle that has just collided glows, a fast one is lighter", "[render_pass]") {
    const FrameParams params = view(64);
    const auto middle = [&](float speed, float collide_time) {
        return render(particles({{0, 0, 0}}, speed, collide_time), {}, params).at(32, 32);
    };
    const Rgba8 slow = middle(0.0F, -1.0F);
    CHECK(slow.b > slow.r);
    CHECK(middle(2.0F, -1.0F).r > slow.r);
    const Rgba8 hot = middle(0.0F, params.constants.collision_time);
    CHECK(hot.r > hot.b);
    CHECK(middle(0.0F, 0.0F) == slow);
}

TEST_CASE("render pass: obstacles hide particles behind them and are hidden by those before", "[render_pass]") {
    const FrameParams params = view(64);
    const Mesh wall{{{-1, -1, 0}, {1, -1, 0}, {0, 1.5F, 0}}, {0, 1, 2}};
    const ColorImage alone = render({}, wall, params);
    CHECK(alone.at(32, 32) != render({}, {}, params).at(32, 32));
    CHECK(render(particles({{0, 0, -1}}), wall, params).texels == alone.texels);
    CHECK(render(particles({{0, 0, 1}}), wall, params).at(32, 32) != alone.at(32, 32));
}

TEST_CASE("render pass: an obstacle looks alike from both sides", "[render_pass]") {
    const FrameParams params = view(32);
    const Mesh wall{{{-1, -1, 0}, {1, -1, 0.25F}, {0, 1.5F, 0}}, {0, 1, 2}};
    const Mesh turned{wall.positions, {0, 2, 1}};
    CHECK(render({}, wall, params).texels == render({}, turned, params).texels);
}

TEST_CASE("render pass: an obstacle facing the light is brightest", "[render_pass]") {
    const FrameParams params = view(32);
    const auto middle = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        return render({}, Mesh{{a, b, c}, {0, 1, 2}}, params).at(16, 12).g;
    };
    const int facing_camera = middle({-2, -2, 0}, {2, -2, 0}, {0, 2, 0});
    const int facing_up_left = middle({-2, -2, 1}, {2, -2, 0.5F}, {0, 2, -1});
    const int facing_down = middle({-2, -2, -1.5F}, {2, -2, -1.5F}, {0, 2, 1});
    CHECK(facing_up_left > facing_down);
    CHECK(facing_camera > facing_down);
}

TEST_CASE("render pass: particles that are NaN or out of sight draw nothing", "[render_pass]") {
    const FrameParams params = view(32);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(render(particles({{nan, 0, 0}, {0, 0, nan}, {0, 0, 5}, {9, 0, 0}, {0, 0, -9}}), {}, params).texels ==
          render({}, {}, params).texels);
}

TEST_CASE("render pass: exact arithmetic draws what plain arithmetic draws, sides of obstacles aside",
          "[render_pass]") {
    std::mt19937 random(16);
    std::uniform_real_distribution<float> place(-1.5F, 1.5F);
    std::vector<glm::vec3> positions(300);
    for (glm::vec3& p : positions)
        p = {place(random), place(random), place(random)};
    Mesh obstacles{{positions.begin(), positions.begin() + 30}, std::vector<std::uint32_t>(30)};
    std::iota(obstacles.indices.begin(), obstacles.indices.end(), 0U);
    FrameParams params = view(200);
    const auto differ = [&](const Particles& p, const Mesh& m) {
        params.switches.arithmetic = ArithmeticSwitch::plain;
        const ColorImage plain = render(p, m, params);
        params.switches.arithmetic = ArithmeticSwitch::exact;
        const ColorImage exact = render(p, m, params);
        int count = 0;
        for (std::size_t i = 0; i < plain.texels.size(); ++i) {
            const Rgba8 a = plain.texels[i], b = exact.texels[i];
            count += std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b) > 3 ? 1 : 0;
        }
        return count;
    };
    CHECK(differ(particles(positions), {}) < 4);
    CHECK(differ({}, obstacles) < 40);
}

TEST_CASE("render pass: particles may come in any order", "[render_pass]") {
    std::mt19937 random(6);
    std::uniform_real_distribution<float> place(-1.0F, 1.0F);
    std::vector<glm::vec3> positions(500);
    for (glm::vec3& p : positions)
        p = {place(random), place(random), place(random)};
    const FrameParams params = view(96);
    const ColorImage image = render(particles(positions), {}, params);
    std::shuffle(positions.begin(), positions.end(), random);
    CHECK(render(particles(positions), {}, params).texels == image.texels);
}

TEST_CASE("render pass: the picture does not depend on the number of threads", "[render_pass]") {
    std::mt19937 random(8);
    std::uniform_real_distribution<float> place(-1.0F, 1.0F);
    std::vector<glm::vec3> positions(300);
    for (glm::vec3& p : positions)
        p = {place(random), place(random), place(random)};
    Mesh obstacles{positions, std::vector<std::uint32_t>(positions.size())};
    std::iota(obstacles.indices.begin(), obstacles.indices.end(), 0U);
    const FrameParams params = view(100);
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const ColorImage alone = render(particles(positions), obstacles, params);
    for (const int count : {2, 4}) {
        omp_set_num_threads(count);
        CHECK(render(particles(positions), obstacles, params).texels == alone.texels);
    }
    omp_set_num_threads(threads);
}

} // namespace lockstep::test::render_pass_test
