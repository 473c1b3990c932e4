#include <algorithm>
#include <limits>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "gpu/collision/render_pass.hpp"
#include "reference/collision/render_pass.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/random_scenes.hpp"

namespace lockstep::test::render_pass_twin_test {
namespace {

ColorImage gpu_render(const Particles& particles, const Mesh& obstacles, const FrameParams& params) {
    RenderPass pass(params.switches, {}, params.render_width, params.render_height);
    ParticleBuffer buffer(particles.size());
    buffer.upload(particles);
    pass.run(buffer, MeshBuffer(obstacles), params);
    ColorImage image;
    pass.read(image);
    return image;
}

/// Pixels that differ between the two sides.
std::ptrdiff_t differences(const Particles& particles, const Mesh& obstacles, const FrameParams& params) {
    const ColorImage cpu = render_pass(particles, obstacles, params, Profile{});
    const ColorImage gpu = gpu_render(particles, obstacles, params);
    REQUIRE(gpu.texels.size() == cpu.texels.size());
    std::ptrdiff_t count = 0;
    for (std::size_t i = 0; i < cpu.texels.size(); ++i)
        count += cpu.texels[i] == gpu.texels[i] ? 0 : 1;
    return count;
}

FrameParams view(int width, int height, float radius) {
    FrameParams params;
    params.render_width = width;
    params.render_height = height;
    params.render_view = view_matrix(Camera{});
    params.render_projection = projection_matrix(Camera{}, static_cast<float>(width) / static_cast<float>(height));
    params.constants.billboard_radius = radius;
    return params;
}

/// The exact preset's promise: the same pixels on whatever driver is behind `backend`.
void check_exact(const char* backend) {
    const auto context = test::open_context(backend);
    if (!context)
        return;
    INFO(context->describe().renderer);
    test::RandomScenes scenes(6);
    const auto differ = [&](const Particles& particles, const Mesh& obstacles, FrameParams params) {
        params.switches.arithmetic = ArithmeticSwitch::exact;
        Profile keeping; // nothing may depend on what happens to subnormals
        keeping.flush_subnormals = false;
        CHECK(render_pass(particles, obstacles, params, keeping).texels ==
              render_pass(particles, obstacles, params, Profile{}).texels);
        return differences(particles, obstacles, params);
    };
    CHECK(differ({}, {}, view(61, 333, 0.01F)) == 0);
    for (const auto& [width, height] : {std::pair{500, 500}, std::pair{333, 250}, std::pair{64, 97}})
        for (const float radius : {0.001F, 0.004F, 0.03F, 0.2F}) {
            INFO(fmt::format("{} x {}, radius {}", width, height, radius));
            CHECK(differ(scenes.particles(3000, 1.5F), scenes.triangles(200, 1.5F, 0.3F),
                         view(width, height, radius)) == 0);
        }
    for (int round = 0; round < 4; ++round) {
        INFO("round " << round);
        CHECK(differ(scenes.particles(1000, 4.0F), scenes.triangles(20, 4.0F, 2.0F), view(200, 150, 0.05F)) == 0);
        CHECK(differ(scenes.particles(100, 4.0F), {}, view(200, 150, 1.0F)) == 0);
        CHECK(differ({}, scenes.slivers(1000), view(200, 150, 1.0F)) == 0);
        CHECK(differ({}, scenes.any_magnitude(1000), view(65, 33, 1.0F)) == 0);
    }
}

} // namespace

TEST_CASE("render pass twin: the background is the same in every pixel") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    CHECK(differences({}, {}, view(800, 800, 0.01F)) == 0);
    CHECK(differences({}, {}, view(61, 333, 0.01F)) == 0);
}

TEST_CASE("render pass twin: particles and obstacles leave the same pixels") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    test::RandomScenes scenes(1);
    for (const auto& [width, height] : {std::pair{400, 400}, std::pair{333, 250}, std::pair{64, 97}})
        for (const float radius : {0.001F, 0.004F, 0.03F, 0.2F}) {
            INFO(fmt::format("{} x {}, radius {}", width, height, radius));
            CHECK(differences(scenes.particles(3000, 1.5F), scenes.triangles(200, 1.5F, 0.3F),
                              view(width, height, radius)) == 0);
        }
}

TEST_CASE("render pass twin: the same pixels through EGL") {
    const auto context = test::open_llvmpipe("egl");
    if (!context)
        return;
    test::RandomScenes scenes(5);
    CHECK(differences(scenes.particles(3000, 1.5F), scenes.triangles(200, 1.5F, 0.3F), view(333, 250, 0.03F)) == 0);
}

TEST_CASE("render pass twin: exact arithmetic leaves the same pixels, on OSMesa") { check_exact("osmesa"); }

TEST_CASE("render pass twin: exact arithmetic leaves the same pixels, on EGL") { check_exact("egl"); }

TEST_CASE("render pass twin: exact arithmetic leaves the same pixels, on EGL device 0", "[.device]") {
    check_exact("egl-device:0");
}

TEST_CASE("render pass twin: billboards and triangles across every clip plane leave the same pixels") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    test::RandomScenes scenes(2);
    for (int round = 0; round < 4; ++round) {
        INFO("round " << round);
        CHECK(differences(scenes.particles(3000, 4.0F), scenes.triangles(20, 4.0F, 2.0F), view(200, 150, 0.05F)) == 0);
        CHECK(differences(scenes.particles(100, 4.0F), {}, view(200, 150, 1.0F)) == 0);
    }
}

TEST_CASE("render pass twin: particles without a place draw nothing on either side") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    Particles particles = test::RandomScenes(3).particles(8, 1.0F);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    particles.position = {{nan, 0, 0}, {0, nan, 0}, {0, 0, nan}, {infinity, 0, 0},
                          {0, 0, 3},   {0, 0, 4},   {0, 0, -9},  {50, 0, 0}};
    const FrameParams params = view(64, 64, 0.1F);
    const ColorImage drawn = gpu_render(particles, {}, params);
    CHECK(differences(particles, {}, params) == 0);
    CHECK(drawn.texels == gpu_render({}, {}, params).texels);
}

TEST_CASE("render pass twin: NaN and infinite states are coloured alike") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    Particles particles = test::RandomScenes(4).particles(4, 0.5F);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    particles.speed = {nan, infinity, -infinity, -1.0F};
    particles.collide_time = {infinity, nan, 0.05F, 1e30F};
    CHECK(differences(particles, {}, view(128, 128, 0.2F)) == 0);
}

TEST_CASE("render pass: an image GL cannot make is told with its limits", "[render_pass]") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    CHECK_THROWS_WITH(RenderPass(Switches{}, {}, 0, 10),
                      Catch::StartsWith("rendered image of 0 x 10 pixels: this GL allows 1 to "));
}

} // namespace lockstep::test::render_pass_twin_test
