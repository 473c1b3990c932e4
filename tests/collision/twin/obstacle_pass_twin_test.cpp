#include <algorithm>
#include <array>
#include <cstring>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <glm/common.hpp>

#include "gpu/collision/collision_texture.hpp"
#include "gpu/collision/obstacle_pass.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "reference/triangle_interpolation.hpp"
#include "tests/collision/obstacle_edges.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/random_scenes.hpp"

namespace lockstep::test::obstacle_pass_twin_test {
namespace {

template <class Texel> bool same_bits(const Texel& a, const Texel& b) {
    return std::memcmp(&a, &b, sizeof(Texel)) == 0;
}

struct Differences {
    int written = 0;
    int coverage = 0;
    int code = 0;
    int depth = 0;
};

struct Images {
    CollisionImage cdt;
    DepthImage depth;
};

Images draw_cpu(const Mesh& obstacles, const FrameParams& params, const Profile& profile = {}) {
    Images images{CollisionImage(params.width, params.height), DepthImage(params.width, params.height, 1.0F)};
    obstacle_pass(obstacles, params, profile, images.cdt, images.depth);
    return images;
}

Images draw_gpu(const Mesh& obstacles, const FrameParams& params) {
    CollisionTexture texture(params.width, params.height, params.switches.cdt_format);
    texture.bind_target();
    ObstaclePass(params.switches, {}).run(MeshBuffer(obstacles), params);
    Images images;
    texture.read(images.cdt);
    texture.read(images.depth);
    return images;
}

/// Draws `obstacles` on both sides and counts the texels that are not the same bits.
Differences compare(const Mesh& obstacles, const FrameParams& params) {
    const Images cpu = draw_cpu(obstacles, params, test::llvmpipe_profile());
    const Images gpu = draw_gpu(obstacles, params);
    Differences found;
    for (std::size_t i = 0; i < cpu.cdt.texels.size(); ++i) {
        const bool drawn = cpu.cdt.texels[i].a != 0.0F;
        found.written += drawn ? 1 : 0;
        if (drawn != (gpu.cdt.texels[i].a != 0.0F))
            ++found.coverage;
        else if (!same_bits(cpu.cdt.texels[i], gpu.cdt.texels[i]))
            ++found.code;
        found.depth += same_bits(cpu.depth.texels[i], gpu.depth.texels[i]) ? 0 : 1;
    }
    return found;
}

void check_same(const Mesh& obstacles, const FrameParams& params, int at_least) {
    const Differences found = compare(obstacles, params);
    CHECK(found.written >= at_least);
    CHECK(found.coverage == 0);
    CHECK(found.code == 0);
    CHECK(found.depth == 0);
}

FrameParams perspective(int width, int height) {
    FrameParams params;
    params.width = width;
    params.height = height;
    params.collision_proj_view =
        view_projection_matrix(Camera{}, static_cast<float>(width) / static_cast<float>(height));
    return params;
}

constexpr std::array formats{CdtFormat::rgba32f, CdtFormat::rgba16f, CdtFormat::rgba8};

FrameParams exact(FrameParams params) {
    params.switches.arithmetic = ArithmeticSwitch::exact;
    return params;
}

/// In exact arithmetic nothing depends on what happens to subnormals, so the reference is held to that too.
void check_everywhere(const Mesh& obstacles, const FrameParams& params, int at_least) {
    check_same(obstacles, params, at_least);
    Profile keeping;
    keeping.flush_subnormals = false;
    const Images flushed = draw_cpu(obstacles, params);
    const Images kept = draw_cpu(obstacles, params, keeping);
    CHECK(std::equal(flushed.cdt.texels.begin(), flushed.cdt.texels.end(), kept.cdt.texels.begin(),
                     same_bits<glm::vec4>));
    CHECK(std::equal(flushed.depth.texels.begin(), flushed.depth.texels.end(), kept.depth.texels.begin(),
                     same_bits<float>));
}

/// The exact preset's promise: the same bits on whatever driver is behind `backend`.
void check_exact(const char* backend) {
    const auto context = test::open_context(backend);
    if (!context)
        return;
    INFO(context->describe().renderer);
    test::RandomScenes scenes(10);
    const FrameParams params = exact(perspective(300, 200));
    FrameParams flat = exact({});
    SECTION("every format") {
        for (const auto& [width, height] : {std::pair{500, 500}, std::pair{333, 250}, std::pair{97, 401}})
            for (const CdtFormat format : formats) {
                FrameParams formatted = exact(perspective(width, height));
                formatted.switches.cdt_format = format;
                INFO(fmt::format("{} x {}, format {}", width, height, static_cast<int>(format)));
                check_everywhere(scenes.triangles(2000, 1.5F, 0.2F), formatted, width * height / 4);
            }
    }
    SECTION("across every clip plane") {
        for (int round = 0; round < 4; ++round) {
            INFO("round " << round);
            check_everywhere(scenes.triangles(300, 4.0F, 1.0F), params, 10000);
            check_everywhere(scenes.triangles(40, 5.0F, 30.0F), params, 10000);
            check_everywhere(scenes.triangles(400, 1.0F, 300.0F), params, 1000);
        }
    }
    SECTION("tiny triangles") {
        check_everywhere(scenes.triangles(30000, 1.0F, 0.01F), params, 5000);
        check_everywhere(scenes.triangles(30000, 1.0F, 0.001F), params, 50);
    }
    SECTION("corners on pixel centres") {
        for (const auto& [width, height] : {std::pair{500, 500}, std::pair{256, 128}})
            for (const int grid : {1, 2, 16, 64, 128, 256}) {
                flat.width = width;
                flat.height = height;
                INFO(fmt::format("{} x {}, corners on multiples of {} / 256", width, height, grid));
                check_everywhere(scenes.triangles_on_grid(2000, grid, width, height), flat, 10000);
            }
    }
    SECTION("slivers, and triangles without area") {
        flat.width = 300;
        flat.height = 200;
        check_everywhere(scenes.slivers(3000), flat, 1000);
        check_everywhere(scenes.slivers(3000), params, 1000);
    }
    SECTION("tiny and huge values") {
        flat.width = 65; // an odd image has centres on the axes, where tiny values cancel to tiny values
        flat.height = 33;
        check_everywhere(scenes.any_magnitude(3000), flat, 100);
        check_everywhere(scenes.any_magnitude(3000), exact(perspective(65, 33)), 100);
    }
}

} // namespace

TEST_CASE("obstacle pass twin: random triangles leave the same bits in every format") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    test::RandomScenes scenes(1);
    for (const auto& [width, height] : {std::pair{500, 500}, std::pair{333, 250}, std::pair{97, 401}})
        for (const CdtFormat format : formats) {
            FrameParams params = perspective(width, height);
            params.switches.cdt_format = format;
            INFO(fmt::format("{} x {}, format {}", width, height, static_cast<int>(format)));
            check_same(scenes.triangles(2000, 1.5F, 0.2F), params, width * height / 4);
        }
}

