#include "reference/collision/obstacle_pass.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <random>
#include <set>

#include <omp.h>

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "reference/collision/simulation.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/state_hash.hpp"
#include "tests/collision/obstacle_edges.hpp"

namespace lockstep::test::obstacle_pass_test {
namespace {

/// An orthographic view: world x, y in -1..1 fill the image, world z becomes clip z.
FrameParams flat_view(int size) {
    FrameParams params;
    params.width = params.height = size;
    return params;
}

FrameParams perspective_view(int width, int height) {
    FrameParams params;
    params.width = width;
    params.height = height;
    params.collision_proj_view =
        view_projection_matrix(Camera{}, static_cast<float>(width) / static_cast<float>(height));
    return params;
}

struct Drawn {
    CollisionImage cdt;
    DepthImage depth;
    explicit Drawn(const FrameParams& params)
        : cdt(params.width, params.height), depth(params.width, params.height, 1.0F) {}
    Drawn(const Mesh& obstacles, const FrameParams& params) : Drawn(params) {
        obstacle_pass(obstacles, params, Profile{}, cdt, depth);
    }
};

Mesh mesh(std::vector<glm::vec3> positions) {
    Mesh result{std::move(positions), {}};
    result.indices.resize(result.positions.size());
    std::iota(result.indices.begin(), result.indices.end(), 0U);
    return result;
}

Mesh random_triangles(unsigned seed, int count, float size) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-1.5F, 1.5F);
    std::uniform_real_distribution<float> offset(-size, size);
    std::vector<glm::vec3> positions;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 middle(place(random), place(random), place(random));
        for (int corner = 0; corner < 3; ++corner)
            positions.push_back(middle + glm::vec3(offset(random), offset(random), offset(random)));
    }
    return mesh(std::move(positions));
}

} // namespace

TEST_CASE("obstacle pass: a triangle stores the world position at each covered centre", "[obstacle_pass]") {
    // Image of 4 x 4: x, y of texel (0, 0)'s centre are -0.75; the hypotenuse passes outside the centres of x + y = 2.
    const Drawn drawn(mesh({{-1, -1, 0.5F}, {0.75F, -1, 0.5F}, {-1, 0.75F, 0.5F}}), flat_view(4));
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            INFO(x << ' ' << y);
            if (x + y > 2) {
                CHECK(drawn.cdt.at(x, y) == glm::vec4(0.0F));
                CHECK(drawn.depth.at(x, y) == 1.0F);
                continue;
            }
            const float centre_x = 0.5F * static_cast<float>(x) - 0.75F;
            const float centre_y = 0.5F * static_cast<float>(y) - 0.75F;
            CHECK(drawn.cdt.at(x, y).x == Approx(centre_x).margin(1e-6));
            CHECK(drawn.cdt.at(x, y).y == Approx(centre_y).margin(1e-6));
            CHECK(drawn.cdt.at(x, y).z == 0.5F);
            CHECK(drawn.cdt.at(x, y).a == 1.0F);
            CHECK(drawn.depth.at(x, y) == 0.75F);
        }
}

TEST_CASE("obstacle pass: the nearer triangle wins, and the first of two equally near", "[obstacle_pass]") {
    const std::vector<glm::vec3> far{{-1, -1, 0.5F}, {3, -1, 0.5F}, {-1, 3, 0.5F}};
    const std::vector<glm::vec3> near{{-1, -1, 0.25F}, {3, -1, 0.25F}, {-1, 3, 0.25F}};
    const std::vector<glm::vec3> near_too{{-1, -1, 0.25F}, {1, -1, 0.25F}, {-1, 1, 0.25F}};
    const auto both = [](std::vector<glm::vec3> a, const std::vector<glm::vec3>& b) {
        a.insert(a.end(), b.begin(), b.end());
        return mesh(std::move(a));
    };
    const FrameParams params = flat_view(8);
    const Drawn near_alone(mesh(near), params);
    CHECK(Drawn(both(far, near), params).cdt.texels == near_alone.cdt.texels);
    CHECK(Drawn(both(near, far), params).cdt.texels == near_alone.cdt.texels);
    CHECK(Drawn(both(near, near_too), params).cdt.texels == near_alone.cdt.texels);
}

