#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <omp.h>

#include "reference/collision/neighbours.hpp"
#include "reference/model/error.hpp"
#include "tests/nanoflann_search.hpp"

namespace lockstep {

bool operator==(const Neighbourhood& a, const Neighbourhood& b) {
    return a.squared_distance == b.squared_distance && a.nearest == b.nearest && a.count == b.count;
}

std::ostream& operator<<(std::ostream& out, const Neighbourhood& n) {
    return out << n.count << " neighbours, nearest " << n.nearest << " at squared distance " << n.squared_distance;
}

} // namespace lockstep

namespace lockstep::test::neighbours_test {

namespace {

using Positions = std::vector<glm::vec3>;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float largest = std::numeric_limits<float>::max();
constexpr float smallest = std::numeric_limits<float>::denorm_min();

/// The rule once more, from the text.
struct BruteForce {
    std::vector<Neighbourhood> particle;
    std::vector<std::vector<std::int32_t>> neighbours;

    BruteForce(const Positions& positions, float range) : particle(positions.size()), neighbours(positions.size()) {
        const double limit = static_cast<double>(range) * static_cast<double>(range);
        for (std::size_t a = 0; a < positions.size(); ++a) {
            const double ax = positions[a].x, ay = positions[a].y, az = positions[a].z;
            for (std::size_t b = 0; b < positions.size(); ++b) {
                const double dx = ax - positions[b].x, dy = ay - positions[b].y, dz = az - positions[b].z;
                const double squared = dx * dx + dy * dy + dz * dz;
                if (a == b || !(squared < limit))
                    continue;
                const auto index = static_cast<std::int32_t>(b);
                neighbours[a].push_back(index);
                ++particle[a].count;
                if (squared < particle[a].squared_distance) {
                    particle[a].squared_distance = squared;
                    particle[a].nearest = index;
                }
            }
        }
    }
};

struct Differences {
    std::size_t missed_pairs = 0;
    std::size_t extra_pairs = 0;
    std::size_t unsorted_lists = 0;
    std::size_t summaries = 0;
    std::size_t pairs = 0;
};

Differences compare_with_brute_force(const Positions& positions, float range) {
    const BruteForce truth(positions, range);
    const Neighbourhoods found = find_neighbourhoods(positions, range);
    const NeighbourLists lists = list_neighbours(positions, range);
    REQUIRE(found.particle.size() == positions.size());
    REQUIRE(lists.start.size() == positions.size() + 1);

    Differences differences;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const std::vector<std::int32_t>& expected = truth.neighbours[i];
        const auto list = lists.of(i);
        differences.unsorted_lists += std::is_sorted(list.begin(), list.end()) ? 0U : 1U;
        std::vector<std::int32_t> missed;
        std::vector<std::int32_t> extra;
        std::set_difference(expected.begin(), expected.end(), list.begin(), list.end(), std::back_inserter(missed));
        std::set_difference(list.begin(), list.end(), expected.begin(), expected.end(), std::back_inserter(extra));
        differences.missed_pairs += missed.size();
        differences.extra_pairs += extra.size();
        differences.summaries += found.particle[i] == truth.particle[i] ? 0U : 1U;
        differences.pairs += expected.size();
    }
    return differences;
}

/// Returns the number of pairs.
std::size_t check_against_brute_force(const Positions& positions, float range) {
    const Differences differences = compare_with_brute_force(positions, range);
    CHECK(differences.missed_pairs == 0);
    CHECK(differences.extra_pairs == 0);
    CHECK(differences.unsorted_lists == 0);
    CHECK(differences.summaries == 0);
    return differences.pairs;
}

class Random {
  public:
    explicit Random(unsigned seed) : generator_(seed) {}
    float between(float low, float high) {
        return low + (high - low) * (static_cast<float>(generator_() >> 8U) * 0x1p-24F);
    }
    std::size_t below(std::size_t bound) { return generator_() % bound; }
    glm::vec3 point(glm::vec3 low, glm::vec3 high) {
        const float x = between(low.x, high.x);
        const float y = between(low.y, high.y);
        const float z = between(low.z, high.z);
        return {x, y, z};
    }
    float any_finite() {
        for (;;) {
            const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(generator_()));
            if (std::isfinite(value))
                return value;
        }
    }

