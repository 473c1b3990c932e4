#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include "reference/model/lifecycle/bounding_polygon.hpp"

namespace lockstep::test::bounding_polygon_test {

using namespace lockstep::lifecycle;

namespace {

using Point = glm::dvec2;
using Points = std::vector<Point>;

double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }

/// A line as a point and a direction, the inside to its left.
struct Line {
    Point at, way;
};

std::optional<Point> meeting(const Line& a, const Line& b) {
    const double turn = cross(a.way, b.way);
    if (!(turn > 1e-12))
        return {};
    return a.at + a.way * (cross(b.at - a.at, b.way) / turn);
}

/// Of what the lines enclose in their order, if that is a polygon around the hull.
std::optional<double> enclosed(const std::vector<Line>& lines, const Points& hull) {
    Points corners;
    for (std::size_t s = 0; s < lines.size(); ++s) {
        const auto corner = meeting(lines[s], lines[(s + 1) % lines.size()]);
        if (!corner)
            return {};
        corners.push_back(*corner);
    }
    for (std::size_t s = 0; s < lines.size(); ++s)
        for (const Point p : hull)
            if (cross(lines[s].way, p - lines[s].at) < -1e-7 * glm::length(lines[s].way))
                return {};
    const double found = area(corners);
    return found > 0.0 ? std::optional(found) : std::nullopt;
}

/// Every choice of flush sides, the last side flush or halved at any vertex.
double brute_force(const Points& hull, std::size_t k) {
    const std::size_t n = hull.size();
    const auto line = [&](std::size_t e) { return Line{hull[e], hull[(e + 1) % n] - hull[e]}; };
    double least = HUGE_VAL;
    const auto offer = [&](const std::vector<Line>& lines) {
        if (const auto found = enclosed(lines, hull))
            least = std::min(least, *found);
    };
    std::vector<std::size_t> chosen;
    const std::function<void(std::size_t, std::size_t)> choose = [&](std::size_t from, std::size_t left) {
        if (left > 0) {
            for (std::size_t e = from; e < n; ++e) {
                chosen.push_back(e);
                choose(e + 1, left - 1);
                chosen.pop_back();
            }
            return;
        }
        std::vector<Line> lines;
        for (const std::size_t e : chosen)
            lines.push_back(line(e));
        offer(lines);
        if (chosen.size() + 1 != k)
            return;
        for (std::size_t gap = 0; gap < chosen.size(); ++gap) { // the side between this one and the next
            const Line j = lines[gap], i = lines[(gap + 1) % lines.size()];
            for (const Point p : hull) {
                const double turn = cross(j.way, i.way);
                if (std::abs(turn) < 1e-12)
                    continue;
                const Point mirrored = p * 2.0 - i.at;
                const Point start = j.at + j.way * (cross(mirrored - j.at, i.way) / turn);
                std::vector<Line> with = lines;
                with.insert(with.begin() + static_cast<std::ptrdiff_t>(gap) + 1, Line{start, (p - start) * 2.0});
                offer(with);
            }
        }
    };
    choose(0, k - 1);
    choose(0, k);
    return least;
}

Points texels(const std::vector<LatticePoint>& hull) {
    Points all;
    for (const LatticePoint p : hull)
        all.emplace_back(double(p.x), double(p.y));
    return all;
}

/// A blob of alpha in `size` squared texels.
std::vector<std::uint8_t> disc(int size, double radius) {
    std::vector<std::uint8_t> alpha;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            alpha.push_back(std::hypot(x + 0.5 - size / 2.0, y + 0.5 - size / 2.0) < radius ? 255 : 0);
    return alpha;
}

} // namespace

TEST_CASE("bounding polygon: the specification's hull, from three to eight corners") {
    const Points hull{{18, 45}, {43, 24}, {54, 41}, {56, 57}, {49, 64}, {35, 69}, {24, 63}, {19, 54}};
    CHECK(area(hull) == 1104.5);
    const double right[] = {1566.00299, 1765487877.0 / 1403545.0, 1166.63800, 1134.81638, 1117.85484};
    for (std::size_t k = 3; k <= 7; ++k) {
        const auto found = least_polygon(hull, k);
        REQUIRE(found);
        CHECK(found->area == Approx(right[k - 3]).epsilon(k == 4 ? 1e-13 : 1e-8));
        CHECK(area(found->corners) == Approx(found->area).epsilon(1e-12));
        CHECK(found->corners.size() == k);
    }
    const auto four = least_polygon(hull, 4);
    CHECK(four->flush == std::vector<std::size_t>{4, 6, 0});
    CHECK(four->pivot == std::size_t{2});
    const Points corners{{28.6026, 71.2848}, {15.2727, 47.2909}, {43.5917, 23.5030}, {64.4083, 58.4970}};
    for (std::size_t c = 0; c < 4; ++c)
        CHECK(glm::distance(four->corners[c], corners[c]) < 1e-4);
    CHECK(least_polygon(hull, 8)->area == 1104.5);
    CHECK_FALSE(least_polygon(hull, 2));
}