TEST_CASE("obstacle pass: in exact arithmetic both neighbours have their shared side, and the first keeps it",
          "[obstacle_pass]") {
    // The diagonal of the square passes through the centres of x + y = 7.
    FrameParams params = flat_view(8);
    params.switches.arithmetic = ArithmeticSwitch::exact;
    const std::vector<glm::vec3> lower{{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}};
    const std::vector<glm::vec3> upper{{1, 1, 0}, {-1, 1, 0}, {1, -1, 0}};
    const auto count = [](const Drawn& drawn) {
        return std::count_if(drawn.cdt.texels.begin(), drawn.cdt.texels.end(), [](glm::vec4 t) { return t.a == 1.0F; });
    };
    CHECK(count(Drawn(mesh(lower), params)) == 36);
    CHECK(count(Drawn(mesh(upper), params)) == 36);
    std::vector<glm::vec3> square = lower;
    square.insert(square.end(), upper.begin(), upper.end());
    const Drawn both(mesh(square), params);
    CHECK(count(both) == 64);
    for (int x = 0; x < 8; ++x)
        CHECK(both.cdt.at(x, 7 - x) == Drawn(mesh(lower), params).cdt.at(x, 7 - x));
}

TEST_CASE("obstacle pass: in exact arithmetic fans leave no gap", "[obstacle_pass]") {
    // Round a centre, on a pixel's or beside it, corners of any depth between the planes; every other round the corners
    // lie on pixel centres too. A closed fan covers exactly the pixels inside its rim.
    std::mt19937 random(12);
    FrameParams params = perspective_view(64, 64);
    params.switches.arithmetic = ArithmeticSwitch::exact;
    const glm::mat4 to_world = glm::inverse(params.collision_proj_view);
    std::uniform_real_distribution<float> radius(4.0F, 24.0F);
    std::uniform_real_distribution<float> depth(0.5F, 0.95F);
    std::uniform_int_distribution<int> corners(3, 24);
    const auto world = [&](glm::vec2 pixels) {
        const glm::vec4 p = to_world * glm::vec4(pixels / 32.0F - 1.0F, depth(random), 1.0F);
        return glm::vec3(p) / p.w;
    };
    for (int round = 0; round < 80; ++round) {
        const bool on_centres = round % 2 == 0;
        const glm::vec2 middle = on_centres ? glm::vec2(32.5F, 31.5F) : glm::vec2(32.0F, 31.87F);
        const int count = corners(random);
        Mesh fan{{world(middle)}, {}};
        std::vector<glm::vec2> rim;
        for (int i = 0; i < count; ++i) {
            const float angle = 6.2831853F * static_cast<float>(i) / static_cast<float>(count);
            glm::vec2 p = middle + radius(random) * glm::vec2(std::cos(angle), std::sin(angle));
            p = on_centres ? glm::floor(p) + 0.5F : p;
            rim.push_back(p);
            fan.positions.push_back(world(p));
            const auto here = static_cast<std::uint32_t>(i);
            const auto next = static_cast<std::uint32_t>((i + 1) % count);
            fan.indices.insert(fan.indices.end(), {0, 1 + here, 1 + next});
            if (i % 3 == 0)
                std::swap(fan.indices.back(), fan.indices[fan.indices.size() - 3]);
        }
        const Drawn drawn(fan, params);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const glm::dvec2 p = glm::dvec2(x + 0.5, y + 0.5) - glm::dvec2(middle);
                // The sector p lies in, and how far inside its rim, relative to the sector's area.
                double inside = -1.0;
                for (std::size_t i = 0; i < rim.size(); ++i) {
                    const glm::dvec2 a = glm::dvec2(rim[i]) - glm::dvec2(middle);
                    const glm::dvec2 b = glm::dvec2(rim[(i + 1) % rim.size()]) - glm::dvec2(middle);
                    const double area = a.x * b.y - b.x * a.y;
                    const double second = (p.x * b.y - b.x * p.y) / area;
                    const double third = (a.x * p.y - p.x * a.y) / area;
                    if (second > -1e-9 && third > -1e-9)
                        inside = std::max(inside, 1.0 - second - third);
                }
                INFO("round " << round << " pixel " << x << ' ' << y << " inside by " << inside);
                if (std::abs(inside) > 1e-4)
                    CHECK((drawn.cdt.at(x, y).a != 0.0F) == (inside > 0.0));
            }
    }
}