  private:
    std::mt19937 generator_;
};

Positions random_box(unsigned seed, std::size_t count, glm::vec3 low, glm::vec3 high) {
    Random random(seed);
    Positions positions(count);
    for (glm::vec3& p : positions)
        p = random.point(low, high);
    return positions;
}

} // namespace

TEST_CASE("neighbours: no pair is missed and none is extra, 20 seeds against brute force", "[neighbours]") {
    std::size_t pairs = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
        INFO("seed " << seed);
        Random random(seed);
        const std::size_t count = 250 * (seed + 1);
        Positions positions = random_box(seed, count, glm::vec3(-1.0F, -2.0F, -3.0F), glm::vec3(1.0F, 0.5F, 0.25F));
        for (std::size_t i = 0; i < count / 10; ++i)
            positions[random.below(count)] = positions[random.below(count)];
        const float range = random.between(0.02F, 0.4F);
        pairs += check_against_brute_force(positions, range);
    }
    CHECK(pairs > 100'000);
}

TEST_CASE("neighbours: a lattice spaced exactly the range has no neighbours, a hair more range finds all six",
          "[neighbours]") {
    for (const float spacing : {0.25F, 0.1F, 0.008F}) {
        Positions positions;
        for (int z = -5; z < 5; ++z)
            for (int y = -5; y < 5; ++y)
                for (int x = -5; x < 5; ++x)
                    positions.emplace_back(static_cast<float>(x) * spacing, static_cast<float>(y) * spacing,
                                           static_cast<float>(z) * spacing);
        INFO("spacing " << spacing);
        check_against_brute_force(positions, spacing);
        check_against_brute_force(positions, std::nextafter(spacing, 1.0F));
        check_against_brute_force(positions, std::nextafter(spacing, 0.0F));
        if (spacing == 0.25F) {
            CHECK(list_neighbours(positions, spacing).neighbours.empty());
            CHECK(list_neighbours(positions, std::nextafter(spacing, 1.0F)).neighbours.size() == 2 * 3 * 900);
        }
    }
}

TEST_CASE("neighbours: the range itself is out, whatever the direction", "[neighbours]") {
    CHECK(find_neighbourhoods(Positions{{0, 0, 0}, {3, 4, 0}}, 5.0F).particle[0].count == 0);
    CHECK(find_neighbourhoods(Positions{{0, 0, 0}, {3, 4, 0}}, std::nextafter(5.0F, 6.0F)).particle[0].count == 1);
    CHECK(find_neighbourhoods(Positions{{-2, -3, -6}, {0, 0, 0}}, 7.0F).particle[1].count == 0);
}

TEST_CASE("neighbours: coincident particles are neighbours at distance 0, never oneself", "[neighbours]") {
    const Positions positions{{1, -2, 3}, {1, -2, 3}, {1, -2, 3}, {9, 9, 9}};
    const Neighbourhoods found = find_neighbourhoods(positions, 0.5F);
    CHECK(found.particle[0] == Neighbourhood{0.0, 1, 2});
    CHECK(found.particle[1] == Neighbourhood{0.0, 0, 2});
    CHECK(found.particle[2] == Neighbourhood{0.0, 0, 2});
    CHECK(found.particle[3] == Neighbourhood{});
}

TEST_CASE("neighbours: of equally near particles the lowest index is the nearest", "[neighbours]") {
    // The neighbours of particle 5 lie in six different cells, and not in the order of their indices.
    const Positions positions{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 0}, {0, 0, -1}};
    const Neighbourhoods found = find_neighbourhoods(positions, 1.25F);
    CHECK(found.particle[5] == Neighbourhood{1.0, 0, 6});
    Positions reversed(positions.rbegin(), positions.rend());
    CHECK(find_neighbourhoods(reversed, 1.25F).particle[1] == Neighbourhood{1.0, 0, 6});
}