TEST_CASE("bounding polygon: no choice of sides is smaller, on random hulls") {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> place(0, 200), count(5, 16);
    int tried = 0;
    for (int run = 0; tried < 1000; ++run) {
        REQUIRE(run < 10'000);
        std::vector<LatticePoint> points(static_cast<std::size_t>(count(random)));
        for (LatticePoint& p : points)
            p = {place(random), place(random)};
        const Points hull = texels(convex_hull(points));
        const std::size_t k = 3 + static_cast<std::size_t>(run) % 6;
        if (hull.size() <= k || hull.size() > 12)
            continue;
        ++tried;
        const double right = brute_force(hull, k);
        const auto found = least_polygon(hull, k);
        if ((found ? found->area : HUGE_VAL) > right * (1.0 + 1e-9) || (found && found->area < right * (1.0 - 1e-9)))
            FAIL_CHECK("run " << run << ", k " << k << ": " << (found ? found->area : 0.0) << ", not " << right);
    }
    CHECK(tried == 1000);
}

TEST_CASE("bounding polygon: its area falls with k, and follows an affine map") {
    std::mt19937 random(11);
    std::uniform_int_distribution<int> place(0, 500);
    for (int run = 0; run < 20; ++run) {
        std::vector<LatticePoint> points(60);
        for (LatticePoint& p : points)
            p = {place(random), place(random)};
        const Points hull = texels(convex_hull(points));
        Points mapped;
        for (const Point p : hull)
            mapped.emplace_back(2.0 * p.x + 0.5 * p.y + 3.0, -0.25 * p.x + 1.5 * p.y);
        double last = HUGE_VAL;
        for (std::size_t k = 3; k <= 8; ++k) {
            const double one = least_polygon(hull, k)->area;
            CHECK(one <= last * (1.0 + 1e-12));
            CHECK(least_polygon(mapped, k)->area == Approx(one * 3.125).epsilon(1e-9));
            last = one;
        }
    }
}

TEST_CASE("bounding polygon: a disc's saving is the specification's, and the centres' cuts lit texels") {
    const std::vector<std::uint8_t> alpha = disc(16, 6.4);
    const auto lit = std::count(alpha.begin(), alpha.end(), 255);
    const auto saving = [&](HullPoints points) {
        return 1.0 - area(sprite_polygon(convex_hull(outermost(alpha, 16, 0, points)), 8)) / 256.0;
    };
    REQUIRE(lit == 124);
    CHECK(saving(HullPoints::centres) > saving(HullPoints::corners));
    CHECK(saving(HullPoints::corners) > saving(HullPoints::bilinear));
    CHECK(saving(HullPoints::corners) == Approx(0.473).margin(0.001));
    CHECK(saving(HullPoints::bilinear) == Approx(0.375).margin(0.001));
    CHECK(saving(HullPoints::centres) == Approx(0.562).margin(0.001));
}

TEST_CASE("bounding polygon: every point of the hull is inside, for nothing, a texel, a line, a square and blobs") {
    CHECK(sprite_polygon(convex_hull(outermost(std::vector<std::uint8_t>(16), 4, 0, HullPoints::corners)), 4).empty());
    std::mt19937 random(3);
    for (int run = 0; run < 60; ++run) {
        const int size = 1 + run % 20;
        std::vector<std::uint8_t> alpha(static_cast<std::size_t>(size * size));
        for (std::uint8_t& a : alpha)
            a = run < 4 ? 255 : random() % 5 == 0 ? 200 : 0;
        const auto hull =
            convex_hull(outermost(alpha, size, 0, run % 2 == 0 ? HullPoints::corners : HullPoints::bilinear));
        if (hull.empty())
            continue;
        for (std::size_t k = 3; k <= 8; ++k) {
            const Points polygon = sprite_polygon(hull, k);
            CHECK(polygon.size() <= std::max<std::size_t>(k, 4));
            for (const LatticePoint p : hull)
                for (std::size_t c = 0; c < polygon.size(); ++c)
                    if (cross(polygon[(c + 1) % polygon.size()] - polygon[c],
                              Point(0.5 * double(p.x), 0.5 * double(p.y)) - polygon[c]) < 0.0)
                        FAIL_CHECK("run " << run << ", k " << k << ": a point is outside");
        }
    }
}

TEST_CASE("bounding polygon: Graham's hull is Andrew's") {
    std::mt19937 random(5);
    std::uniform_int_distribution<int> place(0, 12);
    for (int run = 0; run < 500; ++run) {
        std::vector<LatticePoint> points(static_cast<std::size_t>(run % 40));
        for (LatticePoint& p : points)
            p = {place(random), place(random)};
        std::vector<LatticePoint> sorted = points;
        const auto turn = [](LatticePoint o, LatticePoint a, LatticePoint b) {
            return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
        };
        std::sort(sorted.begin(), sorted.end(), [](auto a, auto b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
        sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
        std::vector<LatticePoint> chain;
        for (int pass = 0; pass < 2 && sorted.size() > 2; ++pass) {
            const std::size_t start = chain.size();
            for (const LatticePoint p : sorted) {
                while (chain.size() > start + 1 && turn(chain[chain.size() - 2], chain.back(), p) <= 0)
                    chain.pop_back();
                chain.push_back(p);
            }
            chain.pop_back();
            std::reverse(sorted.begin(), sorted.end());
        }
        const std::vector<LatticePoint> hull = convex_hull(points);
        if (chain.size() < 3)
            CHECK(hull.size() < 3);
        else
            CHECK(std::is_permutation(hull.begin(), hull.end(), chain.begin(), chain.end()));
    }
}

} // namespace lockstep::test::bounding_polygon_test