TEST_CASE("obstacle pass: exact and plain arithmetic differ in texels on sides only", "[obstacle_pass]") {
    const Mesh obstacles = random_triangles(31, 60, 0.6F);
    FrameParams params = perspective_view(120, 90);
    const Drawn plain(obstacles, params);
    params.switches.arithmetic = ArithmeticSwitch::exact;
    const Drawn exact(obstacles, params);
    for (int y = 0; y < params.height; ++y)
        for (int x = 0; x < params.width; ++x) {
            INFO(x << ' ' << y);
            if (glm::distance(plain.cdt.at(x, y), exact.cdt.at(x, y)) > 1e-4F)
                CHECK(obstacle_edge_distance(obstacles, params, Profile{}, x, y) <= 1.5);
        }
}

TEST_CASE("obstacle pass: what was drawn before takes part in the depth test", "[obstacle_pass]") {
    const FrameParams params = flat_view(4);
    Drawn drawn(params);
    drawn.depth.at(1, 1) = 0.5F;
    drawn.cdt.at(1, 1) = glm::vec4(7.0F);
    obstacle_pass(mesh({{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}}), params, Profile{}, drawn.cdt, drawn.depth);
    CHECK(drawn.cdt.at(1, 1) == glm::vec4(7.0F)); // depth 0.5 is not less than 0.5
    CHECK(drawn.cdt.at(2, 1).a == 1.0F);
}

TEST_CASE("obstacle pass: both faces are drawn", "[obstacle_pass]") {
    const FrameParams params = flat_view(8);
    const Drawn front(mesh({{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}}), params);
    const Drawn back(mesh({{-1, -1, 0}, {-1, 1, 0}, {1, -1, 0}}), params);
    CHECK(std::count_if(front.cdt.texels.begin(), front.cdt.texels.end(), [](glm::vec4 t) { return t.a == 1.0F; }) >
          20);
    CHECK(front.depth.texels == back.depth.texels);
}

TEST_CASE("obstacle pass: a plane that passes under the camera is cut at the near plane", "[obstacle_pass]") {
    // The camera looks down -z from (0, 0, 3); the floor y = -0.1 reaches behind it.
    const FrameParams params = perspective_view(64, 64);
    const Drawn drawn(mesh({{-50, -0.1F, 50}, {50, -0.1F, 50}, {0, -0.1F, -100}}), params);
    for (int x = 0; x < 64; ++x) {
        CHECK(drawn.cdt.at(x, 40).a == 0.0F); // above the horizon
        CHECK(drawn.cdt.at(x, 8).a == 1.0F);
        CHECK(drawn.cdt.at(x, 8).y == Approx(-0.1F).margin(1e-5));
        CHECK(drawn.cdt.at(x, 8).z < 3.0F);
    }
}

