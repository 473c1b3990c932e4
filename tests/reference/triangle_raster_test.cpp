#include "reference/triangle_raster.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "reference/model/image.hpp"

namespace lockstep::test::triangle_raster_test {
namespace {

using Pixels = std::set<std::pair<int, int>>;

constexpr int one = 256; // sub-pixel units a pixel

RasterTriangle triangle(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) { return {{a, b, c}, 0}; }

Pixels covered(const RasterTriangle& t, const RasterRules& rules = {}, PixelRect area = {0, 0, 64, 64}) {
    Pixels pixels;
    for_each_pixel(t, rules, area, [&](int x, int y) {
        INFO("pixel " << x << ' ' << y);
        CHECK(pixels.emplace(x, y).second);
    });
    return pixels;
}

bool inside_clip_volume(glm::vec4 v) {
    const float slack = 1e-5F * std::abs(v.w) + 1e-6F;
    return std::abs(v.x) <= v.w + slack && std::abs(v.y) <= v.w + slack && std::abs(v.z) <= v.w + slack;
}

} // namespace

TEST_CASE("triangle raster: covers the pixels whose centres lie inside", "[triangle_raster]") {
    // Corners half a pixel below and left of pixel 1, so the legs run between pixel centres.
    const RasterTriangle t = triangle({128, 128}, {128 + 4 * one, 128}, {128, 128 + 4 * one});
    CHECK(covered(t) == Pixels{{1, 1}, {2, 1}, {3, 1}, {1, 2}, {2, 2}, {1, 3}});
}

TEST_CASE("triangle raster: a centre on a side belongs to a left or lower side", "[triangle_raster]") {
    const RasterTriangle lower_left = triangle({0, 0}, {2 * one, 0}, {0, 2 * one});
    const RasterTriangle upper_right = triangle({2 * one, 0}, {2 * one, 2 * one}, {0, 2 * one});
    SECTION("by default") {
        CHECK(covered(lower_left) == Pixels{{0, 0}, {1, 0}, {0, 1}});
        CHECK(covered(upper_right) == Pixels{{1, 1}});
    }
    SECTION("right and upper, if the rules say so") {
        RasterRules rules;
        rules.left_edge_in = false;
        rules.lower_edge_in = false;
        CHECK(covered(lower_left, rules) == Pixels{{1, 1}});
        CHECK(covered(upper_right, rules) == Pixels{{2, 1}, {1, 2}, {2, 2}});
    }
    SECTION("left and upper") {
        RasterRules rules;
        rules.lower_edge_in = false;
        CHECK(covered(lower_left, rules) == Pixels{{0, 1}});
        CHECK(covered(upper_right, rules) == Pixels{{1, 1}, {0, 2}, {1, 2}});
    }
}

TEST_CASE("triangle raster: triangles that share sides draw every pixel exactly once", "[triangle_raster]") {
    std::mt19937 random(7);
    constexpr int cells = 6;
    for (int round = 0; round < 50; ++round) {
        // A square of 24 x 24 pixels, its inner mesh points jittered, every other round onto pixel centres.
        std::uniform_int_distribution<int> jitter(-one, one);
        glm::ivec2 points[cells + 1][cells + 1];
        for (int j = 0; j <= cells; ++j)
            for (int i = 0; i <= cells; ++i) {
                const bool inner = i > 0 && j > 0 && i < cells && j < cells;
                glm::ivec2 offset = inner ? glm::ivec2(jitter(random), jitter(random)) : glm::ivec2(0);
                if (round % 2 == 1)
                    offset = (offset / one) * one;
                points[j][i] = glm::ivec2(4 * i * one, 4 * j * one) + offset;
            }
        Image<int> count(32, 32);
        const auto draw = [&](glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
            for_each_pixel(triangle(a, b, c), {}, {0, 0, 32, 32}, [&](int x, int y) { ++count.at(x, y); });
        };
        for (int j = 0; j < cells; ++j)
            for (int i = 0; i < cells; ++i) {
                draw(points[j][i], points[j][i + 1], points[j + 1][i]);
                draw(points[j][i + 1], points[j + 1][i + 1], points[j + 1][i]);
            }
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) {
                INFO("round " << round << " pixel " << x << ' ' << y);
                CHECK(count.at(x, y) == (x < 24 && y < 24 ? 1 : 0));
            }
    }
}