TEST_CASE("obstacle pass twin: triangles across every clip plane leave the same bits") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    test::RandomScenes scenes(2);
    for (int round = 0; round < 4; ++round) {
        const FrameParams params = perspective(300, 200);
        INFO("round " << round);
        check_same(scenes.triangles(300, 4.0F, 1.0F), params, 10000);
        check_same(scenes.triangles(40, 5.0F, 30.0F), params, 10000);
        check_same(scenes.triangles(400, 1.0F, 300.0F), params, 1000);
    }
}

TEST_CASE("obstacle pass twin: the same bits through EGL") {
    const auto context = test::open_llvmpipe("egl");
    if (!context)
        return;
    test::RandomScenes scenes(8);
    check_same(scenes.triangles(2000, 1.5F, 0.2F), perspective(500, 500), 50000);
    check_same(scenes.triangles(300, 4.0F, 1.0F), perspective(300, 200), 10000);
}

TEST_CASE("obstacle pass twin: tiny triangles leave the same bits") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    test::RandomScenes scenes(3);
    const FrameParams params = perspective(500, 500);
    check_same(scenes.triangles(30000, 1.0F, 0.01F), params, 10000);
    check_same(scenes.triangles(30000, 1.0F, 0.001F), params, 200);
}

TEST_CASE("obstacle pass twin: pixel centres on sides and corners are decided alike") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    test::RandomScenes scenes(4);
    for (const auto& [width, height] : {std::pair{500, 500}, std::pair{256, 128}})
        for (const int grid : {1, 2, 16, 64, 128, 256}) {
            FrameParams params;
            params.width = width;
            params.height = height;
            INFO(fmt::format("{} x {}, corners on multiples of {} / 256", width, height, grid));
            check_same(scenes.triangles_on_grid(2000, grid, width, height), params, 10000);
        }
}