TEST_CASE("obstacle pass: nothing behind the camera and nothing without area is drawn", "[obstacle_pass]") {
    const FrameParams params = perspective_view(32, 32);
    const std::vector<glm::vec4> empty(32 * 32, glm::vec4(0.0F));
    CHECK(Drawn(mesh({{-1, -1, 4}, {1, -1, 4}, {0, 1, 4}}), params).cdt.texels == empty);
    CHECK(Drawn(mesh({{-1, -1, 0}, {0, 0, 0}, {1, 1, 0}}), params).cdt.texels == empty);
    CHECK(Drawn(mesh({{0, 0, 0}, {0, 0, 0}, {1, 1, 0}}), params).cdt.texels == empty);
    CHECK(Drawn(Mesh{}, params).cdt.texels == empty);
}

TEST_CASE("obstacle pass: stored positions project back into their texel", "[obstacle_pass]") {
    const FrameParams params = perspective_view(100, 80);
    const Drawn drawn(random_triangles(4, 300, 0.3F), params);
    int written = 0;
    int beside = 0; // covered by the snapped triangle only: the nearest share inside lies a little beside the centre
    for (int y = 0; y < params.height; ++y)
        for (int x = 0; x < params.width; ++x) {
            const glm::vec4 stored = drawn.cdt.at(x, y);
            if (stored.a == 0.0F)
                continue;
            ++written;
            const glm::vec4 clip = params.collision_proj_view * glm::vec4(glm::vec3(stored), 1.0F);
            const float off_x = (clip.x / clip.w + 1.0F) * 50.0F - (static_cast<float>(x) + 0.5F);
            const float off_y = (clip.y / clip.w + 1.0F) * 40.0F - (static_cast<float>(y) + 0.5F);
            beside += std::max(std::abs(off_x), std::abs(off_y)) < 0.001F ? 0 : 1;
            INFO(x << ' ' << y);
            CHECK(drawn.depth.at(x, y) == Approx(clip.z / clip.w * 0.5F + 0.5F).margin(1e-5));
        }
    CHECK(beside < written / 100);
    CHECK(written > 3000);
}

TEST_CASE("obstacle pass: disjoint triangles may come in any order", "[obstacle_pass]") {
    // Triangles of one layer each, so no two fragments have one depth.
    Mesh obstacles = random_triangles(9, 200, 0.2F);
    const FrameParams params = perspective_view(120, 120);
    const Drawn before(obstacles, params);
    std::vector<std::size_t> order(obstacles.triangle_count());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
    Mesh shuffled{obstacles.positions, {}};
    for (const std::size_t t : order)
        shuffled.indices.insert(shuffled.indices.end(), obstacles.indices.begin() + static_cast<std::ptrdiff_t>(3 * t),
                                obstacles.indices.begin() + static_cast<std::ptrdiff_t>(3 * t + 3));
    CHECK(Drawn(shuffled, params).cdt.texels == before.cdt.texels);
}

TEST_CASE("obstacle pass: the bits do not depend on the number of threads", "[obstacle_pass]") {
    const Mesh obstacles = random_triangles(21, 500, 0.5F);
    const FrameParams params = perspective_view(130, 90);
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const auto alone = state_hash(Drawn(obstacles, params).cdt);
    for (const int count : {2, 4}) {
        omp_set_num_threads(count);
        CHECK(state_hash(Drawn(obstacles, params).cdt) == alone);
    }
    omp_set_num_threads(threads);
}

TEST_CASE("obstacle pass: vertices draw one texel each, nearest first", "[obstacle_pass]") {
    FrameParams params = flat_view(4);
    params.switches.obstacles_in_cdt = ObstaclesInCdt::vertices;
    const Drawn drawn(mesh({{-0.75F, 0.25F, 0.5F}, {0.75F, 0.75F, 0.5F}, {0.7F, 0.7F, 0.25F}, {0, 0, 2}}), params);
    CHECK(drawn.cdt.at(0, 2) == glm::vec4(-0.75F, 0.25F, 0.5F, 1.0F));
    CHECK(drawn.cdt.at(3, 3) == glm::vec4(0.7F, 0.7F, 0.25F, 1.0F));
    CHECK(std::count_if(drawn.cdt.texels.begin(), drawn.cdt.texels.end(), [](glm::vec4 t) { return t.a != 0.0F; }) ==
          2);
}