TEST_CASE("neighbours: NaN and infinite positions are counted and otherwise ignored", "[neighbours]") {
    const Positions positions{{0, 0, 0},
                              {not_a_number, 0, 0},
                              {0.1F, 0, 0},
                              {0, infinity, 0},
                              {0, 0, -infinity},
                              {0, 0, not_a_number},
                              {not_a_number, not_a_number, not_a_number},
                              {0, 0.2F, 0},
                              {0, infinity, 0},
                              {0, 0, not_a_number},
                              {infinity, not_a_number, 0}};
    const Neighbourhoods found = find_neighbourhoods(positions, 1.0F);
    CHECK(found.ignored == 8);
    CHECK(found.particle[0] == Neighbourhood{static_cast<double>(0.1F) * static_cast<double>(0.1F), 2, 2});
    CHECK(found.particle[3] == Neighbourhood{});
    CHECK(list_neighbours(positions, 1.0F).neighbours == std::vector<std::int32_t>{2, 7, 0, 7, 0, 2});
    CHECK(find_neighbourhoods(Positions(5, glm::vec3(not_a_number)), 1.0F).ignored == 5);
}

TEST_CASE("neighbours: coordinates of any size, ranges of any size", "[neighbours]") {
    Random random(7);
    Positions positions = random_box(7, 400, glm::vec3(-1.0F), glm::vec3(1.0F));
    for (int i = 0; i < 200; ++i)
        positions.emplace_back(random.any_finite(), random.any_finite(), random.any_finite());
    for (const float x : {largest, -largest, 1e30F, -1e19F, 1e12F, 33554432.0F, smallest, -smallest, 0.0F, -0.0F})
        for (const float y : {0.0F, x, std::nextafter(x, 0.0F), std::nextafter(x, infinity)})
            if (std::isfinite(y))
                positions.emplace_back(x, y, -x);
    for (const float range : {smallest, 1e-40F, 1e-30F, 1e-20F, 1e-10F, 1e-4F, 0.05F, 1.0F, 3.0F, 1e7F, 1e13F, 1e20F,
                              1e31F, 1e38F, largest}) {
        INFO("range " << range);
        check_against_brute_force(positions, range);
    }
}

TEST_CASE("neighbours: pairs across every border of cells near and far from the origin", "[neighbours]") {
    Random random(11);
    for (const float centre : {0.0F, 1.0F, -1000.0F, 12345.0F, -4e6F, 2e8F}) {
        const float unit = std::max(std::nextafter(std::abs(centre), infinity) - std::abs(centre), 1e-3F);
        const Positions positions =
            random_box(3, 700, glm::vec3(centre - 10.0F * unit), glm::vec3(centre + 10.0F * unit));
        for (const float cells : {0.5F, 1.0F, 1.5F, 2.0F, 3.0F}) {
            INFO("centre " << centre << ", range " << cells << " units");
            check_against_brute_force(positions, cells * unit);
        }
    }
}

TEST_CASE("neighbours: flat, thin and sparse clouds, whose grid is small or wraps around", "[neighbours]") {
    check_against_brute_force(random_box(1, 900, {-1, -1, 0}, {1, 1, 0}), 0.1F);
    check_against_brute_force(random_box(2, 900, {0, -1, 5}, {0, 1, 5}), 0.01F);
    check_against_brute_force(random_box(3, 900, {-40, -1, -1}, {40, 1, 1}), 0.3F);
    check_against_brute_force(random_box(4, 900, {-100, -100, -100}, {100, 100, 100}), 1.0F);
    check_against_brute_force(random_box(5, 900, {-100, -100, -1}, {100, 100, 1}), 2.0F);
    check_against_brute_force(random_box(6, 30, {0, 0, 0}, {1, 1, 1}), 10.0F);
    check_against_brute_force(Positions(60, glm::vec3(-3.0F)), 0.1F);
    check_against_brute_force({{1, 2, 3}}, 1.0F);
    check_against_brute_force({}, 1.0F);
}