TEST_CASE("obstacle pass twin: vertices leave the same bits in every format") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    test::RandomScenes scenes(5);
    for (const CdtFormat format : formats) {
        FrameParams params = perspective(500, 400);
        params.switches.obstacles_in_cdt = ObstaclesInCdt::vertices;
        params.switches.cdt_format = format;
        INFO("format " << static_cast<int>(format));
        check_same(scenes.triangles(20000, 2.0F, 0.3F), params, 10000);
    }
}

TEST_CASE("obstacle pass twin: vertices a rounding outside the clip volume are not drawn") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    // Snapped, they would lie on the border and belong to the last pixel.
    FrameParams params;
    params.width = params.height = 64;
    params.switches.obstacles_in_cdt = ObstaclesInCdt::vertices;
    const float beyond = 0x1.000002p0F;
    const Mesh outside{{{beyond, 0, 0}, {0, beyond, 0}, {beyond, beyond, 0}}, {0, 1, 2}};
    const Differences found = compare(outside, params);
    CHECK(found.written + found.coverage == 0);
    check_same(Mesh{{{1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {0, 1, 2}}, params, 3);
}

TEST_CASE("obstacle pass twin: off, and no obstacles, leave the image as it was") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    FrameParams params = perspective(64, 64);
    CHECK(compare({}, params).written == 0);
    params.switches.obstacles_in_cdt = ObstaclesInCdt::off;
    const Differences found = compare(test::RandomScenes(6).triangles(50, 1.0F, 1.0F), params);
    CHECK(found.written + found.coverage + found.code + found.depth == 0);
}

TEST_CASE("obstacle pass twin: a fill rule the driver does not have is found, at sides only") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    FrameParams params;
    params.width = params.height = 128;
    const Mesh obstacles = test::RandomScenes(7).triangles_on_grid(200, 128, 128, 128);
    Profile other;
    other.raster.lower_edge_in = false;
    const Images cpu = draw_cpu(obstacles, params, other);
    const Images gpu = draw_gpu(obstacles, params);
    int differ = 0;
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x)
            if (!same_bits(cpu.cdt.at(x, y), gpu.cdt.at(x, y))) {
                ++differ;
                CHECK(obstacle_edge_distance(obstacles, params, Profile{}, x, y) <= 1.0);
            }
    CHECK(differ > 20);
}

TEST_CASE("obstacle pass twin: exact arithmetic leaves the same bits, on OSMesa") { check_exact("osmesa"); }

TEST_CASE("obstacle pass twin: exact arithmetic leaves the same bits, on EGL") { check_exact("egl"); }

TEST_CASE("obstacle pass twin: exact arithmetic leaves the same bits, on EGL device 0", "[.device]") {
    check_exact("egl-device:0");
}

TEST_CASE("obstacle pass twin: another driver differs in edge ties, and by no more than its division") {
    const auto context = test::open_context("egl-device:0");
    if (!context)
        return;
    const FrameParams params = perspective(500, 500);
    const Mesh obstacles = test::RandomScenes(9).triangles(3000, 1.5F, 0.2F);
    // Corners lie within 1.7 of the origin and 0.4 of each other.
    const float bound = interpolation_bound(1.7F, 1.3F, 1.3F);
    const Images cpu = draw_cpu(obstacles, params, test::llvmpipe_profile());
    const Images gpu = draw_gpu(obstacles, params);
    int rounding = 0;
    int ties = 0;
    int unexplained = 0;
    for (int y = 0; y < params.height; ++y)
        for (int x = 0; x < params.width; ++x) {
            const glm::vec4 here = cpu.cdt.at(x, y);
            const glm::vec4 there = gpu.cdt.at(x, y);
            if (same_bits(here, there))
                continue;
            const glm::vec3 apart = glm::abs(glm::vec3(here) - glm::vec3(there));
            if (here.a == there.a && std::max({apart.x, apart.y, apart.z}) <= bound)
                ++rounding;
            else if (obstacle_edge_distance(obstacles, params, Profile{}, x, y) <= 1.0)
                ++ties;
            else
                ++unexplained;
        }
    INFO(context->describe().renderer << ": " << rounding << " within the bound, " << ties << " edge ties");
    CHECK(unexplained == 0);
    CHECK(ties < 500);
}

} // namespace lockstep::test::obstacle_pass_twin_test