TEST_CASE("triangle raster: translation by whole pixels moves the pixels with it", "[triangle_raster]") {
    std::mt19937 random(11);
    std::uniform_int_distribution<int> coordinate(0, 20 * one);
    for (int round = 0; round < 200; ++round) {
        RasterTriangle t;
        for (glm::ivec2& corner : t.corners)
            corner = {coordinate(random), coordinate(random)};
        const glm::ivec2 a = t.corners[1] - t.corners[0];
        const glm::ivec2 b = t.corners[2] - t.corners[0];
        if (a.x * b.y - a.y * b.x <= 0)
            continue;
        RasterTriangle moved = t;
        for (glm::ivec2& corner : moved.corners)
            corner += glm::ivec2(17 * one, 5 * one);
        Pixels expected;
        for (const auto& [x, y] : covered(t))
            expected.emplace(x + 17, y + 5);
        CHECK(covered(moved) == expected);
    }
}

TEST_CASE("triangle raster: only pixels of the area are visited", "[triangle_raster]") {
    const RasterTriangle t = triangle({-9 * one, -9 * one}, {40 * one, -9 * one}, {-9 * one, 40 * one});
    CHECK(covered(t, {}, {2, 3, 4, 5}) == Pixels{{2, 3}, {3, 3}, {2, 4}, {3, 4}});
    CHECK(covered(t, {}, {38, 38, 40, 40}).empty());
}

TEST_CASE("triangle raster: a triangle inside the clip volume stays as it is", "[triangle_raster][clip]") {
    const std::array<glm::vec4, 3> t{glm::vec4(-1, -1, 0, 1), glm::vec4(1, -1, 0, 1), glm::vec4(0, 2, 1, 2)};
    const ClipPolygon polygon = clip_triangle(t);
    REQUIRE(polygon.size == 3);
    CHECK(polygon.corners[0] == t[0]);
    CHECK(polygon.corners[2] == t[2]);
}

TEST_CASE("triangle raster: the near plane cuts off the corner behind it", "[triangle_raster][clip]") {
    // z = -w is the plane; the third corner lies behind the camera.
    const ClipPolygon polygon =
        clip_triangle({glm::vec4(-1, 0, 0, 2), glm::vec4(1, 0, 0, 2), glm::vec4(0, 0.5F, -2, 0)});
    REQUIRE(polygon.size == 4);
    CHECK(polygon.corners[0] == glm::vec4(-1, 0, 0, 2));
    CHECK(polygon.corners[1] == glm::vec4(1, 0, 0, 2));
    CHECK(polygon.corners[2] == glm::vec4(0.5F, 0.25F, -1, 1));
    CHECK(polygon.corners[3] == glm::vec4(-0.5F, 0.25F, -1, 1));
}

TEST_CASE("triangle raster: nothing is left behind the camera or beyond one plane", "[triangle_raster][clip]") {
    CHECK(clip_triangle({glm::vec4(-1, 0, 0, -2), glm::vec4(1, 0, 0, -2), glm::vec4(0, 1, 0, -2)}).size == 0);
    CHECK(clip_triangle({glm::vec4(3, 0, 0, 2), glm::vec4(5, 0, 0, 2), glm::vec4(4, 1, 0, 2)}).size == 0);
}

TEST_CASE("triangle raster: a corner that is not finite drops the triangle", "[triangle_raster][clip]") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float bad : {nan, infinity, -infinity})
        CHECK(clip_triangle({glm::vec4(-1, 0, 0, 2), glm::vec4(1, 0, 0, 2), glm::vec4(bad, 0.5F, 0, 2)}).size == 0);
}