TEST_CASE("obstacle pass: off draws nothing", "[obstacle_pass]") {
    FrameParams params = flat_view(4);
    params.switches.obstacles_in_cdt = ObstaclesInCdt::off;
    const Drawn drawn(mesh({{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}}), params);
    CHECK(drawn.cdt.texels == std::vector<glm::vec4>(16, glm::vec4(0.0F)));
}

TEST_CASE("obstacle pass: rgba8 and rgba16f store codes", "[obstacle_pass]") {
    FrameParams params = flat_view(2);
    const Mesh obstacles = mesh({{-1, -1, 0.1F}, {3, -1, 0.1F}, {-1, 3, 0.1F}});
    params.switches.cdt_format = CdtFormat::rgba8;
    const glm::vec4 code = Drawn(obstacles, params).cdt.at(1, 0); // position (0.5, -0.5, 0.1) in the box -1..1
    CHECK(code == glm::vec4(191.0F, 64.0F, 140.0F, 255.0F));
    params.switches.cdt_format = CdtFormat::rgba16f;
    CHECK(Drawn(obstacles, params).cdt.at(1, 0) == glm::vec4(0.5F, -0.5F, 0x1.998p-4F, 1.0F));
}

TEST_CASE("obstacle pass: edge distance is the nearest side of all triangles", "[obstacle_pass]") {
    const Mesh obstacles = mesh({{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {0, 0, 0}, {0.5F, 0, 0}, {0, 0.5F, 0}});
    const FrameParams params = flat_view(8);
    CHECK(obstacle_edge_distance(obstacles, params, Profile{}, 0, 0) == Approx(128.0));
    CHECK(obstacle_edge_distance(obstacles, params, Profile{}, 4, 4) == Approx(128.0));
    CHECK(obstacle_edge_distance(obstacles, params, Profile{}, 3, 4) == 0.0); // on the first one's hypotenuse
    CHECK(obstacle_edge_distance(Mesh{}, params, Profile{}, 0, 0) == HUGE_VAL);
}

TEST_CASE("obstacle pass: a simulation that keeps the drawn obstacles draws as one that never did", "[obstacle_pass]") {
    Scene scene;
    scene.obstacles = random_triangles(7, 60, 0.6F);
    scene.width = 60;
    scene.height = 50;
    scene.start.resize(40);
    for (std::size_t i = 0; i < scene.start.size(); ++i)
        scene.start.position[i] = glm::vec3(-0.8F + 0.04F * static_cast<float>(i), 0.1F, 0.2F);
    const CollisionImage empty(scene.width, scene.height);
    const FrameParams stands = perspective_view(60, 50);
    FrameParams moved = stands, off = stands, box = stands;
    moved.collision_proj_view[3][0] += 0.1F;
    off.switches.obstacles_in_cdt = ObstaclesInCdt::off;
    box.switches.cdt_format = CdtFormat::rgba8;
    box.cdt_box.max += glm::vec3(1.0F);
    ReferenceSimulation keeps(scene, Profile{});
    std::set<std::uint64_t> seen;
    const std::initializer_list<const FrameParams*> frames{&stands, &stands, &stands, &moved,  &stands, &moved,
                                                           &moved,  &off,    &off,    &stands, &stands, &box,
                                                           &box,    &moved,  &moved,  &stands};
    for (const FrameParams* params : frames) {
        ReferenceSimulation fresh(scene, Profile{});
        keeps.step_from(scene.start, empty, *params);
        fresh.step_from(scene.start, empty, *params);
        const std::uint64_t hash = state_hash(keeps.particles(), keeps.cdt());
        CHECK(hash == state_hash(fresh.particles(), fresh.cdt()));
        seen.insert(hash);
    }
    CHECK(seen.size() == 4);
}

} // namespace lockstep::test::obstacle_pass_test