TEST_CASE("neighbours: a particle far away neither slows the search of the others nor changes it", "[neighbours]") {
    Positions positions = random_box(9, 100'000, glm::vec3(-0.5F), glm::vec3(0.5F));
    const Neighbourhoods before = find_neighbourhoods(positions, 0.01F);
    positions.emplace_back(1e30F, -3e38F, 0.0F);
    const Neighbourhoods after = find_neighbourhoods(positions, 0.01F);
    CHECK(std::equal(before.particle.begin(), before.particle.end(), after.particle.begin()));
    CHECK(after.particle.back() == Neighbourhood{});
}

TEST_CASE("neighbours: a range far below the spacing of floats finds the coincident, and is no slower",
          "[neighbours]") {
    Positions positions = random_box(10, 100'000, glm::vec3(1.0F), glm::vec3(2.0F));
    positions.push_back(positions[17]);
    const Neighbourhoods found = find_neighbourhoods(positions, 1e-25F);
    CHECK(found.particle[17] == Neighbourhood{0.0, 100'000, 1});
    CHECK(found.particle.back() == Neighbourhood{0.0, 17, 1});
}

TEST_CASE("neighbours: 200,000 particles agree with nanoflann", "[neighbours]") {
    const Positions positions = random_box(5, 200'000, glm::vec3(-0.5F), glm::vec3(0.5F));
    for (const float range : {0.013F, 0.021F}) {
        const Neighbourhoods found = find_neighbourhoods(positions, range);
        const Neighbourhoods oracle = test::nanoflann_neighbourhoods<double>(positions, range);
        std::size_t different = 0;
        std::size_t pairs = 0;
        for (std::size_t i = 0; i < positions.size(); ++i) {
            different += found.particle[i] == oracle.particle[i] ? 0U : 1U;
            pairs += oracle.particle[i].count;
        }
        CHECK(different == 0);
        CHECK(pairs > positions.size());
        CHECK(list_neighbours(positions, range).neighbours.size() == pairs);
    }
}

TEST_CASE("neighbours: the answer does not depend on the number of threads", "[neighbours]") {
    Positions positions = random_box(6, 50'000, glm::vec3(-0.5F), glm::vec3(0.5F));
    positions[100].y = not_a_number;
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const Neighbourhoods one = find_neighbourhoods(positions, 0.03F);
    const NeighbourLists one_lists = list_neighbours(positions, 0.03F);
    for (const int count : {2, 3, 8}) {
        omp_set_num_threads(count);
        const Neighbourhoods many = find_neighbourhoods(positions, 0.03F);
        const NeighbourLists many_lists = list_neighbours(positions, 0.03F);
        CHECK(many.particle == one.particle);
        CHECK(many.ignored == 1);
        CHECK(many_lists.start == one_lists.start);
        CHECK(many_lists.neighbours == one_lists.neighbours);
    }
    omp_set_num_threads(threads);
}

TEST_CASE("neighbours: a range that is no distance and too many positions are told", "[neighbours]") {
    const Positions positions(2);
    CHECK_THROWS_AS(find_neighbourhoods(positions, not_a_number), Error);
    CHECK_THROWS_WITH(find_neighbourhoods(positions, -1.0F), "neighbour search: range -1 is not a finite number >= 0");
    CHECK_THROWS_WITH(list_neighbours(positions, infinity), "neighbour search: range inf is not a finite number >= 0");
    const std::span too_many(positions.data(), std::size_t{1} << 31U);
    CHECK_THROWS_WITH(find_neighbourhoods(too_many, 1.0F),
                      "neighbour search: 2147483648 positions are more than 2147483647");
    CHECK_THROWS_AS(list_neighbours(too_many, 1.0F), Error);
}

TEST_CASE("neighbours: range 0 finds nothing, coincident or not", "[neighbours]") {
    const Neighbourhoods found = find_neighbourhoods(Positions{{1, 1, 1}, {1, 1, 1}, {not_a_number, 0, 0}}, 0.0F);
    CHECK(found.particle[0] == Neighbourhood{});
    CHECK(found.ignored == 1);
}

} // namespace lockstep::test::neighbours_test