TEST_CASE("triangle raster: clipped polygons lie inside, and at most nine corners are left",
          "[triangle_raster][clip]") {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> coordinate(-3.0F, 3.0F);
    std::size_t most = 0;
    for (int round = 0; round < 20000; ++round) {
        std::array<glm::vec4, 3> t{};
        for (glm::vec4& corner : t)
            corner = {coordinate(random), coordinate(random), coordinate(random), coordinate(random) + 1.0F};
        const ClipPolygon polygon = clip_triangle(t);
        most = std::max(most, polygon.size);
        CHECK((polygon.size == 0 || polygon.size >= 3));
        for (std::size_t i = 0; i < polygon.size; ++i)
            CHECK(inside_clip_volume(polygon.corners[i]));
    }
    CHECK(most >= 7);
    CHECK(most <= 9);
}

TEST_CASE("triangle raster: triangles that share a side are cut at the same point", "[triangle_raster][clip]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> inner(-0.9F, 0.9F);
    std::uniform_real_distribution<float> outer(1.1F, 9.0F);
    for (int round = 0; round < 1000; ++round) {
        const glm::vec4 in(inner(random), inner(random), inner(random), 1.0F);
        const glm::vec4 out(outer(random), inner(random), inner(random), 1.0F);
        const glm::vec4 third(-0.5F, 0.0F, 0.0F, 1.0F);
        const ClipPolygon there = clip_triangle({in, out, third});
        const ClipPolygon back = clip_triangle({out, in, third});
        REQUIRE(there.size == 4);
        REQUIRE(back.size == 4);
        CHECK(there.corners[1] == back.corners[0]);
    }
}

TEST_CASE("triangle raster: assembling snaps, turns counterclockwise and drops empty triangles", "[triangle_raster]") {
    // An 8 x 8 viewport: a quarter of clip space is one pixel.
    const std::vector<glm::vec4> clip{{-1, -1, 0, 1}, {-0.5F, -1, 0, 1}, {-1, -0.5F, 0, 1}, {0, -1, 0, 1}};
    const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 1, 0, 1, 3, 0, 0, 1};
    const auto triangles = assemble_triangles(clip, indices, 8, 8, {});
    REQUIRE(triangles.size() == 2);
    const std::array<glm::ivec2, 3> expected{glm::ivec2(-128, -128), glm::ivec2(384, -128), glm::ivec2(-128, 384)};
    CHECK(triangles[0].corners == expected);
    CHECK(triangles[1].corners == expected);
    CHECK(triangles[1].primitive == 1);
}

TEST_CASE("triangle raster: a clipped triangle becomes a fan of its own number", "[triangle_raster]") {
    const std::vector<glm::vec4> clip{{0, 0, 0, 1}, {9, 0, 0, 1}, {0, 9, 0, 1}};
    const auto triangles = assemble_triangles(clip, std::vector<std::uint32_t>{0, 1, 2}, 8, 8, {});
    REQUIRE(triangles.size() >= 2);
    Pixels all;
    for (const RasterTriangle& t : triangles) {
        CHECK(t.primitive == 0);
        for (const auto& pixel : covered(t)) {
            CHECK(all.insert(pixel).second);
            CHECK((pixel.first >= 4 && pixel.first < 8 && pixel.second >= 4 && pixel.second < 8));
        }
    }
    CHECK(all.size() == 16);
}

TEST_CASE("triangle raster: side distance is measured to the segment", "[triangle_raster]") {
    const RasterTriangle t = triangle({0, 0}, {4 * one, 0}, {0, 4 * one});
    CHECK(nearest_side(t, 2, 0, {}).distance == 0.0);
    CHECK(nearest_side(t, 1, 1, {}).distance == Approx(256.0));
    CHECK(nearest_side(t, 6, 0, {}).distance == Approx(512.0));
    CHECK(nearest_side(t, 4, 4, {}).distance == Approx(4 * 256 / std::sqrt(2.0)));
}

} // namespace lockstep::test::triangle_raster_test
